// The Haply Inverse3 as a device: poses in, forces out, the service on its own thread.
#pragma once

#include <chrono>

#include "core/realtime/triple_buffer.hpp"
#include "device/grip_device.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/inverse3/driver.hpp"
#include "device/inverse3/exchange.hpp"
#include "device/inverse3/frame.hpp"
#include "device/inverse3/settings.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// What an Inverse3 can do, whether or not one is attached; how it moves is assumed.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// What every device is asked for, but the ages since the start. `recent`: of about the last
/// second. Its facts: "dialect", "id", "preset-read", "service".
[[nodiscard]] DeviceState state_of(const Status& status, const PoseAges& recent = {});

/// Looks for the service from construction on, and again whenever it is lost; chooses a device, and
/// then exchanges one message and one state after the other. Everything but read() and send()
/// happens on the network thread. Its end is a zero force and a closed connection.
class Inverse3Device final : public GripDevice<Inverse3Settings, Tuning> {
  public:
    explicit Inverse3Device(ConnectionOptions options);

    /// The newest pose. `ready` is false, and no force will be sent, unless the device is
    /// calibrated, powered, ours and obeying, its pose younger than 20 ms, and the clutch open.
    /// Before the first pose the goal waits above the middle, higher than everything; later it
    /// stays where it was. Workspace, tilt or centre that were changed make it `taken_over`, as
    /// does every gap and jump.
    HandReading read(const HandContext& context) noexcept override;

    /// The force of this tick; it leaves with the next message. Zero for anything that is not
    /// finite and whenever the last read() was not ready; no longer than Tuning::max_force_newton.
    void send(Vec3 force_newton) noexcept override;

    /// The haptic thread's: how old the pose of the last read() was.
    [[nodiscard]] std::chrono::nanoseconds pose_age() const noexcept { return pose_age_; }

    // The window thread's end:

    /// How old poses were in the ticks in which this hand touched, since the start; at most half a
    /// second behind.
    [[nodiscard]] const PoseAges& pose_ages() noexcept { return told_ages_.front(); }
    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;

  private:
    void count_age() noexcept;

    PoseAges shown_ages_{};   // since the start, when
    PoseAges recent_ages_{};  // of the second before that
    std::chrono::steady_clock::time_point shown_at_{};
    TripleBuffer<PoseAges> told_ages_{};
    Exchange exchange_{};

    // The haptic thread's.
    ImageTilt tilt_{0.0};
    std::chrono::nanoseconds pose_age_{0};
    PoseAges ages_{};
    int ages_untold_{0};

    Driver driver_;  // last: its thread uses the exchange
};

}  // namespace dibhr::inverse3
