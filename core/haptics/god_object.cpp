// The walk from constraint to constraint.
#include "core/haptics/god_object.hpp"

#include <optional>

#include "core/haptics/collision.hpp"
#include "core/haptics/constraint_planes.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

class ConstraintWalk : private ProxyWalk {
  public:
    ConstraintWalk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                   Proxy& proxy) noexcept
        : ProxyWalk(surface, goal, friction, proxy) {}

    void run(int most_moves) noexcept {
        visit_until_rest(most_moves, [this] {
            if (planes_.empty() && (gets_nowhere() || !touch_on_way_to_goal())) return Next::rest;
            return go_as_near_as_allowed();
        });
        if (proxy_.contact) {
            proxy_.active = surface_.triangle_at(proxy_.position.x, proxy_.position.y);
        }
    }

  private:
    /// In a valley so flat that round-off carries the proxy to and fro between its two sides.
    bool gets_nowhere() noexcept {
        const bool is_near = squared_distance(proxy_.position, last_found_) <= square(kNowhere_px);
        idle_passes_ = is_near ? idle_passes_ + 1 : 0;
        last_found_ = proxy_.position;
        return idle_passes_ > kMostIdlePasses;
    }

    /// Straight to the goal, onto the first plane in the way. False: there is none, the proxy is at
    /// the goal.
    bool touch_on_way_to_goal() noexcept {
        const auto hit = first_hit(surface_, proxy_.position, goal_);
        if (!hit) {
            proxy_.position = goal_;
            proxy_.contact = false;
            proxy_.slipping = false;
            proxy_.active = Primitive{};
            return false;
        }
        go(hit->position);
        found_here_ = true;
        return planes_.add(plane_of(hit->triangle));
    }

    Next go_as_near_as_allowed() noexcept {
        const std::optional<Vec3> nearest = planes_.nearest_to(goal_);
        if (!nearest) return rest_if_held_here();
        const ConeView view = cone_view(*nearest);
        if (is_held(view)) return rest_if_held_here();
        const WayInFrame way = way_in_frame(enters_cone(view) ? place_on_cone(view) : *nearest);
        if (const auto hit = first_hit(surface_, proxy_.position, way.end)) {
            return be_held_by(plane_of(hit->triangle), hit->position);
        }
        if (way.wall) return be_held_by(*way.wall, way.end);
        if (!go(way.end)) return rest_if_held_here();
        planes_.clear();  // what it touches there is found by the next visit
        return Next::visit;
    }

    Next be_held_by(const ConstraintPlane& plane, Vec3 place) noexcept {
        if (go(place)) planes_.keep_binding();
        return planes_.add(plane) ? Next::visit : rest_if_held_here();
    }

    /// A plane the proxy came along may have ended on the way: it rests only where all planes were
    /// found at its place.
    Next rest_if_held_here() noexcept {
        if (found_here_) return Next::rest;
        planes_.clear();
        return Next::visit;
    }

    /// False when there is nothing to go: round-off is never walked after.
    bool go(Vec3 place) noexcept {
        if (squared_distance(place, proxy_.position) <= square(kSettled_px)) return false;
        move_to(place);
        found_here_ = false;
        return true;
    }

    [[nodiscard]] ConstraintPlane plane_of(const Primitive& triangle) const noexcept {
        const Facet facet(surface_, triangle);
        return {{-facet.slope_x(), -facet.slope_y(), 1.0},
                facet.elevation_at(goal_.x, goal_.y) - goal_.z};
    }

    /// A way up to the frame, and the wall it ends at.
    struct WayInFrame {
        Vec3 end{0.0};
        std::optional<ConstraintPlane> wall{};
    };

    [[nodiscard]] WayInFrame way_in_frame(Vec3 end) const noexcept {
        const Vec3 begin = proxy_.position;
        const double right = surface_.columns() - 1.0;
        const double bottom = surface_.rows() - 1.0;
        WayInFrame way{end, {}};
        double t = 1.0;
        const auto cut = [&](double from, double to, double wall, Vec3 normal, double below) {
            const double t_wall = (wall - from) / (to - from);
            if (t_wall >= t && way.wall) return;
            t = t_wall;
            way.wall = ConstraintPlane{normal, below};
        };
        if (end.x < 0.0) cut(begin.x, end.x, 0.0, {1.0, 0.0, 0.0}, -goal_.x);
        if (end.x > right) cut(begin.x, end.x, right, {-1.0, 0.0, 0.0}, goal_.x - right);
        if (end.y < 0.0) cut(begin.y, end.y, 0.0, {0.0, 1.0, 0.0}, -goal_.y);
        if (end.y > bottom) cut(begin.y, end.y, bottom, {0.0, -1.0, 0.0}, goal_.y - bottom);
        if (way.wall) way.end = surface_.clamped_to_frame(begin + t * (end - begin));
        return way;
    }

    /// Several times what a collision lets the proxy sink in.
    static constexpr double kSettled_px = 1e-9;

    /// As often as this the active planes may be found anew with the proxy no farther than that.
    static constexpr int kMostIdlePasses = 8;
    static constexpr double kNowhere_px = 1e-6;

    ConstraintPlanes planes_{};
    Vec3 last_found_{0.0};  ///< where the planes were found last
    int idle_passes_{0};
    bool found_here_{false};  ///< all planes were found since the proxy moved last
};

}  // namespace

const Proxy& GodObject::update(const DepthSurface& surface, Vec3 goal,
                               const Friction& friction) noexcept {
    const Vec3 goal_in_frame = begin_update(surface, goal);
    ConstraintWalk(surface, goal_in_frame, friction, proxy_).run(most_moves(goal_in_frame));
    return proxy_;
}

}  // namespace dibhr
