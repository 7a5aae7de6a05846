// The walk from constraint to constraint, and the nearest point that the constraints allow.
#include "core/haptics/god_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>

#include <glm/geometric.hpp>

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// Planes at less than about a millionth of a radian are one plane.
constexpr double kParallel = 1e-12;

/// A half-space that the proxy may not leave, relative to the goal.
struct ConstraintPlane {
    Vec3 normal{0.0};   ///< out of the solid, any length
    double below{0.0};  ///< how far the goal is inside the solid, times |normal|

    bool operator==(const ConstraintPlane&) const = default;
};

/// From the goal to the nearest point of planes that all hold the proxy back from it; nothing where
/// they do not.
std::optional<Vec3> bound_by(const ConstraintPlane& plane) noexcept {
    const auto& [n, below] = plane;
    if (below <= 0.0) return std::nullopt;
    return below / glm::dot(n, n) * n;
}

std::optional<Vec3> bound_by(const ConstraintPlane& first, const ConstraintPlane& second) noexcept {
    const auto& [n1, below1] = first;
    const auto& [n2, below2] = second;
    const double n11 = glm::dot(n1, n1);
    const double n12 = glm::dot(n1, n2);
    const double n22 = glm::dot(n2, n2);
    const Vec3 line = glm::cross(n1, n2);
    const double determinant = glm::dot(line, line);
    if (determinant <= kParallel * n11 * n22) return std::nullopt;
    const double push1 = below1 * n22 - below2 * n12;
    const double push2 = below2 * n11 - below1 * n12;
    if (push1 < 0.0 || push2 < 0.0) return std::nullopt;
    return (push1 * n1 + push2 * n2) / determinant;
}

std::optional<Vec3> bound_by(const ConstraintPlane& first, const ConstraintPlane& second,
                             const ConstraintPlane& third) noexcept {
    const auto& [n1, below1] = first;
    const auto& [n2, below2] = second;
    const auto& [n3, below3] = third;
    const Vec3 along1 = glm::cross(n2, n3);
    const Vec3 along2 = glm::cross(n3, n1);
    const Vec3 along3 = glm::cross(n1, n2);
    const double volume = glm::dot(n1, along1);
    if (volume * volume <= kParallel * glm::dot(n1, n1) * glm::dot(n2, n2) * glm::dot(n3, n3)) {
        return std::nullopt;
    }
    const Vec3 point = (below1 * along1 + below2 * along2 + below3 * along3) / volume;
    // point = sum of push_k n_k, so push_k volume = point . along_k.
    for (const Vec3& along : {along1, along2, along3}) {
        if (glm::dot(point, along) * volume < 0.0) return std::nullopt;
    }
    return point;
}

/// The planes found at one place. At most three of them bind at the nearest point; the others are
/// kept because another three may bind next.
class ConstraintPlanes {
  public:
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    void clear() noexcept { count_ = 0; }

    /// False when the plane is in the list already or the list is full: the proxy cannot go on.
    [[nodiscard]] bool add(const ConstraintPlane& plane) noexcept {
        const auto held = std::span(planes_).first(count_);
        if (count_ == kRoom || std::find(held.begin(), held.end(), plane) != held.end()) {
            return false;
        }
        planes_[count_++] = plane;
        return true;
    }

    /// The point nearest to `goal` in all half-spaces, which Zilles and Salisbury find with a
    /// Lagrange multiplier a plane: those that push outwards bind. Every set of one, two or three
    /// planes is tried, the smallest first. Nothing if planes that are nearly parallel leave none.
    [[nodiscard]] std::optional<Vec3> nearest_to(Vec3 goal) noexcept {
        const auto& p = planes_;
        for (std::size_t a = 0; a < count_; ++a) {
            if (const auto way = bound_by(p[a]); binds(way, {a})) return goal + *way;
        }
        for (std::size_t a = 0; a < count_; ++a) {
            for (std::size_t b = a + 1; b < count_; ++b) {
                if (const auto way = bound_by(p[a], p[b]); binds(way, {a, b})) return goal + *way;
            }
        }
        for (std::size_t a = 0; a < count_; ++a) {
            for (std::size_t b = a + 1; b < count_; ++b) {
                for (std::size_t c = b + 1; c < count_; ++c) {
                    const auto way = bound_by(p[a], p[b], p[c]);
                    if (binds(way, {a, b, c})) return goal + *way;
                }
            }
        }
        return std::nullopt;
    }

    /// Forgets the planes that did not bind at the last nearest point: the proxy has gone off them.
    void keep_binding() noexcept {
        for (std::size_t k = 0; k < binding_count_; ++k) planes_[k] = planes_[binding_[k]];
        count_ = binding_count_;
    }

  private:
    // Six TRIANGLEs meet at a VERTEX, two walls in a corner.
    static constexpr std::size_t kRoom = 8;

