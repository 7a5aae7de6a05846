// Motion in the picture plane while one depth image becomes the next, and the way of a material
// point under the proxy. README.md, Carried by what moves.
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// Where each pixel of a depth image has gone when the next one is there. Plain data of the depth
/// image's size, row-major.
struct MotionField {
    /// To the right and down [px]; both 0: it stays, or nothing is known of it.
    struct Way {
        float right{0.0F};
        float down{0.0F};

        bool operator==(const Way&) const = default;
    };

    int columns{0};
    int rows{0};
    std::vector<Way> ways{};

    [[nodiscard]] bool empty() const noexcept { return ways.empty(); }
    [[nodiscard]] const Way& at(int i, int j) const {
        return ways[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(i)];
    }
};

/// The motion between two depth images during one update. A view that owns nothing: the field must
/// outlive the update and stay as it is. By default nothing is carried.
struct SurfaceMotion {
    /// From the one image to the other; null, or of another size than the images: not known.
    const MotionField* field{nullptr};
    /// Where the last update was on the way from the one to the other, 0 to 1.
    double from_blend{0.0};
    double to_blend{0.0};  ///< where this one is
    /// The last update was on the way to the first of the two: `from_blend` is on that way.
    bool crossed{false};
    double dt_s{0.001};  ///< since the last update

    /// The same for an update that does not go on from the last one.
    [[nodiscard]] SurfaceMotion restarted() const noexcept {
        return {field, to_blend, to_blend, false, dt_s};
    }
    /// There may be something to carry: the update goes on from one before it.
    [[nodiscard]] bool continues() const noexcept {
        return field != nullptr && (crossed || from_blend != to_blend);
    }
    /// The same without a field that does not fit images of that size.
    [[nodiscard]] SurfaceMotion over(int columns, int rows) const noexcept;
    /// No material point goes farther in this time [px]; a longer flow is wrong. The speed is that
    /// of a hand, 4961 px/s in the paper.
    [[nodiscard]] double farthest_px() const noexcept;
};

inline constexpr double kFastestCarried_px_per_s = 5000.0;

/// The material point that lies under a proxy. It goes straight from where it is in one image to
/// where it is in the next: after a share b of the time it is at p + b F(p), F the field, bilinear
/// between pixels. So its place between two images does not depend on the ticks.
class MaterialPoint {
  public:
    // Both add to `read` where they look the field up.

    /// How far it goes from `place`, where it was at the last update, to where it is in this one
    /// [px]. Always finite; exactly 0 where nothing is known.
    [[nodiscard]] Vec2 step_from(Vec2 place, const SurfaceMotion& motion, PlaceBox& read) noexcept;

    /// Becomes the point that is at `place` in this update.
    void attach_at(Vec2 place, const SurfaceMotion& motion, PlaceBox& read) noexcept;

    /// There is no such point, or its motion is not known.
    void forget() noexcept { way_px_ = Vec2(0.0); }

  private:
    Vec2 way_px_{0.0};  ///< of the point, from the one image to the other
};

}  // namespace dibhr
