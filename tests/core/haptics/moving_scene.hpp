// Scenes whose material moves in a known way: depth images, the fields between them, and where each
// material point is.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::test {

/// Where a material point has gone from where it was at time 0, after some seconds: linear in its
/// place.
using PointMotion = std::function<Vec2(Vec2 begin, double t_s)>;

inline PointMotion translating(Vec2 px_per_s) {
    return [=](Vec2 begin, double t_s) { return begin + t_s * px_per_s; };
}

/// About `centre`: turned by `turn_per_s` [rad], grown by `growth_per_s` (0.5: half as large
/// again).
inline PointMotion turning(Vec2 centre, double turn_per_s, double growth_per_s = 0.0) {
    return [=](Vec2 begin, double t_s) {
        const double angle = turn_per_s * t_s;
        const double size = 1.0 + growth_per_s * t_s;
        const Vec2 way = begin - centre;
        return centre + size * Vec2(std::cos(angle) * way.x - std::sin(angle) * way.y,
                                    std::sin(angle) * way.x + std::cos(angle) * way.y);
    };
}

/// Elevation [px] at a place of the image at a time.
using Ground = std::function<double(Vec2 place, double t_s)>;

/// A video of moving material, with whole levels only where the ground has them; relief 255 px.
class MovingScene {
  public:
    MovingScene(int columns, int rows, double frames_per_s, PointMotion motion, Ground ground)
        : columns_(columns),
          rows_(rows),
          frames_per_s_(frames_per_s),
          motion_(std::move(motion)),
          ground_(std::move(ground)) {}
    /// One elevation everywhere.
    MovingScene(int columns, int rows, double frames_per_s, PointMotion motion, double flat_px)
        : MovingScene(columns, rows, frames_per_s, std::move(motion),
                      [=](Vec2, double) { return flat_px; }) {
        is_flat_ = true;
    }

    [[nodiscard]] double frames_per_s() const { return frames_per_s_; }
    [[nodiscard]] Vec2 at(Vec2 begin, double t_s) const { return motion_(begin, t_s); }

    [[nodiscard]] std::shared_ptr<const DepthImage> depth(int frame) {
        auto& image = images_[is_flat_ ? 0 : frame];
        if (!image) {
            image = std::make_shared<const DepthImage>(
                image_of(columns_, rows_, 255.0,
                         [&](int i, int j) { return ground_(Vec2(i, j), time_of(frame)); }));
        }
        return image;
    }

    /// The field to the next frame, exact in float precision.
    [[nodiscard]] std::shared_ptr<const MotionField> field(int frame) {
        auto& field = fields_[frame];
        if (!field) field = std::make_shared<const MotionField>(made_field(frame));
        return field;
    }

  private:
    [[nodiscard]] double time_of(int frame) const { return frame / frames_per_s_; }

    /// The motion is linear in the place: three places define it.
    [[nodiscard]] MotionField made_field(int frame) const {
        const auto way_at = [&](Vec2 place) {
            return motion_(begin_of(place, time_of(frame)), time_of(frame + 1)) - place;
        };
        const Vec2 origin = way_at({0.0, 0.0});
        const Vec2 right = way_at({1.0, 0.0}) - origin;
        const Vec2 down = way_at({0.0, 1.0}) - origin;
        MotionField field{columns_, rows_, {}};
        field.ways.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
        std::size_t k = 0;
        for (int j = 0; j < rows_; ++j) {
            for (int i = 0; i < columns_; ++i, ++k) {
                const Vec2 way =
                    origin + static_cast<double>(i) * right + static_cast<double>(j) * down;
                field.ways[k] = {static_cast<float>(way.x), static_cast<float>(way.y)};
            }
        }
        return field;
    }

    /// The place at time 0 of the point that is at `place` now.
    [[nodiscard]] Vec2 begin_of(Vec2 place, double t_s) const {
        const Vec2 origin = motion_({0.0, 0.0}, t_s);
        const Vec2 right = motion_({1.0, 0.0}, t_s) - origin;
        const Vec2 down = motion_({0.0, 1.0}, t_s) - origin;
        const Vec2 way = place - origin;
        const double area = right.x * down.y - right.y * down.x;
        return {(way.x * down.y - way.y * down.x) / area,
                (right.x * way.y - right.y * way.x) / area};
    }

    int columns_, rows_;
    double frames_per_s_;
    PointMotion motion_;
    Ground ground_;
    bool is_flat_{false};  // all images are the same
    std::map<int, std::shared_ptr<const DepthImage>> images_{};
    std::map<int, std::shared_ptr<const MotionField>> fields_{};
};

/// The motion between two updates, as a player would publish it.
inline SurfaceMotion motion_between(MovingScene& scene, double last_s, double now_s) {
    const double last = last_s * scene.frames_per_s();
    const double now = now_s * scene.frames_per_s();
    const auto frame = static_cast<int>(now);
    const auto last_frame = static_cast<int>(last);
    return {.field = scene.field(frame).get(),
            .from_blend = last - last_frame,
            .to_blend = now - frame,
            .crossed = last_frame == frame - 1,
            .dt_s = now_s - last_s};
}

}  // namespace dibhr::test
