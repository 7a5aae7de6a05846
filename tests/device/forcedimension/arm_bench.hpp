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

#include "device/forcedimension/forcedimension_device.hpp"
#include "tests/device/forcedimension/stand_in_page.hpp"
#include "tests/device/pressing_device.hpp"

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

class ArmBench : public PressingDevice<ForceDimensionDevice> {
  public:
    explicit ArmBench(Page& simulated, ConnectionOptions options = options_for())
        : PressingDevice(options, load_calls(options.library)), page(simulated) {}

    Page& page;

    bool press() {
        return tick_until(
            [&] { return loop.reading.ready && newton() > 0.99 * glm::length(pressed_newton); });
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
    /// The name of a call, `back` calls before the last one.
    [[nodiscard]] std::string_view call(std::size_t back = 0) const {
        return page.last_calls[(page.calls - 1 - back) % kCallsKept].load();
    }
};

}  // namespace dibhr::test::forcedimension
