// The planes a god-object is held by, and the point nearest to the goal that they allow.
#pragma once

#include <array>
#include <optional>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// A half-space that the proxy may not leave, as the goal sees it.
struct ConstraintPlane {
    Vec3 normal{0.0};   ///< out of the solid, any length
    double below{0.0};  ///< how far the goal is inside the solid, times |normal|

    bool operator==(const ConstraintPlane&) const = default;
};

/// The planes met at one place. At most three of them bind at the nearest point; the others are
/// kept because another three may bind next.
class ConstraintPlanes {
  public:
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    void clear() noexcept { count_ = 0; }

    /// False when the plane is held already or there is no room for it: the proxy cannot go on.
    [[nodiscard]] bool add(const ConstraintPlane& plane) noexcept;

    /// The point nearest to `goal` in all half-spaces, which Zilles and Salisbury find with a
    /// Lagrange multiplier a plane: those that push outwards bind. Nothing if planes that are
    /// nearly parallel leave none.
    [[nodiscard]] std::optional<Vec3> nearest_to(Vec3 goal) noexcept;

    /// Forgets the planes that did not bind at the last nearest point: the proxy has gone off them.
    void keep_binding() noexcept;

  private:
    static constexpr int kRoom = 8;  // six TRIANGLEs meet at a VERTEX, two walls in a corner

    [[nodiscard]] std::optional<Vec3> bound_by(int a) const noexcept;
    [[nodiscard]] std::optional<Vec3> bound_by(int a, int b) const noexcept;
    [[nodiscard]] std::optional<Vec3> bound_by(int a, int b, int c) const noexcept;
    [[nodiscard]] bool allows(Vec3 from_goal) const noexcept;

    std::array<ConstraintPlane, kRoom> planes_{};
    int count_{0};
    std::array<int, 3> binding_{};
    int binding_count_{0};
};

}  // namespace dibhr
