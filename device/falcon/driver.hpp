// The USB thread's life: looks for the Falcon, opens it, brings it up, talks to it, loses it, looks
// again.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "device/falcon/conversation.hpp"
#include "device/falcon/exchange.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

/// With a guardian of its own from construction on.
class Driver {
  public:
    /// `exchange` must outlive it.
    Driver(ConnectionOptions options, FirmwareImage firmware, Exchange& exchange);
    ~Driver();  ///< five packets without force, then the port is closed
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    [[nodiscard]] Status status() const { return board_.read(); }
    /// Used at the next need of one, which comes at once when one was wanting.
    void use_firmware(FirmwareImage image);

  private:
    void live(const std::stop_token& stop);
    void look(const UsbContext& usb, const std::stop_token& stop);
    void use(const UsbContext& usb, const AttachedFalcon& falcon, const std::stop_token& stop);
    void bring_up_and_talk(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop);
    void talk(const UsbContext& usb, FtdiPort& port, const std::stop_token& stop);
    void lose(const std::string& why);
    void wait_to_look_again(const std::stop_token& stop);
    [[nodiscard]] FirmwareImage firmware();

    const ConnectionOptions options_;
    Exchange& exchange_;
    StatusBoard board_{};

    // The USB thread's.
    Guardian guardian_{"Falcon"};
    Memory memory_{};
    std::string trouble_{};              // what went wrong last, until a Falcon answers again
    std::chrono::milliseconds pause_{};  // before the next look

    std::mutex mutex_{};
    std::condition_variable_any news_{};
    FirmwareImage firmware_{};  // guarded by mutex_
    bool new_firmware_{false};  // guarded by mutex_

    std::jthread thread_{};  // last: it uses all the others
};

}  // namespace dibhr::falcon
