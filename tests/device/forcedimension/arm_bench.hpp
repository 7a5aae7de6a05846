// The stand-in for Force Dimension's library, an arm in a haptic loop, and what its motors do.
#pragma once

#include <dlfcn.h>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/haptics/safety.hpp"
#include "device/forcedimension/forcedimension_device.hpp"
#include "tests/device/forcedimension/stand_in_page.hpp"
#include "tests/device/ticking_device.hpp"

namespace dibhr::test::forcedimension {

using namespace dibhr::forcedimension;
using std::chrono::milliseconds;

inline const std::string kDrd = STAND_IN_FOLDER "/drd/libdrd.so.3";
inline const std::string kDhd = STAND_IN_FOLDER "/dhd/libdhd.so.3";

/// The page of that library, as a new process finds it.
inline Page& fresh_page(const std::string& library = kDrd) {
    void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw std::runtime_error(dlerror());
    auto* const page_of = reinterpret_cast<Page* (*)()>(dlsym(handle, "stand_in_page"));
    return *new (page_of()) Page;
}

/// With one omega.3, ready to be used.
inline Page& page_with_omega(const std::string& library = kDrd) {
    Page& page = fresh_page(library);
    page.units[0].plugged = true;
    page.units[0].serial = 1234;
    return page;
}

inline ConnectionOptions options_for(const std::string& library = kDrd) {
    ConnectionOptions options;
    options.library = library;
    options.usb_devices = "/nowhere";
    return options;
}

/// Presses with a force that the loop's own last stage limits and lets rise.
class ArmBench {
  public:
    explicit ArmBench(Page& simulated, ConnectionOptions options = options_for())
        : page(simulated), loop(options, load_calls(options.library)) {}

    Page& page;
    TickingDevice<ForceDimensionDevice> loop;
    Vec3 pressed_newton{0.0, 0.0, 2.0};

    /// Ticks until the condition is true; false: it never was.
    template <typename IsSo>
    bool tick_until(IsSo&& is_so, milliseconds patience = milliseconds(20'000)) {
        return loop.tick_until(
            [&] {
                choose_force();
                return is_so();
            },
            patience);
    }
    void tick_for(milliseconds span) {
        (void)tick_until([] { return false; }, span);
    }
    bool press() {
        return tick_until(
            [&] { return loop.reading.ready && newton() > 0.99 * glm::length(pressed_newton); });
    }
    bool reaches(Stage stage) {
        return tick_until([&] { return status().stage == stage; });
    }
    /// After a fault: how long the motors still push, at most `patience`.
    milliseconds pushes_for(milliseconds patience = milliseconds(1000)) {
        const auto begun = std::chrono::steady_clock::now();
        (void)tick_until([&] { return newton() == 0.0; }, patience);
        return std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun);
    }
    /// The greatest change of the force from one tick to the next while it rises to its full
    /// length.
    double steepest_rise() {
        double before = newton();
        double steepest = 0.0;
        (void)tick_until([&] {
            steepest = std::max(steepest, newton() - before);
            before = newton();
            return before > 0.99 * glm::length(pressed_newton);
        });
        return steepest;
    }

    /// What the simulated motors of a unit do.
    [[nodiscard]] double newton(std::size_t unit = 0) const {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::sqrt(page.units[unit].square_newton(
            std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()));
    }
    [[nodiscard]] Status status() const { return loop.device.status(); }
    [[nodiscard]] bool says(std::string_view part) const {
        return status().sentence.find(part) != std::string::npos;
    }
    /// The name of a call, `back` calls before the last one.
    [[nodiscard]] std::string_view call(std::size_t back = 0) const {
        return page.last_calls[(page.calls - 1 - back) % kCallsKept].load();
    }

  private:
    void choose_force() {
        SafetyInput input;
        input.device_ready = loop.reading.ready;
        input.from_zero = loop.reading.hand_changed;
        loop.force_newton = safety_.limit(pressed_newton, input, SafetyLimits{});
    }

    SafetyStage safety_{};
};

}  // namespace dibhr::test::forcedimension
