// The Novint Falcon as a device: poses in, forces out, the USB on its own thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "device/falcon/driver.hpp"
#include "device/falcon/exchange.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/falcon/settings.hpp"
#include "device/falcon/status.hpp"
#include "device/grip_device.hpp"

namespace dibhr::falcon {

/// What a Falcon can do, whether or not one is attached.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// What every device is asked for, but its firmware's name. Its facts: "serial".
[[nodiscard]] DeviceState state_of(const Status& status);

/// Looks for the Falcon from construction on, and again whenever it is lost: opens it, asks whether
/// firmware is there, loads it, waits for homing, and then exchanges one command and one reply a
/// tick. Everything but read() and send() happens on the USB thread. Its end is five packets
/// without force and a closed port.
class FalconDevice final : public GripDevice<FalconSettings, Tuning> {
  public:
    /// `firmware_trouble`: why the kept firmware cannot be used.
    explicit FalconDevice(ConnectionOptions options, FirmwareImage firmware = {},
                          std::string firmware_trouble = {});

    /// The newest pose. `ready` is false, and no force will be sent, unless all three axes are
    /// homed, the last reply is younger than 20 ms, and the clutch is open. Before the first pose
    /// the goal waits above the middle, higher than everything; later it stays where it was.
    /// Geometry, motors, workspace or centre that were changed since the last reading make it
    /// `taken_over`: the force that was felt is not the one that would be felt now.
    HandReading read(const HandContext& context) noexcept override;

    /// The force of this tick; it leaves with the next packet. Zero for anything that is not finite
    /// and whenever the last read() was not ready.
    void send(Vec3 force_newton) noexcept override;

    /// The haptic thread's: which reply the last read() used, 1 .. since the start; 0 while there
    /// is none.
    [[nodiscard]] std::uint64_t reply_number() const noexcept { return reply_number_; }

    // The window thread's end:

    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;
    std::string use_firmware(const std::filesystem::path& file) override;

  private:
    [[nodiscard]] bool find_pose(const Counts& encoder) noexcept;
    [[nodiscard]] Counts motors_for(Vec3 force_newton) const noexcept;

    std::string firmware_;  // name of what is loaded when it is needed; empty: nothing
    std::string firmware_trouble_;
    Exchange exchange_{};

    // The haptic thread's.
    std::uint64_t reply_number_{0};
    std::optional<Vec3> position_m_{};  // the last pose of this epoch
    Jacobian jacobian_{};               // there

    Driver driver_;  // last: its thread uses the exchange
};

}  // namespace dibhr::falcon
