// What "the same" means for recorded reals: every bit, the sign of a zero too.
#pragma once

#include <bit>
#include <cstdint>

namespace dibhr {

[[nodiscard]] inline bool same_bits(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace dibhr
