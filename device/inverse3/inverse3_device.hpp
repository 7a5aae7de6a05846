// The Haply Inverse3 as a force device, with a thread of its own for the service.
#pragma once

#include <chrono>

#include "core/realtime/triple_buffer.hpp"
#include "device/grip_device.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/inverse3/driver.hpp"
#include "device/inverse3/frame.hpp"
#include "device/inverse3/settings.hpp"
#include "device/inverse3/status.hpp"
#include "device/inverse3/thread_buffers.hpp"

namespace dibhr::inverse3 {

/// Name, limits and assumed dynamics of an Inverse3, whether or not one is attached.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// The state without the pose ages since the start. `recent`: ages of about the last second. Its
/// facts: "dialect", "id", "preset-read", "service".
[[nodiscard]] DeviceState state_of(const Status& status, const PoseAges& recent = {});

/// Searches for the service from construction on, and again whenever it is lost; chooses a device,
/// and then exchanges one message and one state at a time. All but read() and send() happens on the
/// network thread. The destructor sends a zero force and closes the connection.
class Inverse3Device final : public GripDevice<Inverse3Settings, Tuning> {
  public:
    explicit Inverse3Device(ConnectionOptions options);

    /// The newest pose. `ready` is false, and no force will be sent, unless the device is
    /// calibrated, powered, not used by another program and takes forces, its pose is younger than
    /// 20 ms, and the clutch is open. Before the first pose the goal is above the middle of the
    /// image, higher than the relief; without a pose it stays. A change of workspace, tilt or
    /// centre sets `hand_changed`, as does every gap and jump.
    HandReading read(const HandContext& context) noexcept override;

    /// The force of this tick, sent with the next message. Zero for a force that is not finite, and
    /// whenever the last read() was not ready; at most Tuning::max_force_newton long.
    void send(Vec3 force_newton) noexcept override;

    /// For the haptic thread: age of the pose of the last read().
    [[nodiscard]] std::chrono::nanoseconds pose_age() const noexcept { return pose_age_; }

    // For the window thread:

    /// Pose ages of all ticks in which this device touched, since the start; updated every half
    /// second.
    [[nodiscard]] const PoseAges& pose_ages() noexcept { return published_ages_.front(); }
    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;

  private:
    void count_age() noexcept;

    PoseAges shown_ages_{};   // all ages up to shown_at_
    PoseAges recent_ages_{};  // ages of the second before shown_at_
    std::chrono::steady_clock::time_point shown_at_{};
    TripleBuffer<PoseAges> published_ages_{};
    ThreadBuffers buffers_{};

    // Used by the haptic thread only.
    ImageTilt tilt_{0.0};
    std::chrono::nanoseconds pose_age_{0};
    PoseAges ages_{};
    int ages_unpublished_{0};

    Driver driver_;  // last: its thread uses the exchange
};

}  // namespace dibhr::inverse3
