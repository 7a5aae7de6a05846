// Over TRIANGLEs, from EDGE to EDGE, towards the goal's foot on each: the inner loop of DIBHR.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <glm/geometric.hpp>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// Goes from TRIANGLE to TRIANGLE while the next one leads nearer to the goal. It is one loop over
/// values that the compiler keeps in registers, with a branch for each direction of EDGE, which
/// the processor predicts instead of waiting for a crossing.
class Glide {
  public:
    /// Why the glide ended.
    enum class End {
        none,
        plane,   ///< only inside run(): goes on over a third TRIANGLE of one plane
        above,   ///< the goal is above the TRIANGLE
        held,    ///< friction holds the proxy
        cone,    ///< the way enters the friction cone in the TRIANGLE
        crease,  ///< the TRIANGLE behind the EDGE leads back to it
        stop,    ///< on a VERTEX, at the image's border, or after the last move
    };

    /// What stays the same during a glide.
    struct Context {
        const DepthSurface& surface;
        Vec3 goal;
        double moving;  ///< squared coefficient of friction for a proxy that moves
        int most_moves;
    };

    /// The proxy in the TRIANGLE `facet`; `holding` is the squared coefficient while it has not
    /// moved.
    Glide(const Context& course, Vec3 position, int moves, double holding, const Facet& facet,
          const Facet::Projection& goal_on) noexcept
        : context_(course),
          position_(position),
          moves_(moves),
          holding_(holding),
          facet_(facet),
          goal_on_(goal_on) {}

    [[gnu::always_inline]] End run() noexcept {
        if (goal_on_.rise > 0.0) return End::above;
        exit_ = exit_of(facet_, position_, goal_on_.foot);
        for (;;) {
            while (end_ == End::none) advance();
            if (end_ != End::plane) return end_;
            end_ = End::none;
            cross_plane();
        }
    }

    [[nodiscard]] Vec3 position() const noexcept { return position_; }
    [[nodiscard]] int moves() const noexcept { return moves_; }
    /// True: the proxy is on an EDGE that it crossed; false: in its first TRIANGLE.
    [[nodiscard]] bool crossed() const noexcept { return crossed_; }
    /// The TRIANGLE in which, or on whose EDGE, the glide ended.
    [[nodiscard]] const Facet& facet() const noexcept { return facet_; }
    [[nodiscard]] const Facet::Projection& goal_on() const noexcept { return goal_on_; }
    /// The squared length of the way to the foot.
    [[nodiscard]] double length2() const noexcept { return length2_; }
    /// After `crease` and `stop`: the VERTEX or EDGE that was reached.
    [[nodiscard]] Primitive border() const noexcept {
        const Primitive edge = edge_of(facet_.triangle(), behind_);
        if (!on_vertex_) return edge;
        const EdgeEnds ends = ends_of(edge);
        const bool at_begin = position_.x == ends.begin_i && position_.y == ends.begin_j;
        return at_begin ? vertex(ends.begin_i, ends.begin_j) : vertex(ends.end_i, ends.end_j);
    }

  private:
    /// An EDGE crossed at the foot itself is crossed: the TRIANGLE behind it may lead on.
    static constexpr double kPastFoot = 1.0 + 1e-11;

    /// Crosses one TRIANGLE, unless friction holds the proxy. The two signs alternate; each has its
    /// own code.
    [[gnu::always_inline]] void advance() noexcept {
        const Vec3 way = goal_on_.foot - position_;
        length2_ = glm::dot(way, way);
        const double holding2 = holding_ * goal_on_.distance2;
        if (length2_ <= holding2 * kConeRounding + square(kArrived_px)) return end(End::held);
        if (ends_before(exit_.t)) return end(End::cone);
        if (facet_.sign() > 0) {
            facet_.assume_sign<1>();
            cross_exit();
        } else {
            facet_.assume_sign<-1>();
            cross_exit();
        }
    }

