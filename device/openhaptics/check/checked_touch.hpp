// A Touch under check: the driver has it, and the check is its haptic thread.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/arm_buffers.hpp"
#include "device/arm_check.hpp"
#include "device/openhaptics/driver_thread.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

/// Its silence holds up the library's servo thread, so that the device gets no frame: whether it
/// then ends a force by itself, only the user feels. A silence has to be shorter than a second.
class TouchUnderCheck final : public CheckedArm {
  public:
    /// Opens the device and waits until it is ready. Throws DeviceError when it cannot be used.
    explicit TouchUnderCheck(const ConnectionOptions& options);
    ~TouchUnderCheck() override { release_force(); }

    [[nodiscard]] const char* kind() const override { return "openhaptics"; }
    [[nodiscard]] std::string name() const override;
    [[nodiscard]] std::string serial() const override { return found_.serial; }
    [[nodiscard]] Json about() const override;
    [[nodiscard]] std::string unguarded() const override;
    [[nodiscard]] std::array<const char*, 3> axes() const override { return {"+x", "+y", "+z"}; }
    [[nodiscard]] Vec3 down() const override { return {0.0, -1.0, 0.0}; }
    [[nodiscard]] double most_newton() const override { return found_.continuous_newton; }
    [[nodiscard]] std::vector<TimedCall> calls() override;

    /// Of the next servo tick.
    [[nodiscard]] Vec3 position_m() override;
    void switch_force_on() override { set_force(Vec3{0.0}); }
    void set_force(Vec3 newton) override;
    void release_force() noexcept override;
    void fall_silent() override;
    [[nodiscard]] std::optional<bool> force_after(Json& line) override;

  private:
    using Silence = std::shared_ptr<std::atomic<bool>>;

    [[nodiscard]] TimedPose pose(std::chrono::steady_clock::time_point from = {});

    const Silence silent_{std::make_shared<std::atomic<bool>>(false)};
    const std::shared_ptr<ArmBuffers> buffers_{std::make_shared<ArmBuffers>()};
    Driver driver_;
    Status found_;
    Vec3 silent_at_m_{0.0};    // where the silence began
    std::uint64_t errors_{0};  // and how many there were
};

}  // namespace dibhr::openhaptics
