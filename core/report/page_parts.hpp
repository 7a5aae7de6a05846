// What the pages of reports are made of: style, sections, tables and pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/files/output_file.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// A picture of a report.
struct Figure {
    std::string name{};   ///< "heat-map": of its files, without their endings
    std::string files{};  ///< "heat-map.svg, heat-map.pdf"
    std::string title{};
    std::string caption{};
    int columns{0}, rows{0};
    std::string png{};
};

/// "heat-map.svg"
[[nodiscard]] std::string picture_file(const std::string& name, PlotFormat format);

/// Adds the plot's files to the folder. Throws InputError when one cannot be written.
[[nodiscard]] Figure add_figure(OutputFolder& files, std::span<const PlotFormat> formats,
                                const std::string& name, const std::string& title,
                                const std::string& caption, const Canvas& plot);

/// A page from its first line to the end of its head. `title` and `program` are plain text.
[[nodiscard]] std::string page_head(const std::string& title, const std::string& program);

/// With its caption and the names of its files.
[[nodiscard]] std::string figure_html(const Figure& figure);

/// Cells of a row as HTML.
using Cells = std::vector<std::string>;

[[nodiscard]] std::string table_of(const Cells& heads, const std::vector<Cells>& rows);

/// `heading` and `body` are HTML.
[[nodiscard]] std::string section(const std::string& heading, const std::string& body);

}  // namespace dibhr
