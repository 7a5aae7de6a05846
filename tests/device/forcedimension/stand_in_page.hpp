// What the stand-in for Force Dimension's library simulates, and what it was asked: in memory that
// a test shares with it, in one process or in two.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dibhr::test::forcedimension {

inline constexpr std::size_t kUnits = 3;
inline constexpr std::size_t kCallsKept = 64;
/// Names a file that holds the page; without it the page is the library's own.
inline constexpr const char* kPageVariable = "DIBHR_STAND_IN_PAGE";

// Numbers of the library, from its maker's header.
inline constexpr int kOmega3 = 33;
inline constexpr int kFalcon = 60;
inline constexpr int kErrorCom = 2;
inline constexpr int kErrorInUse = 20;
inline constexpr int kErrorInvalid = 21;

/// One simulated arm. A test sets the first part, calls of the library change the second.
struct Unit {
    std::atomic<bool> plugged{false};
    std::atomic<bool> in_use{false};  ///< by another program
    std::atomic<int> type{kOmega3};
    std::atomic<int> serial{0};
    std::atomic<bool> power{true};
    std::atomic<bool> initialised{true};
    std::atomic<bool> error{false};
    std::atomic<bool> gripper{false};
    std::atomic<bool> has_watchdog{true};
    std::array<std::atomic<double>, 3> position_m{};
    std::atomic<unsigned> buttons{0};

    std::atomic<bool> open{false};
    std::atomic<bool> was_opened{false};
    std::atomic<bool> force_on{false};  ///< the motors take forces
    std::atomic<int> cause{0};          ///< why the force is off
    std::array<std::atomic<double>, 3> newton{};
    std::atomic<double> strongest_newton{0.0};  ///< of all forces that were set
    std::atomic<std::int64_t> newton_at_ns{0};  ///< when it was set, on the steady clock
    std::atomic<int> watchdog{0};               ///< periods of 125 us; 0: off
    std::atomic<double> max_newton{-1.0};
    std::atomic<bool> holds_weight{true};
    std::atomic<bool> emulates_button{false};
    std::atomic<bool> moves_itself{false};
    std::atomic<int> initialisations{0};  ///< begun

    /// Length of the force at the motors [N], squared; the watchdog ends it.
    [[nodiscard]] double square_newton(std::int64_t now_ns) const {
        constexpr std::int64_t kPeriod_ns = 125'000;
        const bool late = watchdog > 0 && now_ns - newton_at_ns > watchdog * kPeriod_ns;
        if (!force_on || late) return 0.0;
        return newton[0] * newton[0] + newton[1] * newton[1] + newton[2] * newton[2];
    }
};

struct Page {
    std::array<std::atomic<int>, 4> version{3, 17, 6, 0};
    std::array<Unit, kUnits> units{};

    // What is wrong:
    std::atomic<int> slow_us{0};            ///< each force takes so long
    std::atomic<bool> hangs{false};         ///< setting a force does not return
    std::atomic<bool> remarks{false};       ///< results are timeguard (1), saturated (2)
    std::atomic<bool> not_a_number{false};  ///< positions are
    std::atomic<bool> initialisation_fails{false};
    std::atomic<int> initialisation_ms{300};

    // What was asked:
    std::atomic<int> wrong_calls{0};  ///< with an ID, a value or an order that cannot be
    std::atomic<int> velocity_calls{0};
    std::atomic<int> threshold_calls{0};
    std::atomic<std::size_t> calls{0};
    std::array<std::atomic<const char*>, kCallsKept> last_calls{};  ///< names; of one process alone
};

}  // namespace dibhr::test::forcedimension
