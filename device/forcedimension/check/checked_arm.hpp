// A Force Dimension arm under check: one call of its library at a time.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/arm_check.hpp"
#include "device/forcedimension/arm.hpp"
#include "device/forcedimension/status.hpp"

namespace dibhr::forcedimension {

class ArmUnderCheck final : public CheckedArm {
  public:
    /// Opens the arm and prepares it. Its motors are off. Throws DeviceError when no arm can be
    /// used.
    explicit ArmUnderCheck(const ConnectionOptions& options);

    [[nodiscard]] const char* kind() const override { return "forcedimension"; }
    [[nodiscard]] std::string name() const override { return name_of(found_); }
    [[nodiscard]] std::string serial() const override { return found_.serial; }
    [[nodiscard]] Json about() const override;
    [[nodiscard]] std::string unguarded() const override { return found_.unguarded; }
    [[nodiscard]] std::array<const char*, 3> axes() const override { return {"+y", "+z", "+x"}; }
    [[nodiscard]] Vec3 down() const override { return {0.0, 0.0, -1.0}; }
    [[nodiscard]] double most_newton() const override;
    [[nodiscard]] std::vector<TimedCall> calls() override;

    [[nodiscard]] Vec3 position_m() override;
    void switch_force_on() override;
    void set_force(Vec3 newton) override;
    /// The arm brakes. Ignores errors.
    void release_force() noexcept override;
    /// As the arm's status says.
    [[nodiscard]] std::optional<bool> force_after(Json& line) override;

  private:
    [[nodiscard]] Library& library() noexcept { return arm_->library(); }
    [[nodiscard]] int id() const noexcept { return arm_->id(); }
    [[nodiscard]] ArmStatus status();

    Status found_{};  // type, serial, versions, watchdog
    std::unique_ptr<Arm> arm_{};
};

}  // namespace dibhr::forcedimension
