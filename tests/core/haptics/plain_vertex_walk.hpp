// The reference for PGA's cost: the shortest walk over the VERTEXes with PGA's friction, and so
// with its proxies.
#pragma once

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::test {

/// Whether a proxy can come above the ground that it rests on: then each update has to look.
enum class Leaving { never, possible };

/// From VERTEX to the neighbour nearest to the goal, while one is nearer than here and not held by
/// the friction cone; the cone stops it on its way, and it goes on from there. For goals below the
/// surface, and inside the image: it has no border, no bound and one coefficient of friction.
template <Leaving kLeaving>
class PlainVertexWalk {
  public:
    /// Starts on the surface, straight above `goal`.
    PlainVertexWalk(const DepthSurface& surface, Vec3 goal, double mu) noexcept : mu2_(mu * mu) {
        stand_on(surface.triangle_at(goal.x, goal.y),
                 {goal.x, goal.y, surface.elevation_at(goal.x, goal.y)});
    }

    /// The number of VERTEXes visited.
    [[nodiscard]] long arrivals() const noexcept { return arrivals_; }

    /// The proxy's place after the update.
    Vec3 follow(const DepthSurface& surface, Vec3 goal) noexcept {
        at_.z = neighbours_ == 0 ? surface.elevation(i_, j_) : surface.elevation_at(at_.x, at_.y);
        walk(surface, goal);
        if constexpr (kLeaving == Leaving::possible) {
            while (goal.z > ground_towards(surface, goal).elevation_at(goal.x, goal.y)) {
                const std::optional<Hit> hit = first_hit(surface, at_, goal);
                if (!hit) break;  // the goal is not below the surface
                stand_on(hit->triangle, hit->position);
                walk(surface, goal);
            }
        }
        return at_;
    }

  private:
    enum class Stop { here, on_the_way, at_the_end };
    struct Nearest {
        int way;  ///< of kAround; -1: nothing is nearer than here
        double z;
        double to_goal2;
    };

    /// From a VERTEX to itself, and to its neighbours, around it.
    static constexpr int kAround[7][2]{{0, 0}, {1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    static constexpr int kBack = 0;
    static constexpr double kOnGrid_px = 1e-12;

    static int before(int way) noexcept { return way == 1 ? 6 : way - 1; }
    static int after(int way) noexcept { return way == 6 ? 1 : way + 1; }
    static double squared(Vec3 v) noexcept { return glm::dot(v, v); }

    void stand_on(const Primitive& triangle, Vec3 position) noexcept {
        const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
        i_ = triangle.i + far;
        j_ = triangle.j + far;
        first_ = 1 + 3 * far;
        neighbours_ = 2;
        at_ = position;
    }

    /// The TRIANGLE around the proxy on whose side the goal is.
    Facet ground_towards(const DepthSurface& surface, Vec3 goal) const noexcept {
        if (neighbours_ == 2) return {surface, surface.triangle_at(at_.x, at_.y)};
        if (neighbours_ == 0) {
            return {surface, triangle_around(surface, vertex(i_, j_), goal.x, goal.y)};
        }
        const int* const step = kAround[after(first_)];
        const Primitive on = edge_between(i_, j_, i_ + step[0], j_ + step[1]);
        return {surface, triangle_towards(surface, on, goal.x, goal.y)};
    }

    void walk(const DepthSurface& surface, Vec3 goal) noexcept {
        if (neighbours_ != 0 && !is_on_vertex() && !arrive(surface, goal)) return;
        double here2 = squared(at_ - goal);
        unsigned held = 0;
        for (int first = 1, count = 6;;) {
            Nearest to{-1, 0.0, here2};
            look(surface, goal, first, count, held, to);
            if (to.way < 0) return;
            const Stop stop = go(goal, to);
            if (stop == Stop::on_the_way) {
                neighbours_ = 3;  // the EDGE's other end, and the corners on both sides of it
                first_ = before(to.way);
                return;
            }
            if (stop == Stop::here) {
                held |= 1U << to.way;
                continue;
            }
            here2 = to.to_goal2;
            // Of the next one's six, three lie ahead; but one that was held back may be nearer.
            first = held == 0 ? before(to.way) : 1;
            count = held == 0 ? 3 : 6;
            held = 0;
        }
    }

    /// The cone may have stopped it there.
    bool is_on_vertex() noexcept {
        const int i = static_cast<int>(at_.x + 0.5);
        const int j = static_cast<int>(at_.y + 0.5);
        if (std::abs(at_.x - i) > kOnGrid_px || std::abs(at_.y - j) > kOnGrid_px) return false;
        i_ = i;
        j_ = j;
        neighbours_ = 0;
        return true;
    }

    /// From between VERTEXes on to the nearest of them; false if it does not get there.
    bool arrive(const DepthSurface& surface, Vec3 goal) noexcept {
        const double here2 = squared(at_ - goal);
        for (unsigned held = 0;;) {
            Nearest to{-1, 0.0, here2};
            look(surface, goal, first_, neighbours_, held, to);
            look(surface, goal, kBack, 1, held, to);
            if (to.way < 0) return false;
            const Stop stop = go(goal, to);
            if (stop == Stop::at_the_end) {
                neighbours_ = 0;
                return true;
            }
            if (stop == Stop::here) {
                held |= 1U << to.way;
                continue;
            }
            // Off its EDGE it is on a TRIANGLE, and has only that one's corners around it.
            if (neighbours_ == 3 && to.way != kBack && to.way != after(first_)) {
                if (to.way != first_) first_ = after(first_);
                neighbours_ = 2;
            }
            return false;
        }
    }

    /// Searches a neighbour nearer than `nearest`: `count` of them from `first` on, no held ones.
    void look(const DepthSurface& surface, Vec3 goal, int first, int count, unsigned held,
              Nearest& nearest) const noexcept {
        for (int k = first; k < first + count; ++k) {
            const int way = k <= 6 ? k : k - 6;
            if (((held >> way) & 1U) != 0) continue;
            const int i = i_ + kAround[way][0];
            const int j = j_ + kAround[way][1];
            const double z = surface.elevation(i, j);
            const double to_goal2 = squared(Vec3{i, j, z} - goal);
            if (to_goal2 < nearest.to_goal2) nearest = {way, z, to_goal2};
        }
    }

    /// To a neighbour, as far as the friction cone lets it.
    Stop go(Vec3 goal, const Nearest& to) noexcept {
        const int i = i_ + kAround[to.way][0];
        const int j = j_ + kAround[to.way][1];
        const Vec3 end{i, j, to.z};
        const Vec3 piece = end - at_;
        const double length2 = squared(piece);
        const double along = glm::dot(goal - at_, piece);  // to the goal's foot; times the length
        const double radius2 = mu2_ * squared(glm::cross(goal - at_, piece));
        if (along * along <= radius2) return Stop::here;
        const double beyond = along - length2;
        if (beyond >= 0.0 && beyond * beyond >= radius2) {
            at_ = end;
            i_ = i;
            j_ = j;
            ++arrivals_;
            return Stop::at_the_end;
        }
        at_ += (along - std::sqrt(radius2)) / length2 * piece;
        return Stop::on_the_way;
    }

    Vec3 at_{0.0};
    double mu2_;
    int i_{0}, j_{0};    ///< the VERTEX it is at or came from
    int first_{0};       ///< of kAround: the first of the neighbours that it is among
    int neighbours_{0};  ///< how many: 0 at a VERTEX, 2 on a TRIANGLE, 3 on an EDGE
    long arrivals_{0};
};

}  // namespace dibhr::test
