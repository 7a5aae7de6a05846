// `dibhr devices`: what is attached, its state, and the next step.
#pragma once

#include <filesystem>

namespace dibhr {

struct DevicesRequest {
    std::filesystem::path firmware{};  ///< --firmware; empty: the kept one
    bool check{false};                 ///< --check: the protocol for the first unit
    std::filesystem::path out{};       ///< --out: its record; empty: falcon-check-SERIAL-DATE.json
};

/// Lists on standard output. 0: a Falcon can be used, or none is attached and the mouse can be.
/// Throws DeviceError when Falcons are attached and none can be used, InputError when the firmware
/// file is none. With `check`: leads a person through the check; 0 when all steps were done or
/// skipped, DeviceError when the Falcon failed.
int run_devices(const DevicesRequest& request);

}  // namespace dibhr
