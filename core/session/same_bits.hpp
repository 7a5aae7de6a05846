// What "the same" means for recorded reals: every bit, the sign of a zero too.
#pragma once

#include <bit>
#include <cstdint>

#include "core/haptics/vec.hpp"

namespace dibhr {

[[nodiscard]] inline bool same_bits(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

[[nodiscard]] inline bool same_bits(const Vec3& a, const Vec3& b) noexcept {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

}  // namespace dibhr
