// Material points on their straight ways from one depth image to the next.
#include "core/haptics/surface_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dibhr {

namespace {

constexpr int kMostRounds = 8;
constexpr double kFound_px = 1e-7;
constexpr double kLongestTick_s = 0.020;  // a longer one is late: no force follows it

bool is_finite(Vec2 v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y);
}

Vec2 way_of(const MotionField& field, int i, int j) noexcept {
    const MotionField::Way& way = field.at(i, j);
    return {static_cast<double>(way.right), static_cast<double>(way.down)};
}

/// Bilinear between the pixels; beyond the image as on its border.
Vec2 way_at(const MotionField& field, Vec2 place) noexcept {
    const double x = std::min(std::max(0.0, place.x), field.columns - 1.0);  // 0 for no number
    const double y = std::min(std::max(0.0, place.y), field.rows - 1.0);
    const int i = std::min(static_cast<int>(x), field.columns - 2);
    const int j = std::min(static_cast<int>(y), field.rows - 2);
    const double right = x - i;
    const double down = y - j;
    const Vec2 above = (1.0 - right) * way_of(field, i, j) + right * way_of(field, i + 1, j);
    const Vec2 below =
        (1.0 - right) * way_of(field, i, j + 1) + right * way_of(field, i + 1, j + 1);
    return (1.0 - down) * above + down * below;
}

/// The whole way of the point that is at `place` after a share of its way. The search begins with
/// the way `like_px`. Where neighbours move so differently that the point is not found, the way of
/// a point near it is taken.
Vec2 way_through(const MotionField& field, Vec2 place, double share, Vec2 like_px,
                 PlaceBox& read) noexcept {
    Vec2 way = like_px;
    for (int k = 0; k < kMostRounds; ++k) {
        const Vec2 at = place - share * way;
        read.add(at);
        const Vec2 next = way_at(field, at);
        if (!is_finite(next)) return Vec2(0.0);
        const Vec2 change = share * (next - way);
        way = next;
        if (std::abs(change.x) + std::abs(change.y) <= kFound_px) break;
    }
    return way;
}

}  // namespace

SurfaceMotion SurfaceMotion::over(int columns, int rows) const noexcept {
    const bool fits =
        field != nullptr && field->columns == columns && field->rows == rows &&
        field->ways.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    SurfaceMotion motion = *this;
    if (!fits) motion.field = nullptr;
    return motion;
}

double SurfaceMotion::farthest_px() const noexcept {
    return kFastestCarried_px_per_s * std::clamp(dt_s, 0.0, kLongestTick_s);
}

Vec2 MaterialPoint::step_from(Vec2 place, const SurfaceMotion& motion, PlaceBox& read) noexcept {
    if (!motion.crossed) return (motion.to_blend - motion.from_blend) * way_px_;
    const Vec2 rest_of_last = (1.0 - motion.from_blend) * way_px_;
    attach_at(place + rest_of_last, {.field = motion.field}, read);
    return rest_of_last + motion.to_blend * way_px_;
}

void MaterialPoint::attach_at(Vec2 place, const SurfaceMotion& motion, PlaceBox& read) noexcept {
    if (motion.field == nullptr) return forget();
    way_px_ = way_through(*motion.field, place, motion.to_blend, way_px_, read);
}

}  // namespace dibhr
