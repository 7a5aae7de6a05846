// A study's findings in pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plot/canvas.hpp"
#include "core/study_report/study_findings.hpp"

namespace dibhr {

/// A line of a plot of rows: an estimate with its interval, over the participants' own values.
struct PlotRow {
    std::string name{};
    double value{0.0};           ///< not finite: none
    Interval interval{};         ///< an infinite end leaves the plot; two: none is drawn
    std::vector<double> each{};  ///< NaN: none
};

/// What is drawn beside the rows.
struct RowsPlot {
    std::string title{}, subtitle{};
    std::string axis{};  ///< with its unit
    std::vector<PlotRow> rows{};
    std::optional<double> line{};  ///< of chance, or no difference
    std::string line_name{};
    std::optional<Interval> span{};  ///< of the axis; nothing: as the values need
    std::string no_value{};          ///< written in a row without a value
};

/// There must be a row.
[[nodiscard]] Canvas plot_rows(const RowsPlot& plot);

/// Each participant's curve, the answers of all at their levels, and the threshold. There must be
/// a fit.
[[nodiscard]] Canvas plot_threshold(const ThresholdFinding& finding, const std::string& title,
                                    const std::string& subtitle);

/// Levels of every staircase of one item, trial by trial. There must be one.
[[nodiscard]] Canvas plot_tracks(const Study& study, std::size_t block, std::size_t item,
                                 const std::string& title, const std::string& subtitle);

}  // namespace dibhr
