// The Novint Falcon as a device: poses in, forces out, the USB on its own thread.
#pragma once

#include <cstdint>
#include <memory>

#include "core/loop/device.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/status.hpp"

namespace dibhr::falcon {

/// Looks for the Falcon from construction on, and again whenever it is lost: opens it, asks whether
/// firmware is there, loads it, waits for homing, and then exchanges one command and one reply a
/// tick. Everything but read() and send() happens on the USB thread.
class FalconDevice final : public Device {
  public:
    explicit FalconDevice(ConnectionOptions options, FirmwareImage firmware = {});
    ~FalconDevice() override;  ///< five packets without force, then the port is closed
    FalconDevice(const FalconDevice&) = delete;
    FalconDevice& operator=(const FalconDevice&) = delete;

    [[nodiscard]] const DeviceSpecification& specification() const noexcept override;

    /// The newest pose. `ready` is false, and no force will be sent, unless all three axes are
    /// homed, the last reply is younger than 20 ms, and the clutch is open. Before the first pose
    /// the goal waits above the middle, higher than everything; later it stays where it was.
    /// Geometry, motors, workspace or centre that were changed since the last reading make it
    /// `taken_over`: the force that was felt is not the one that would be felt now.
    HandReading read(const HandContext& context) noexcept override;

    /// The force of this tick; it leaves with the next packet. Zero for anything that is not finite
    /// and whenever the last read() was not ready.
    void send(Vec3 force_newton) noexcept override;

    // The haptic thread's, of the last read():

    /// Homed and linked: this hand touches, though it may be clutched, or its last reply too old.
    [[nodiscard]] bool in_hand() const noexcept;
    /// Which reply it used, 1 .. since the start; 0 while there is none.
    [[nodiscard]] std::uint64_t reply_number() const noexcept;

    /// The window thread's end.
    [[nodiscard]] TripleBuffer<Tuning>& tuning() noexcept;
    [[nodiscard]] Status status() const;
    /// Used at the next need of one.
    void use_firmware(FirmwareImage image);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace dibhr::falcon
