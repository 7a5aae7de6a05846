// Time that passes only while nobody works: how a program that links simulated_time.cpp sees the
// steady clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>
#include <thread>

namespace dibhr::test {

/// So much of it; without simulated_time.cpp the same of the real one.
inline void let_pass(std::chrono::nanoseconds span) {
    std::this_thread::sleep_for(span);
}

/// How often threads of this program have gone to wait by now: for a time, a file, another thread.
/// What waiting costs, whatever else the machine does.
[[nodiscard]] std::uint64_t waits_so_far() noexcept;
/// Of the threads that bear this name (15 letters at most).
[[nodiscard]] std::uint64_t waits_so_far_of(std::string_view thread) noexcept;

}  // namespace dibhr::test
