// The Novint Falcon as a force device, with a thread of its own for the USB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "device/falcon/driver.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/falcon/settings.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/thread_buffers.hpp"
#include "device/grip_device.hpp"

namespace dibhr::falcon {

/// Name and limits of a Falcon, whether or not one is attached.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// The state without the firmware's name. Its facts: "serial".
[[nodiscard]] DeviceState state_of(const Status& status);

/// Searches for the Falcon from construction on, and again whenever it is lost: opens it, probes
/// for firmware, loads it, waits for homing, and then exchanges one command and one reply per tick.
/// All but read() and send() happens on the USB thread. The destructor sends five packets without
/// force and closes the port.
class FalconDevice final : public GripDevice<FalconSettings, Tuning> {
  public:
    /// `firmware_trouble`: why the kept firmware cannot be used.
    explicit FalconDevice(ConnectionOptions options, FirmwareImage firmware = {},
                          std::string firmware_trouble = {});

    /// The newest pose. `ready` is false, and no force will be sent, unless all three axes are
    /// homed, the last reply is younger than 20 ms, and the clutch is open. Before the first pose
    /// the goal is above the middle of the image, higher than the relief; without a pose it stays.
    /// A change of geometry, motors, workspace or centre sets `hand_changed`, because the same pose
    /// would now give another force.
    HandReading read(const HandContext& context) noexcept override;

    /// The force of this tick, sent with the next packet. Zero for a force that is not finite, and
    /// whenever the last read() was not ready.
    void send(Vec3 force_newton) noexcept override;

    /// For the haptic thread: number of the reply that the last read() used, from 1; 0: no reply
    /// yet.
    [[nodiscard]] std::uint64_t reply_number() const noexcept { return reply_number_; }

    // For the window thread:

    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;
    std::string use_firmware(const std::filesystem::path& file) override;

  private:
    [[nodiscard]] bool find_pose(const Counts& encoder) noexcept;
    [[nodiscard]] Counts motors_for(Vec3 force_newton) const noexcept;

    std::string firmware_;  // name of the image that is loaded when needed; empty: none
    std::string firmware_trouble_;
    ThreadBuffers buffers_{};

    // Used by the haptic thread only.
    std::uint64_t reply_number_{0};
    std::optional<Vec3> position_m_{};  // the last pose of this epoch
    Jacobian jacobian_{};               // at position_m_

    Driver driver_;  // last: its thread uses the exchange
};

}  // namespace dibhr::falcon
