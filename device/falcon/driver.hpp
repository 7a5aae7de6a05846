// The USB thread: finds the Falcon, opens it, loads its firmware, exchanges packets with it until
// it is lost, and searches again.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "device/falcon/exchange_loop.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/thread_buffers.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

/// Has a guardian process from construction on.
class Driver {
  public:
    /// `buffers` must outlive it.
    Driver(ConnectionOptions options, FirmwareImage firmware, ThreadBuffers& buffers);
    ~Driver();  ///< five packets without force, then the port is closed
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const { return board_.read(); }
    /// Uses `image` when a Falcon next needs firmware; at once when the driver waits for it.
    void use_firmware(FirmwareImage image);

  private:
    void run(const std::stop_token& stop);
    void find_device(const UsbContext& usb, const std::stop_token& stop);
    void use(const UsbContext& usb, const AttachedFalcon& falcon, const std::stop_token& stop);
    void bring_up_and_run(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop);
    void run_exchanges(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop);
    void handle_loss(const std::string& why);
    void wait_to_look_again(const std::stop_token& stop);
    [[nodiscard]] FirmwareImage firmware();

    const ConnectionOptions options_;
    ThreadBuffers& buffers_;
    StatusBoard board_{};

    // Used by the USB thread only.
    Guardian guardian_{"Falcon"};
    DriverState driver_state_{};
    std::string trouble_{};              // the last failure, until a Falcon answers again
    std::chrono::milliseconds pause_{};  // before the next search

    std::mutex mutex_{};
    std::condition_variable_any changed_{};
    FirmwareImage firmware_{};  // guarded by mutex_
    bool new_firmware_{false};  // guarded by mutex_

    std::jthread thread_{};  // last: it uses all the others
};

}  // namespace dibhr::falcon
