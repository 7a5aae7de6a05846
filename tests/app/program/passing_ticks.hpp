// The haptic loop's time, for tests of the window: hands move by it, and not by pictures.
#pragma once

#include <cstdint>

#include "tests/app/program/desk.hpp"

namespace dibhr::test {

/// Long enough for the mouse's hand to come to rest.
inline constexpr std::uint64_t kTicksToRest = 200;

/// Until so many ticks more have run than the newest picture shows.
inline void wait_for_ticks(const WindowProgram& program, std::uint64_t ticks) {
    const std::uint64_t wanted = program.seen().ticks + ticks;
    program.wait_until([wanted](const Seen& now) { return now.ticks >= wanted; });
}

}  // namespace dibhr::test
