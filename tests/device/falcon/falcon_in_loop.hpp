// A simulated Falcon in a haptic loop: the bus, the device, and ticks over a flat relief.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/falcon/falcon_device.hpp"
#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/device/falcon/usb_bench.hpp"
#include "tests/device/ticking_device.hpp"

namespace dibhr::test::falcon {

using test::TickingDevice;

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

using TickingFalcon = TickingDevice<dibhr::falcon::FalconDevice>;

}  // namespace dibhr::test::falcon
