// The steps in depth along the edges of the drawn grid.
#include "render/outline_ramps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dibhr {
namespace {

constexpr int kMostUnits = 2;  // of a ramp before and after its steepest unit
// Of the steepest unit's rise; a ramp ends where it rises less.
constexpr float kEndOfRamp = 0.3F;
constexpr float kOnFace = 0.05F;  // share of a step; a vertex nearer to a face is on it
constexpr int kRing = 2;  // units beside a ramp, in which a filter may have made it overshoot
constexpr float kOvershoot = 0.15F;  // share of a step, at most
constexpr float kSameStep = 0.7F;    // of the highest rise in a cell; lower ones are not its step

}  // namespace

/// The elevations on the straight line through two drawn vertices, by pixels from the first one.
class OutlineRamps::Line {
  public:
    Line(const OutlineRamps& ramps, glm::ivec2 from, glm::ivec2 to)
        : elevation_(ramps.elevation_),
          pixels_(std::max(std::abs(to.x - from.x), std::abs(to.y - from.y))) {
        const auto sign = [](int d) { return (d > 0) - (d < 0); };
        const glm::ivec2 towards{sign(to.x - from.x), sign(to.y - from.y)};
        const glm::ivec2 size{ramps.image_.columns, ramps.image_.rows};
        first_ = static_cast<std::ptrdiff_t>(ramps.image_.index(from.x, from.y));
        stride_ = towards.x + std::ptrdiff_t{towards.y} * size.x;
        for (int axis = 0; axis < 2; ++axis) {
            if (towards[axis] == 0) continue;
            const int before = from[axis];
            const int after = size[axis] - 1 - from[axis];
            least_ = std::max(least_, -(towards[axis] > 0 ? before : after));
            most_ = std::min(most_, towards[axis] > 0 ? after : before);
        }
    }
    [[nodiscard]] int pixels() const { return pixels_; }
    [[nodiscard]] int inside(int k) const { return std::clamp(k, least_, most_); }
    [[nodiscard]] float operator()(int k) const {
        return elevation_(static_cast<std::size_t>(first_ + inside(k) * stride_));
    }

  private:
    const PixelElevation& elevation_;
    int pixels_;
    std::ptrdiff_t first_{0};
    std::ptrdiff_t stride_{0};
    int least_{std::numeric_limits<int>::min()};
    int most_{std::numeric_limits<int>::max()};
};

std::optional<OutlineRamps::Ramp> OutlineRamps::along(GridPlace from, GridPlace to,
                                                      float least_px) const {
    const Line at(*this, {grid_.image_i(from.i), grid_.image_j(from.j)},
                  {grid_.image_i(to.i), grid_.image_j(to.j)});
    // The steepest unit on the edge.
    const int last = std::max(at.pixels() - unit_, 0);
    int begin = 0;
    float steepest = 0.0F;
    for (int k = 0; k <= last; ++k) {
        const float rise = at(k + unit_) - at(k);
        if (std::abs(rise) <= std::abs(steepest)) continue;
        steepest = rise;
        begin = k;
    }
    if (!(std::abs(steepest) > least_px)) return std::nullopt;
    // The ramp goes on, before and after it, as long as it is nearly as steep.
    int end = at.inside(begin + unit_);
    const auto goes_on = [&](int k, int next) {
        const float rise = (at(next) - at(k)) * (steepest < 0.0F ? -1.0F : 1.0F);
        return rise > kEndOfRamp * std::abs(steepest);
    };
    for (int n = 0; n < kMostUnits && goes_on(at.inside(begin - unit_), begin); ++n)
        begin = at.inside(begin - unit_);
    for (int n = 0; n < kMostUnits && goes_on(end, at.inside(end + unit_)); ++n)
        end = at.inside(end + unit_);
    // And to the pixel, for a vertex may be on its last part of a unit.
    const float least_rise = kEndOfRamp * std::abs(steepest) / static_cast<float>(unit_);
    const auto rises = [&](int k, int next) {
        return (at(next) - at(k)) * (steepest < 0.0F ? -1.0F : 1.0F) > least_rise;
    };
    for (int n = 1; n < unit_ && rises(begin - 1, begin); ++n) begin = at.inside(begin - 1);
    for (int n = 1; n < unit_ && rises(end, end + 1); ++n) end = at.inside(end + 1);
    // A filter that overshoots has left a ring beside the ramp, which is on no face.
    const float rise_px = at(end) - at(begin);
    const auto after_ring = [&](int face, int towards) {
        int after = face;
        for (int n = 1; n <= kRing; ++n) {
            const int next = at.inside(face + n * towards);
            const auto overshoot = [&](int k) {
                return (towards < 0 ? -1.0F : 1.0F) * (at(face) - at(k)) / rise_px;
            };
            if (overshoot(next) > overshoot(after) && overshoot(next) < kOvershoot) after = next;
        }
        return after;
    };
    const int low = after_ring(begin, -unit_);
    const int high = after_ring(end, unit_);
    Ramp ramp{at(low), at(high), {}};
    const auto on_ramp = [&](int k) {
        const float share = (at(k) - ramp.low_px) / (ramp.high_px - ramp.low_px);
        return k > low && k < high && std::abs(share) > kOnFace && std::abs(share - 1.0F) > kOnFace;
    };
    ramp.on_ramp = {on_ramp(0), on_ramp(at.pixels())};
    if (ramp.low_px > ramp.high_px) std::swap(ramp.low_px, ramp.high_px);
    return ramp;
}

std::optional<CellFaces> OutlineRamps::in_cell(GridPlace cell, float least_px) const {
    constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
        {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};
    const std::array<GridPlace, 4> corners = corners_of(cell);
    std::array<std::optional<Ramp>, kEdges.size()> ramps{};
    float highest = 0.0F;
    for (std::size_t k = 0; k < kEdges.size(); ++k) {
        ramps[k] = along(corners[kEdges[k][0]], corners[kEdges[k][1]], least_px);
        if (ramps[k]) highest = std::max(highest, ramps[k]->high_px - ramps[k]->low_px);
    }
    if (!(highest > 0.0F)) return std::nullopt;
    CellFaces faces;
    float count = 0.0F;
    for (std::size_t k = 0; k < kEdges.size(); ++k) {
        if (!ramps[k] || ramps[k]->high_px - ramps[k]->low_px < kSameStep * highest) continue;
        faces.ends_px += glm::vec2(ramps[k]->low_px, ramps[k]->high_px);
        count += 1.0F;
        for (std::size_t end = 0; end < 2; ++end)
            faces.on_ramp[kEdges[k][end]] = faces.on_ramp[kEdges[k][end]] || ramps[k]->on_ramp[end];
    }
    faces.ends_px /= count;
    return faces;
}

}  // namespace dibhr