    /// Whether the way ends in this TRIANGLE: at the foot, or on the cone around it.
    [[gnu::always_inline, nodiscard]] bool ends_before(double t) const noexcept {
        return t > kPastFoot || square(1.0 - t) * length2_ < context_.moving * goal_on_.distance2;
    }

    [[gnu::always_inline]] void cross_exit() noexcept {
        switch (exit_.through) {
            case EdgeDirection::along_row:
                return cross<EdgeDirection::along_row>();
            case EdgeDirection::along_column:
                return cross<EdgeDirection::along_column>();
            case EdgeDirection::diagonal:
                return cross<EdgeDirection::diagonal>();
        }
    }

    template <EdgeDirection kThrough>
    [[gnu::always_inline]] void cross() noexcept {
        behind_ = kThrough;
        const Facet::Across across =
            facet_.step_across<kThrough>(context_.surface, elevation_across<kThrough>());
        if (across == Facet::Across::border || moves_ >= context_.most_moves) {
            move_to_crossing<kThrough>();
            return end(End::stop);
        }
        moves_ += 2;  // the EDGE, and the TRIANGLE behind it
        if (across == Facet::Across::other_plane) return arrive<kThrough>();
        // On a plane the way stays straight: the proxy need not stop at its EDGEs.
        if (on_plane_) return end(End::plane);
        on_plane_ = true;
        second_ = facet_;
        exit_ = exit_on_plane<kThrough>(facet_, position_, goal_on_.foot);
        read_ahead<kThrough>();
    }

    /// Reads the elevations across both EDGEs ahead before it is known which one is crossed, so
    /// that a wrong branch prediction does not wait for memory. Not over a bump map: its
    /// elevations cost too much.
    template <EdgeDirection kBehind>
    [[gnu::always_inline]] void read_ahead() noexcept {
        has_read_ = !context_.surface.has_bump();
        if (!has_read_) return;
        if (kBehind != EdgeDirection::along_row) read_across<EdgeDirection::along_row>();
        if (kBehind != EdgeDirection::along_column) read_across<EdgeDirection::along_column>();
        if (kBehind != EdgeDirection::diagonal) read_across<EdgeDirection::diagonal>();
    }

    template <EdgeDirection kThrough>
    [[gnu::always_inline]] void read_across() noexcept {
        across_[index_of(kThrough)] = facet_.elevation_across<kThrough>(context_.surface);
    }

    template <EdgeDirection kThrough>
    [[gnu::always_inline]] double elevation_across() const noexcept {
        return has_read_ ? across_[index_of(kThrough)]
                         : facet_.elevation_across<kThrough>(context_.surface);
    }

    [[nodiscard]] static constexpr std::size_t index_of(EdgeDirection direction) noexcept {
        return static_cast<std::size_t>(direction);
    }

    /// On an EDGE, with a TRIANGLE of another plane behind it.
    template <EdgeDirection kThrough>
    [[gnu::always_inline]] void arrive() noexcept {
        on_plane_ = false;
        crossed_ = true;
        read_ahead<kThrough>();
        move_to_crossing<kThrough>();
        if (end_ != End::none) return;
        goal_on_ = facet_.project(context_.goal);
        const Barycentric at_foot = facet_.barycentric(goal_on_.foot.x, goal_on_.foot.y);
        if (at_foot.across(kThrough) <= kArrived_px) return end(End::crease);
        if (goal_on_.rise > 0.0) return end(End::above);
        exit_ = exit_of<kThrough>(facet_.barycentric(position_.x, position_.y), at_foot);
    }

