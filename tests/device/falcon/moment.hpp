// The simulated unit's time: passed in, so that its parts have no clock of their own.
#pragma once

#include <chrono>

namespace dibhr::test::falcon {

/// Since any fixed moment; never runs backwards.
using Moment = std::chrono::nanoseconds;

inline constexpr Moment kNever = Moment::max();

}  // namespace dibhr::test::falcon
