// A simulated Falcon in a haptic loop: the bus, the device, and ticks over a flat relief.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/realtime/tick_timer.hpp"
#include "device/falcon/falcon_device.hpp"
#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/device/falcon/usb_bench.hpp"
#include "tests/device/small_relief.hpp"

namespace dibhr::test::falcon {

/// An image such as people choose, already checked.
inline dibhr::falcon::FirmwareImage any_firmware() {
    return {.bytes = synthetic_firmware(600), .name = "synthetic firmware", .sha256 = {}};
}

/// Of an image that is cut, or has a bit that is not as it was, or is none: what a careless caller
/// may hand over unchecked.
inline std::vector<dibhr::falcon::FirmwareImage> bad_firmware() {
    std::vector<dibhr::falcon::FirmwareImage> images(4, any_firmware());
    images[0].bytes.resize(images[0].bytes.size() / 2);
    images[1].bytes[0] = static_cast<std::uint8_t>(images[1].bytes[0] ^ 1U);    // the key
    images[2].bytes[22] = static_cast<std::uint8_t>(images[2].bytes[22] ^ 1U);  // a block's length
    images[3].bytes = {'#', '!', '/', 'b', 'i', 'n', '/', 's', 'h', '\n'};
    return images;
}

/// Of one unit, how many commands with a force it got, what its motors do now, and the like.
inline CommandLog log_of(Unit& unit) {
    return unit.with([](FalconModel& model) { return model.board().log(); });
}
inline Traffic traffic_of(Unit& unit) {
    return unit.with([](FalconModel& model) { return model.traffic(); });
}
inline bool is_limp(Unit& unit) {
    return unit.with([](FalconModel& model) { return model.board().limp(); });
}
inline void home(Unit& unit) {
    unit.with([](FalconModel& model) { model.board().home(); });
}
inline void start_firmware(Unit& unit) {
    unit.with([](FalconModel& model) { model.board().start_firmware(); });
}

/// Runs any device at 1 kHz with a force of the test's choosing.
template <typename AnyDevice>
class TickingDevice {
  public:
    template <typename... Arguments>
    explicit TickingDevice(Arguments&&... arguments)
        : device(std::forward<Arguments>(arguments)...) {}

    AnyDevice device;
    Vec3 force_newton{0.0};  ///< sent in every tick
    HandReading reading{};   ///< the last one

    void tick() {
        reading = device.read({0.001, surface_, kPitch_mm});
        device.send(force_newton);
    }
    /// Ticks until it is so; false when it never was.
    bool tick_until(const std::function<bool()>& is_so,
                    std::chrono::milliseconds patience = std::chrono::seconds(20)) {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < end) {
            (void)timer_.wait();
            tick();
            if (is_so()) return true;
        }
        return false;
    }
    void tick_for(std::chrono::milliseconds span) {
        (void)tick_until([] { return false; }, span);
    }
    bool tick_until_ready() {
        return tick_until([this] { return reading.ready && !reading.stand_in; });
    }
    [[nodiscard]] const DepthSurface& surface() const noexcept { return surface_; }

    static constexpr double kPitch_mm = 101.6 / 720.0;

  private:
    SmallRelief relief_{flat()};
    DepthSurface surface_{relief_.surface()};
    TickTimer timer_{};
};

using TickingFalcon = TickingDevice<dibhr::falcon::FalconDevice>;

}  // namespace dibhr::test::falcon