    /// No plane forbids the point: these are the ones that bind, in rising order.
    bool binds(const std::optional<Vec3>& from_goal,
               std::initializer_list<std::size_t> these) noexcept {
        if (!from_goal) return false;
        for (const auto& [n, below] : std::span(planes_).first(count_)) {
            if (glm::dot(n, *from_goal) < below - kTouchDepth_px) return false;
        }
        std::copy(these.begin(), these.end(), binding_.begin());
        binding_count_ = these.size();
        return true;
    }

    std::array<ConstraintPlane, kRoom> planes_{};
    std::size_t count_{0};
    std::array<std::size_t, 3> binding_{};
    std::size_t binding_count_{0};
};

class ConstraintWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        visit_until_rest([this] {
            if (planes_.empty() && (makes_no_progress() || !touch_on_way_to_goal()))
                return Next::rest;
            return go_as_near_as_allowed();
        });
        if (proxy_.contact) settle();
    }

  private:
    /// On the surface; or in the air, where the last move was spent over a ridge and the goal is
    /// not below the surface.
    void settle() noexcept {
        Vec3& p = proxy_.position;
        const double ground = surface_.elevation_at(p.x, p.y);
        if (proxy_.bound_met && p.z > ground + kSettled_px && !stay_on_surface())
            return lose_contact();
        // Round-off of planes that are nearly parallel, with the goal far below them, and of moves
        // to and fro beside a cliff.
        const double off = std::abs(p.z - ground);
        if (off > kRoundOff_px && off <= kMostRoundOff_px) p.z = ground;
        proxy_.active = surface_.triangle_at(p.x, p.y);
    }

    void lose_contact() noexcept {
        proxy_.contact = false;
        proxy_.slipping = false;
        proxy_.active = Primitive{};
    }

    /// In a valley so flat that round-off carries the proxy to and fro between its two sides.
    bool makes_no_progress() noexcept {
        const bool is_near =
            squared_distance(proxy_.position, last_found_) <= square(kNoProgress_px);
        idle_passes_ = is_near ? idle_passes_ + 1 : 0;
        last_found_ = proxy_.position;
        return idle_passes_ > kMostIdlePasses;
    }

    /// Straight to the goal, onto the first plane in the way. False: there is none, the proxy is at
    /// the goal or at the end of its last move.
    bool touch_on_way_to_goal() noexcept {
        const Flight flight = fly_to(goal_);
        if (flight.cut_short) {  // `settle` finds whether it is on the ground
            proxy_.position = flight.end;
            return false;
        }
        if (!flight.ground) {
            proxy_.position = flight.end;
            lose_contact();
            return false;
        }
        go(flight.end);
        found_here_ = true;
        return planes_.add(plane_of(*flight.ground));
    }

    Next go_as_near_as_allowed() noexcept {
        const std::optional<Vec3> nearest = planes_.nearest_to(goal_);
        if (!nearest) return rest_if_held_here();
        const ConeView view = cone_view(*nearest);
        if (is_held(view)) return rest_if_held_here();
        const WayInFrame way = way_in_frame(enters_cone(view) ? place_on_cone(view) : *nearest);
        const Flight flight = fly_to(way.end);
        if (flight.ground) return stop_at_plane(plane_of(*flight.ground), flight.end);
        if (way.wall && !flight.cut_short) return stop_at_plane(*way.wall, way.end);
        if (!go(flight.end)) return rest_if_held_here();
        planes_.clear();  // what it touches there is found by the next visit
        return Next::visit;
    }

    Next stop_at_plane(const ConstraintPlane& plane, Vec3 place) noexcept {
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

    /// False: the place differs from the proxy's by round-off alone.
    bool go(Vec3 place) noexcept {
        if (squared_distance(place, proxy_.position) <= square(kSettled_px)) return false;
        move_to(place);
        found_here_ = false;
        return true;
    }

    [[nodiscard]] ConstraintPlane plane_of(const Primitive& triangle) const noexcept {
        const Facet facet(surface_, triangle);
        return {facet.normal(), facet.elevation_at(goal_.x, goal_.y) - goal_.z};
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

    /// Several times kTouchDepth_px, by which a collision lets the proxy sink in.
    static constexpr double kSettled_px = 1e-9;
    static constexpr double kRoundOff_px = 1e-8;

    /// How often the planes may be found anew while the proxy stays within kNoProgress_px.
    static constexpr int kMostIdlePasses = 8;
    static constexpr double kNoProgress_px = 1e-6;

    /// The rise on a cliff of the greatest relief in all these passes.
    static constexpr double kMostRoundOff_px = (kMostIdlePasses + 1) * kNoProgress_px * 4096.0;

    ConstraintPlanes planes_{};
    Vec3 last_found_{0.0};  ///< where the planes were found last
    int idle_passes_{0};
    bool found_here_{false};  ///< all planes were found since the proxy moved last
};

}  // namespace

void GodObject::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                     Proxy& proxy) const noexcept {
    const int most_moves = half_over_bump(surface, kMostMoves);
    ConstraintWalk(surface, goal, friction, most_moves, proxy).run();
}

}  // namespace dibhr
