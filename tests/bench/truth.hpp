// How near depth comes to the truth: frames of known surfaces by sensors, cleaned, and compared
// with the surfaces.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "tests/bench/known_scene.hpp"

namespace dibhr::bench {

/// NaN: nothing was there to be measured.
struct Nearness {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    /// RMS over all pixels at least 2 px from silhouettes [px].
    double elevation_px{kNone};
    /// RMS angle between the normal of the core's triangles, along which its force acts on them,
    /// and that of the true surface under their middles, there [deg]. Of a scene with objects: on
    /// those alone.
    double normal_deg{kNone};
    /// 95 % of all places at a silhouette have a step within this distance: between two neighbours,
    /// half the height at least, up to the same side [px]. At most kFarthestEdge_px.
    double edge_px{kNone};
    /// How late moving parts are [frames]; below 0: early.
    double lag_frames{kNone};
    /// The share of a bump's height that is kept at its top [1].
    double bump_kept{kNone};
    /// RMS deviation of a pixel from its mean in time, where the scene is still and no silhouette
    /// is within 2 px [px].
    double flicker_px{kNone};
};
inline constexpr double kFarthestEdge_px = 16.0;

/// Measures a clip's frames, one after the other.
class NearnessMeter {
  public:
    /// The truth must outlive it.
    explicit NearnessMeter(const TrueFrames& truth);

    /// The next frame, of any highest level: no NaN.
    void add(const DepthImage& depth);
    [[nodiscard]] Nearness nearness() const;

  private:
    /// Mean of squares.
    struct Squares {
        double sum{0.0};
        double count{0.0};

        void add(double value) {
            sum += value * value;
            count += 1.0;
        }
        [[nodiscard]] double root() const;  ///< NaN of none
    };

    void add_elevations();
    void add_normals();
    void add_edges();
    void look_for_edge(std::size_t from, std::size_t to);
    void keep_moving();
    void add_bumps();
    void add_flicker();
    [[nodiscard]] double squares_from_truth(double late_frames) const;
    [[nodiscard]] double lag_frames() const;
    [[nodiscard]] double flicker_px() const;

    const TrueFrames& truth_;
    int frame_{0};
    DepthImage now_{};  ///< [px]
    Squares elevation_{}, normal_{};
    std::vector<double> edges_px_{};
    std::vector<std::size_t> moving_{};  ///< pixels
    std::vector<float> of_moving_{};     ///< their elevations, frame after frame
    std::vector<std::size_t> tops_{};    ///< of bumps
    double bump_{0.0}, whole_bump_{0.0};
    std::vector<char> still_{};               ///< pixels
    std::vector<double> sums_{}, squares_{};  ///< in time, of each
};

/// Reads a recording frame by frame, cleaned as the program does, and gives each to `take`. Returns
/// what was done, as text. `recorded` are of 8 or 16 bits, kRate a second; NaN is no data.
/// `colours`: of the same view; empty: depth alone.
std::string each_cleaned(const std::vector<DepthImage>& recorded, CleaningPreset preset,
                         const std::function<void(const DepthImage&)>& take,
                         std::vector<ColourImage> colours = {});

/// Compares such a recording with the truth.
struct Cleaned {
    Nearness nearness{};
    std::string words{};  ///< what was done
};
[[nodiscard]] Cleaned cleaned_against(const TrueFrames& truth,
                                      const std::vector<DepthImage>& recorded,
                                      CleaningPreset preset);

}  // namespace dibhr::bench