    /// Crosses all TRIANGLEs of the plane in one run.
    [[gnu::always_inline]] void cross_plane() noexcept {
        StraightWay way(position_, goal_on_.foot, second_);
        way.over_next_edge(second_.sign(), [](auto, double) {});  // into the third: facet_
        Facet here = facet_;  // a local value stays in registers
        const auto cross = [&]<EdgeDirection kThrough>(
                               std::integral_constant<EdgeDirection, kThrough>, double t) {
            exit_ = {kThrough, t};
            if (ends_before(t)) return End::cone;
            const Facet::Across across = here.step_across<kThrough>(
                context_.surface, here.elevation_across<kThrough>(context_.surface));
            if (across == Facet::Across::border || moves_ >= context_.most_moves) return End::stop;
            moves_ += 2;
            return across == Facet::Across::same_plane ? End::none : End::plane;
        };
        End ended = End::none;
        while (ended == End::none) ended = way.over_next_edge(here.sign(), cross);
        facet_ = here;
        if (ended == End::cone) return end(End::cone);
        behind_ = exit_.through;
        switch (behind_) {
            case EdgeDirection::along_row:
                return leave_plane<EdgeDirection::along_row>(ended);
            case EdgeDirection::along_column:
                return leave_plane<EdgeDirection::along_column>(ended);
            case EdgeDirection::diagonal:
                return leave_plane<EdgeDirection::diagonal>(ended);
        }
    }

    template <EdgeDirection kThrough>
    [[gnu::always_inline]] void leave_plane(End ended) noexcept {
        if (ended != End::stop) return arrive<kThrough>();
        move_to_crossing<kThrough>();
        end(End::stop);
    }

    /// To the crossing, on the grid line itself, so that round-off never leaves a point beside the
    /// EDGE it is on; or to the VERTEX it hits exactly, which ends the glide.
    template <EdgeDirection kThrough>
    [[gnu::always_inline]] void move_to_crossing() noexcept {
        const Vec3 from = position_;
        const Vec3& foot = goal_on_.foot;
        const int back = facet_.sign() > 0 ? 0 : 1;  // from the corner to the EDGE's begin
        const int begin_x = facet_.corner_x() - back;
        const int begin_y = facet_.corner_y() - back;
        double along = 0.0;  // in [0, 1]
        if constexpr (kThrough == EdgeDirection::along_row) {
            const double x = from.x + exit_.t * (foot.x - from.x);
            along = on_edge(x - begin_x);
            position_.x = on_vertex_ ? begin_x + along : x;
            position_.y = facet_.corner_y();
        } else if constexpr (kThrough == EdgeDirection::along_column) {
            const double y = from.y + exit_.t * (foot.y - from.y);
            along = on_edge(y - begin_y);
            position_.y = on_vertex_ ? begin_y + along : y;
            position_.x = facet_.corner_x();
        } else {
            const double x = from.x + exit_.t * (foot.x - from.x);
            along = on_edge(begin_x + 1 - x);
            position_.x = begin_x + 1 - along;
            position_.y = begin_y + along;
        }
        const EdgeElevations z = facet_.elevations_along(kThrough);
        position_.z = z.begin + along * (z.end - z.begin);
        const Vec3 gone = position_ - from;
        if (!moved_ && glm::dot(gone, gone) > square(kArrived_px)) {
            moved_ = true;
            holding_ = context_.moving;
        }
    }

    /// The place clamped to the EDGE. At one of its ends the glide ends.
    [[gnu::always_inline]] double on_edge(double along) noexcept {
        if (along > 0.0 && along < 1.0) return along;
        on_vertex_ = true;
        end(End::stop);
        return along > 0.0 ? 1.0 : 0.0;
    }

    [[gnu::always_inline]] void end(End by) noexcept { end_ = by; }

    Context context_;
    Vec3 position_;
    int moves_;
    double holding_;
    bool moved_{false};
    bool crossed_{false};
    Facet facet_;
    Facet::Projection goal_on_;
    double length2_{0.0};
    Exit exit_{};
    EdgeDirection behind_{EdgeDirection::diagonal};
    bool on_vertex_{false};
    bool on_plane_{false};
    Facet second_{};                  ///< second TRIANGLE of the plane
    std::array<double, 3> across_{};  ///< elevation across each EDGE but the one behind
    bool has_read_{false};            ///< `across_` is filled
    End end_{End::none};
};

}  // namespace dibhr
