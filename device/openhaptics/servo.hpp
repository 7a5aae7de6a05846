// The callback in the library's servo thread: a pose out, a force in, once a tick.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>

#include "core/haptics/safety.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "device/arm_buffers.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/delay_watch.hpp"
#include "device/openhaptics/arm_watch.hpp"
#include "device/openhaptics/faults.hpp"
#include "device/openhaptics/hd.hpp"

namespace dibhr::openhaptics {

/// What the servo thread reports to the driver.
struct ServoReport {
    std::uint64_t ticks{0};  ///< since the servo was made
    Stage stage{Stage::starting};
    HdEnum calibration{kHdNeedsPerson};
    bool in_inkwell{false};
    bool warm{false};
    double warmest{0.0};
    bool reports_heat{true};
    double limit_newton{0.0};
    ButtonPresses presses{};
    ButtonPressTimes pressed_at{};
    std::uint64_t errors{0};
    std::uint64_t forces_cut{0};
    Fault last{};  ///< the last error
    Fault loss{};  ///< the first error that ends the link; none: the link goes on
};

/// tick() allocates nothing and never waits. Zero force is sent while the arm is not ready, for a
/// force of another epoch, and for one that is older than 20 ms.
class Servo {
  public:
    /// Of the open device.
    struct Arm {
        HdHandle handle{kHdInvalidHandle};
        Vec3 middle_m{0.0};     ///< of the usable workspace
        DeviceLimits limits{};  ///< with cool motors
    };

    /// All references must outlive this object.
    Servo(const HdLibrary& library, const Arm& arm, ArmBuffers& buffers, ArmWatch& watch,
          ButtonDebounce& buttons) noexcept
        : library_(library), arm_(arm), buffers_(buffers), watch_(watch), buttons_(buttons) {}

    /// For hdScheduleAsynchronous; `servo` is a Servo.
    static unsigned int run(void* servo) { return static_cast<Servo*>(servo)->tick(); }
    /// One frame. Returns kHdCallbackDone after end() and some frames of zero force, or after
    /// cut_off().
    [[nodiscard]] unsigned int tick() noexcept;

    // For the driver:

    /// The force output is on: forces may be sent.
    void allow_force(bool allowed) noexcept { may_output_ = allowed; }
    /// No force from the next tick on; the callback then ends.
    void end() noexcept { ending_ = true; }
    [[nodiscard]] bool ended() const noexcept { return ended_; }
    /// A tick that begins from now on does nothing.
    void cut_off() noexcept { ended_ = true; }
    /// A tick has begun and not returned.
    [[nodiscard]] bool runs() const noexcept { return runs_; }
    /// For one thread.
    [[nodiscard]] const ServoReport& report() noexcept { return reports_.front(); }

  private:
    using Time = std::chrono::steady_clock::time_point;

    /// A value that not every device has. One that the library refuses in the first frame is not
    /// read again, because every refusal takes the force off.
    struct OptionalValue {
        HdEnum what;
        bool known{true};
    };

    void one_frame() noexcept;
    template <typename T>
    void read(OptionalValue& value, const std::function<void(HdEnum, T*)>& get, T* into) noexcept;
    void read_frame(ArmSample& sample, std::uint8_t& buttons, bool& in_inkwell) noexcept;
    [[nodiscard]] Vec3 force_at(Time now) noexcept;
    void publish_pose(const ArmSample& sample, std::uint8_t buttons, Time at) noexcept;

    const HdLibrary& library_;
    const Arm arm_;
    ArmBuffers& buffers_;
    std::atomic<bool> may_output_{false};
    std::atomic<bool> ending_{false};
    std::atomic<bool> ended_{false};
    std::atomic<bool> runs_{false};
    TripleBuffer<ServoReport> reports_{};

    // Used by the servo thread only.
    ArmWatch& watch_;
    ButtonDebounce& buttons_;
    DelayWatch ticks_{};
    Time last_tick_{};
    Fault fault_{};  // of the last frame
    OptionalValue velocity_{kHdVelocity};
    OptionalValue gimbal_{kHdGimbalAngles};
    OptionalValue encoders_{kHdEncoders};
    OptionalValue heat_{kHdMotorTemperature};
    OptionalValue inkwell_{kHdInkwellSwitch};
    int last_frames_{0};
    ServoReport now_{};
};

}  // namespace dibhr::openhaptics
