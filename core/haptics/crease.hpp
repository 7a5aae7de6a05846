// Straight runs along collinear EDGEs: a crease between two planes, walked at once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"
#include "core/haptics/vertex_fan.hpp"

namespace dibhr {

/// A straight run of EDGEs that starts at a VERTEX along one of its spokes, between the same two
/// planes. Every decision on the run is linear in the distance along it: what is clearly true at
/// the first and at the last VERTEX is true at all between them.
class CreaseAhead {
  public:
    /// The proxy comes to `vertex` along the spoke before it in the same direction, on its way to
    /// the goal's foot on the line.
    CreaseAhead(const DepthSurface& surface, const Primitive& vertex, std::size_t spoke,
                Vec3 goal) noexcept
        : surface_(surface), at_(vertex), spoke_(spoke), goal_(goal) {}

    /// How many of the EDGEs, `most` or fewer, the walk would follow one after the other. The
    /// goal's foot on the line is at least one EDGE beyond them.
    [[nodiscard]] int count(int most) const noexcept {
        if (most < kWorthwhile || !continues_straight()) return 0;
        const VertexFan fan(surface_, at_);
        if (!fan.is_whole() || !is_crease(fan)) return 0;
        most = std::min(most, preferred_for(fan, most));
        return same_ground(fan, most);
    }

  private:
    /// A run of fewer EDGEs is walked as fast one by one.
    static constexpr int kWorthwhile = 2;
    static constexpr double kOnLine_px = 1e-11;
    /// A decision by less than this, in pixels or in shares of a corner, is in doubt.
    static constexpr double kDoubt = 1e-8;

    [[nodiscard]] std::size_t around(std::size_t steps) const noexcept {
        return (spoke_ + steps) % kSpokes.size();
    }

    /// The elevation of the VERTEX n EDGEs ahead, or of its neighbour `aside`.
    [[nodiscard]] double elevation(int n, Step aside) const noexcept {
        const Step ahead = kSpokes[spoke_];
        return surface_.elevation(at_.i + n * ahead.i + aside.i, at_.j + n * ahead.j + aside.j);
    }

    [[nodiscard]] bool has(int n, Step aside) const noexcept {
        const Step ahead = kSpokes[spoke_];
        return surface_.has_vertex(at_.i + n * ahead.i + aside.i, at_.j + n * ahead.j + aside.j);
    }

    /// The next EDGE has the slope of the last one. On rough ground this one test ends the search.
    [[nodiscard]] bool continues_straight() const noexcept {
        constexpr Step kHere{0, 0};
        if (!has(1, kHere) || !has(-1, kHere)) return false;
        const double z = elevation(0, kHere);
        return std::abs(elevation(1, kHere) - z - (z - elevation(-1, kHere))) <= kOnLine_px;
    }

    /// Both TRIANGLEs beside the next EDGE lead back to it, and the goal is above neither.
    [[nodiscard]] bool is_crease(const VertexFan& fan) const noexcept {
        for (const std::size_t k : {around(0), around(5)}) {
            const Facet facet = fan.facet(k);
            const Facet::Projection goal_on = facet.project(goal_);
            const Barycentric at_foot = facet.barycentric(goal_on.foot.x, goal_on.foot.y);
            if (at_foot.across(direction_of_spoke(spoke_)) > -kDoubt) return false;
            if (goal_on.rise > -kDoubt) return false;
        }
        return true;
    }

    /// For how many VERTEXes this spoke remains the steepest way to the goal. Its advantage over
    /// another spoke changes by the same amount at each VERTEX.
    [[nodiscard]] int preferred_for(const VertexFan& fan, int most) const noexcept {
        const Vec3 ahead = fan.along(spoke_);
        const Vec3 unit = ahead / std::sqrt(glm::dot(ahead, ahead));
        const Vec3 to_goal = goal_ - Vec3(at_.i, at_.j, fan.elevation());
        const double doubt = kDoubt * (1.0 + glm::length(to_goal));
        double preferred = most;
        for (std::size_t k = 1; k < kSpokes.size(); ++k) {
            const Vec3 along = fan.along(around(k));
            const Vec3 better = unit - along / std::sqrt(glm::dot(along, along));
            const double by = glm::dot(to_goal, better) - doubt;
            if (by <= 0.0) return 0;
            const double less = glm::dot(ahead, better);
            if (less > 0.0) preferred = std::min(preferred, by / less);
        }
        return static_cast<int>(preferred);
    }

    /// For how many EDGEs the line, and the rows on both sides of it, keep their slopes.
    [[nodiscard]] int same_ground(const VertexFan& fan, int most) const noexcept {
        const double rise = fan.along(spoke_).z;
        const Step one_side = kSpokes[around(1)];
        const Step other_side = kSpokes[around(5)];
        const double here = fan.elevation();
        const double one = here + fan.along(around(1)).z;
        const double other = here + fan.along(around(5)).z;
        const auto differs = [&](int n, Step aside, double first) {
            return !has(n, aside) ||
                   !(std::abs(elevation(n, aside) - (first + n * rise)) <= kOnLine_px);
        };
        // The rows' VERTEXes behind the first one are on their lines, too.
        if (differs(-1, one_side, one) || differs(-1, other_side, other)) return 0;
        int n = 0;
        while (n < most && !differs(n + 1, {0, 0}, here) && !differs(n, one_side, one) &&
               !differs(n, other_side, other)) {
            ++n;
        }
        return n;
    }

    const DepthSurface& surface_;
    Primitive at_;
    std::size_t spoke_;
    Vec3 goal_;
};

}  // namespace dibhr
