// Surfaces that are known everywhere and at every time, to compare a camera's frames with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::bench {

/// The highest level of all images here stands so high [px]: a level of 8 bits is a pixel.
inline constexpr double kRelief_px = 255.0;
/// Frames a second.
inline constexpr double kRate = 30.0;
/// Distances from the camera of the relief's highest and lowest elevation.
inline constexpr double kNear_mm = 800.0;
inline constexpr double kFar_mm = 1300.0;

[[nodiscard]] constexpr double distance_mm(double elevation_px) noexcept {
    return kFar_mm - elevation_px / kRelief_px * (kFar_mm - kNear_mm);
}
[[nodiscard]] constexpr double elevation_px(double distance_mm) noexcept {
    return (kFar_mm - distance_mm) / (kFar_mm - kNear_mm) * kRelief_px;
}

struct Seen {
    double elevation_px;
    int object;  ///< 0: the background; where it changes is a silhouette
};

struct KnownScene {
    std::string name{};
    int columns{640};
    int rows{480};
    /// At a time [frames] and a place [px], whole or not.
    std::function<Seen(double frame, double x, double y)> at{};
    bool moves{false};
    /// The small shape's part of the elevation, in scenes that test it; else empty.
    std::function<double(double x, double y)> bump{};
};

/// "plane", "sphere", "face", "hand" (moves at 0.5 m/s, 8 cm before a wall), "chest" (breathes 12
/// times a minute, 5 px) and "bumps" (1 px high, 8 px wide, on a plane). All but the bumps and the
/// breath are as large as the picture, elevations too.
[[nodiscard]] std::vector<KnownScene> known_scenes(int columns, int rows);

/// The scene of that name, which must exist.
[[nodiscard]] KnownScene known_scene(const std::string& name, int columns, int rows);

/// One frame of a scene at every pixel, row-major.
struct TrueFrame {
    DepthImage elevation{};  ///< [px], of the highest level kRelief_px
    std::vector<std::uint8_t> object{};
    std::vector<float> to_silhouette_px{};  ///< infinity: there is none
    /// Of the surface, upwards, where the core's triangle (i, j, near_origin) has its middle; of
    /// the pixels of the last row and column and near silhouettes: nothing.
    std::vector<Vec3> normal{};
};

/// Frames [0, count) of a scene. Of one that does not move all share one.
class TrueFrames {
  public:
    TrueFrames(const KnownScene& scene, int count);

    [[nodiscard]] int count() const noexcept { return count_; }
    [[nodiscard]] const TrueFrame& operator[](int frame) const {
        return frames_[scene_.moves ? static_cast<std::size_t>(frame) : 0];
    }
    [[nodiscard]] const KnownScene& scene() const noexcept { return scene_; }

  private:
    KnownScene scene_;
    int count_;
    std::vector<TrueFrame> frames_{};
};

/// Nearer to a silhouette nothing of a surface is measured [px].
inline constexpr float kBeside_px = 2.0F;

}  // namespace dibhr::bench
