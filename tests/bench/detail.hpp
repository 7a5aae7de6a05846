// How much of small shapes cleaning keeps and how much noise it leaves: a plane at 1 m with ridges,
// steps and a flat panel, before a camera that stands still or moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/frame_window.hpp"
#include "tests/bench/blemishes.hpp"
#include "tests/bench/known_scene.hpp"

namespace dibhr::bench {

/// A panel of ridges: a sine from left to right. At a focal length of 525 px a pixel is 1.9 mm.
struct Ridges {
    double amplitude_mm{0.0};
    double period_px{0.0};
};
/// Of 23 mm and 11 mm.
inline constexpr std::array kRidges{Ridges{2.0, 12.0}, Ridges{2.0, 6.0}, Ridges{1.0, 12.0},
                                    Ridges{1.0, 6.0}};
inline constexpr double kStep_mm = 3.0;

/// How the camera moves, a frame. By default it stands still.
struct CameraPath {
    double right_px{0.0};
    double roll{0.0};       ///< around the picture's middle [rad]
    double nearer_mm{0.0};  ///< so that it is 1 m away in frame kAtOneMetre

    [[nodiscard]] bool moves() const noexcept {
        return right_px != 0.0 || roll != 0.0 || nearer_mm != 0.0;
    }
};
inline constexpr double kAtOneMetre = 30.0;

/// The plane, tilted by 5 %, with panels one below the other: flat, the ridges, and steps.
[[nodiscard]] KnownScene detail_scene(const CameraPath& path);

/// Its colour, a picture a frame: a texture with noise of 2 levels.
[[nodiscard]] std::vector<ColourImage> detail_colours(const CameraPath& path, int frames,
                                                      std::uint32_t seed);

struct Detail {
    std::array<double, kRidges.size()> ridges{};  ///< share of the amplitude that is kept [1]
    /// Share of its height that is within 4 px [1]; NaN before a camera that rolls or comes nearer.
    double step{0.0};
    double noise_mm{0.0};  ///< RMS on the flat panel
    Blemishes flat{};      ///< there
};

/// Measures frames of a detail_scene(), of any highest level: no NaN.
class DetailMeter {
  public:
    explicit DetailMeter(const CameraPath& path) : path_(path) {}

    /// That frame of the scene; `next` follows it.
    void add(int frame, const DepthImage& depth, const DepthImage& next);
    [[nodiscard]] Detail detail() const;

  private:
    /// How much of a relief is in what is measured: least squares, with an offset.
    struct Share {
        double count{0.0}, relief{0.0}, measured{0.0}, squares{0.0}, products{0.0};

        void add(double true_mm, double seen_mm);
        [[nodiscard]] double share() const;
    };

    void add_steps(int frame, const DepthImage& depth);

    CameraPath path_;
    std::array<Share, kRidges.size()> ridges_{};
    double rise_mm_{0.0}, rises_{0.0};
    double squares_mm2_{0.0}, pixels_{0.0};
    BlemishMeter flat_{true};
};

/// The mean of frames [first, first + count), pixel by pixel.
[[nodiscard]] DepthImage mean_of(const std::vector<DepthImage>& frames, std::size_t first,
                                 std::size_t count);

}  // namespace dibhr::bench
