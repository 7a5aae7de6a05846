// What the numbers of a depth source tell of their meaning, and the range that they span.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/video/depth/findings.hpp"
#include "core/video/depth/slope_shape.hpp"

namespace dibhr {

/// One picture's levels on a lattice of pixels, and those of the pixels to their right.
struct LevelLattice {
    int columns{0}, rows{0};
    std::vector<float> levels{};
    std::vector<float> beside{};
};

/// The levels of pictures spread over a source, on a lattice of pixels. Each function that returns
/// findings gives rows of the table; evidence that is missing gives no row.
class SampledLevels {
  public:
    /// Pictures of 1 to 4 channels; `bits` of their levels, kRealBits for real numbers. There may
    /// be none.
    SampledLevels(const std::vector<cv::Mat>& pictures, int bits);

    /// No data, always one row: values that stand out from the other levels. Of integers 0 and the
    /// highest level; of real numbers each value that many pixels have exactly, and that lies
    /// beyond all others with a gap. What is not finite is no data in any case.
    [[nodiscard]] Findings no_data() const;

    /// From here on, levels of these values do not count.
    void leave_out(const std::vector<double>& no_data);

    /// Unit and scale, by the kind of numbers, by the ends that they reach, and by the sizes that
    /// a scene would have in each unit.
    [[nodiscard]] Findings units() const;

    /// The rows that contradict statements on the unit: distances that are not the usual ones, and
    /// disparities below 0.
    [[nodiscard]] Findings contradictions(const Findings& findings) const;

    /// Near, by how slopes bend (SlopeShape), and by where the picture is brighter: things are
    /// mostly near in the middle and on the floor. That is weak, and said as sure as it is clear. A
    /// picture whose middle differs from all four sides may show a thing or a tunnel: there the
    /// light of a camera in a tunnel decides. `middle_of_colour`: middle_brighter_than_sides() of
    /// the colour pictures, if there are any.
    [[nodiscard]] Findings near(std::optional<int> middle_of_colour = {}) const;

    /// 1: the middle is clearly brighter than each of the four sides, -1: it is darker than each,
    /// 0: neither.
    [[nodiscard]] int middle_brighter_than_sides() const;

    /// The range by that meaning: between the half percents at either end, and at most a twentieth
    /// of the span beyond; at the near end also the last ten-thousandth. Distances beyond twice the
    /// span of the nearest nine tenths do not count.
    [[nodiscard]] DepthRange range(const DepthMeaning& meaning) const;

    /// Whether the numbers may be metres of terrain, and are none of the other quantities that maps
    /// hold: degrees, shares, decibels and classes lie below 100, densities and rain reach 0,
    /// temperatures are near 300 K, and light and noise jump from pixel to pixel.
    [[nodiscard]] bool may_be_terrain() const;

    /// The share of pixels without data, in [0, 1].
    [[nodiscard]] double holes_share() const;

  private:
    [[nodiscard]] static LevelLattice lattice_of(const cv::Mat& picture);
    [[nodiscard]] bool is_data(float level) const;
    [[nodiscard]] std::vector<float> rising_without(const std::vector<double>& no_data) const;
    [[nodiscard]] double share_of_border(double level) const;
    [[nodiscard]] std::vector<double> outlying_integers() const;
    [[nodiscard]] std::vector<double> outlying_numbers() const;
    [[nodiscard]] bool is_scattered() const;
    [[nodiscard]] Findings contradiction(const Finding& finding) const;
    [[nodiscard]] Findings signed_disparity(const Findings& findings) const;
    [[nodiscard]] std::vector<double> steps() const;
    [[nodiscard]] bool has_outlines() const;
    [[nodiscard]] SlopeShape slope_shape() const;
    [[nodiscard]] Findings units_of_integers() const;
    [[nodiscard]] Findings units_of_numbers() const;

    int bits_;
    cv::Size picture_{};  ///< size of the first
    std::vector<LevelLattice> lattices_{};
    std::vector<double> no_data_{};
    std::vector<float> levels_{};  ///< that are data, in rising order
};

/// The number of different levels in the pictures.
[[nodiscard]] int levels_used(const std::vector<cv::Mat>& pictures);

}  // namespace dibhr
