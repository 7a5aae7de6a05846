// The nearest allowed point: every set of one, two or three planes is tried, the smallest first.
#include "core/haptics/constraint_planes.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

namespace dibhr {

namespace {

/// A place this far under a plane counts as on it [px along z]: as the collision does.
constexpr double kTouchDepth_px = 1e-10;

/// Planes at less than about a millionth of a radian are one plane.
constexpr double kParallel = 1e-12;

}  // namespace

bool ConstraintPlanes::add(const ConstraintPlane& plane) noexcept {
    const auto end = planes_.begin() + count_;
    if (count_ == kRoom || std::find(planes_.begin(), end, plane) != end) return false;
    *end = plane;
    ++count_;
    return true;
}

void ConstraintPlanes::keep_binding() noexcept {
    std::array<ConstraintPlane, 3> kept{};
    for (int k = 0; k < binding_count_; ++k) {
        kept[static_cast<std::size_t>(k)] =
            planes_[static_cast<std::size_t>(binding_[static_cast<std::size_t>(k)])];
    }
    std::copy_n(kept.begin(), binding_count_, planes_.begin());
    count_ = binding_count_;
}

std::optional<Vec3> ConstraintPlanes::nearest_to(Vec3 goal) noexcept {
    const auto found = [&](std::optional<Vec3> from_goal, std::array<int, 3> binding, int count) {
        if (!from_goal || !allows(*from_goal)) return false;
        binding_ = binding;
        binding_count_ = count;
        return true;
    };
    for (int a = 0; a < count_; ++a) {
        const auto point = bound_by(a);
        if (found(point, {a}, 1)) return goal + *point;
    }
    for (int a = 0; a < count_; ++a) {
        for (int b = a + 1; b < count_; ++b) {
            const auto point = bound_by(a, b);
            if (found(point, {a, b}, 2)) return goal + *point;
        }
    }
    for (int a = 0; a < count_; ++a) {
        for (int b = a + 1; b < count_; ++b) {
            for (int c = b + 1; c < count_; ++c) {
                const auto point = bound_by(a, b, c);
                if (found(point, {a, b, c}, 3)) return goal + *point;
            }
        }
    }
    return std::nullopt;
}

std::optional<Vec3> ConstraintPlanes::bound_by(int a) const noexcept {
    const auto& [n, below] = planes_[static_cast<std::size_t>(a)];
    if (below <= 0.0) return std::nullopt;
    return below / glm::dot(n, n) * n;
}

std::optional<Vec3> ConstraintPlanes::bound_by(int a, int b) const noexcept {
    const auto& [n1, below1] = planes_[static_cast<std::size_t>(a)];
    const auto& [n2, below2] = planes_[static_cast<std::size_t>(b)];
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

std::optional<Vec3> ConstraintPlanes::bound_by(int a, int b, int c) const noexcept {
    const auto& [n1, below1] = planes_[static_cast<std::size_t>(a)];
    const auto& [n2, below2] = planes_[static_cast<std::size_t>(b)];
    const auto& [n3, below3] = planes_[static_cast<std::size_t>(c)];
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

bool ConstraintPlanes::allows(Vec3 from_goal) const noexcept {
    for (int k = 0; k < count_; ++k) {
        const auto& [n, below] = planes_[static_cast<std::size_t>(k)];
        if (glm::dot(n, from_goal) < below - kTouchDepth_px) return false;
    }
    return true;
}

}  // namespace dibhr
