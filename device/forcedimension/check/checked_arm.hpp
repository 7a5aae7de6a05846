// The arm under check: one call at a time, each of them measured.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "device/forcedimension/arm.hpp"
#include "device/forcedimension/status.hpp"

namespace dibhr::forcedimension {

class CheckedArm {
  public:
    using Clock = std::chrono::steady_clock;

    /// Opens the arm and prepares it. Its motors are off. Throws DeviceError.
    explicit CheckedArm(const ConnectionOptions& options);

    /// Throws DeviceError when the arm does not answer.
    [[nodiscard]] Vec3 position_m();
    [[nodiscard]] ArmStatus status();
    /// Switches the motors on, and holds a zero force until they are.
    void switch_force_on();
    /// Throws DeviceError.
    void set_force(Vec3 newton);
    /// The force is off, and the arm brakes. Ignores errors.
    void release_force() noexcept;

    [[nodiscard]] Library& library() noexcept { return arm_->library(); }
    [[nodiscard]] int id() const noexcept { return arm_->id(); }
    /// As it was found: type, serial, versions, watchdog.
    [[nodiscard]] const Status& found() const noexcept { return found_; }

  private:
    Status found_{};
    std::unique_ptr<Arm> arm_{};
};

}  // namespace dibhr::forcedimension
