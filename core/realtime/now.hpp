// The clock as a parameter: the machine's, or one that a test sets.
#pragma once

#include <chrono>
#include <functional>

namespace dibhr {

/// May be called on any thread. By default `std::chrono::steady_clock::now`.
using Now = std::function<std::chrono::steady_clock::time_point()>;

/// The reading of that clock at `time` [s].
[[nodiscard]] inline double seconds_of(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

/// The wall clock [s], since 1970.
[[nodiscard]] inline double utc_now_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace dibhr
