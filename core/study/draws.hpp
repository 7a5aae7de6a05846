// Draws by chance for one thing of a study, which do not depend on what was drawn before.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "core/psychophysics/random.hpp"

namespace dibhr {

/// Draws of their own for every list of numbers. The streams of neighbouring numbers begin alike,
/// so that they are mixed first (SplitMix64's finaliser).
[[nodiscard]] inline Random draws_for(std::uint64_t seed,
                                      std::initializer_list<std::uint64_t> which) noexcept {
    std::uint64_t stream = 0;
    for (const std::uint64_t one : which) {
        stream = (stream ^ one) + 0x9e3779b97f4a7c15U;
        stream = (stream ^ (stream >> 30U)) * 0xbf58476d1ce4e5b9U;
        stream = (stream ^ (stream >> 27U)) * 0x94d049bb133111ebU;
        stream ^= stream >> 31U;
    }
    return Random(seed, stream);
}

}  // namespace dibhr
