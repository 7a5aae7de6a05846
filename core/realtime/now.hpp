// Where what measures time takes it from: the machine's clock, or one that is moved by hand.
#pragma once

#include <chrono>
#include <functional>

namespace dibhr {

/// May be called on any thread. `std::chrono::steady_clock::now` wherever nothing else is said.
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
