// What `dibhr devices` says of the Haply Inverse Service, and what it does without one.
#pragma once

#include <string>

#include "device/inverse3/status.hpp"

namespace dibhr {

/// What became of looking for devices of one kind.
struct DevicesFound {
    bool usable{false};     ///< one can be used
    std::string refusal{};  ///< why none of those that are there can be; empty: none is there
};

/// Tells on stdout what the service has.
[[nodiscard]] DevicesFound tell_inverse3(const inverse3::ConnectionOptions& connection);

/// Serves as a simulated service, whose hand and device follow what is typed, until the
/// input ends. Throws DeviceError when a port is taken.
void simulate_inverse3(const inverse3::ConnectionOptions& connection);

}  // namespace dibhr
