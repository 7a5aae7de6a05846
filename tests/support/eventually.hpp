// Waiting in a test for what another thread or program does.
#pragma once

#include <chrono>
#include <thread>

namespace dibhr::test {

/// Polls every 2 ms until the condition is true; false when it was not in two minutes.
template <typename Condition>
[[nodiscard]] bool eventually(const Condition& is_so,
                              std::chrono::milliseconds patience = std::chrono::minutes(2)) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!is_so()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

}  // namespace dibhr::test
