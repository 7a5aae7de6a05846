// What a test and the simulated arms of the stand-in library share: a file that both map, so that
// the test may be in another process than the library.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dibhr::test::openhaptics {

/// Names the file of the page to the library.
inline constexpr const char* kPageVariable = "OPENHAPTICS_STAND_IN";

using Axes = std::array<std::atomic<double>, 3>;

/// One arm, as its next servo tick shows it, and the force on it.
struct SimulatedArm {
    std::atomic<bool> attached{true};
    std::atomic<unsigned> in_use_error{0};  ///< why it cannot be opened; 0: it can
    Axes position_mm{};
    Axes velocity_mm_per_s{};
    Axes gimbal_rad{};
    std::atomic<bool> encoders_stand_still{false};
    std::atomic<int> buttons{0};
    std::atomic<bool> in_inkwell{false};
    std::atomic<unsigned> calibration{0x5000};
    std::atomic<int> calibration_style{4};
    std::atomic<int> calibrations{0};  ///< that were requested
    std::atomic<double> heat{0.1};
    std::atomic<double> continuous_newton{0.88};
    std::atomic<double> stiffness{0.4};

    std::atomic<bool> open{false};
    std::atomic<bool> output{false};  ///< the force output is on
    Axes force_newton{};              ///< that the motors hold
    std::atomic<int> frames{0};
    std::atomic<std::int64_t> framed_at_ns{0};  ///< end of the last frame, on the steady clock
    std::atomic<double> strongest_newton{0.0};  ///< of all frames
    std::atomic<int> watchdog_ms{0};            ///< the arm's own; 0: none

    /// Length of the force at the motors [N].
    [[nodiscard]] double newton(std::int64_t now_ns) const {
        const bool late = watchdog_ms > 0 && now_ns - framed_at_ns > watchdog_ms * 1'000'000LL;
        if (!output || late) return 0.0;
        return std::hypot(force_newton[0], force_newton[1], force_newton[2]);
    }
};

/// A frame that ended.
struct SentForce {
    double t_s{0.0};  ///< CLOCK_MONOTONIC
    double newton[3]{};
};

struct ArmPage {
    static constexpr std::size_t kArms = 2;
    static constexpr std::size_t kMostSent = 1U << 16U;

    std::array<SimulatedArm, kArms> arms{};

    // How the library behaves.
    std::atomic<unsigned> raised{0};  ///< an error of every frame; 0: none
    std::atomic<int> raised_internal{0};
    std::atomic<int> raised_times{0};         ///< in so many frames
    std::atomic<unsigned> unknown{0};         ///< a parameter that the library does not have
    std::atomic<bool> hangs{false};           ///< a frame does not end
    std::atomic<bool> calls_back{true};       ///< false: the servo thread calls nobody
    std::atomic<bool> default_by_null{true};  ///< hdInitDevice(NULL) opens the first arm
    std::atomic<bool> default_by_name{true};  ///< hdInitDevice("Default Device") does
    std::atomic<bool> prints{false};          ///< to standard output, when a device is opened
    std::atomic<bool> sets_locale{false};     ///< of the program, likewise
    std::atomic<int> opening_takes_ms{0};
    std::atomic<int> tick_us{1000};

    // What it was asked.
    std::atomic<int> openings{0};
    std::atomic<int> closings{0};
    std::atomic<double> number_read{0.0};  ///< 1.5, where the decimal point is a point
    std::atomic<int> wrong_calls{0};
    char first_wrong[160]{};  ///< valid once wrong_calls is above 0
    std::atomic<std::uint64_t> sent_count{0};
    std::array<SentForce, kMostSent> sent{};  ///< the last ones, at count modulo kMostSent
};

/// The page in a file that has its size; null: it cannot be mapped.
inline ArmPage* map_arm_page(const char* file) noexcept {
    const int descriptor = ::open(file, O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return nullptr;
    void* const memory =
        ::mmap(nullptr, sizeof(ArmPage), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    return memory == MAP_FAILED ? nullptr : static_cast<ArmPage*>(memory);
}

}  // namespace dibhr::test::openhaptics
