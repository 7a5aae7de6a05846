// The thread that opens the device through 3D Systems' library, follows it until it is lost, and
// searches again.
#pragma once

#include <memory>
#include <thread>

#include "device/arm_buffers.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

class DriverThread;

/// Has no guardian process: the library owns the device, and no other process can speak to it.
class Driver {
  public:
    Driver(const ConnectionOptions& options, const std::shared_ptr<ArmBuffers>& buffers);
    /// Zero force, force output off, and the device is closed. Where a call of the library does not
    /// return within two seconds, its thread is left to itself.
    ~Driver();
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const;

  private:
    std::shared_ptr<DriverThread> work_;
    std::thread thread_{};
};

}  // namespace dibhr::openhaptics
