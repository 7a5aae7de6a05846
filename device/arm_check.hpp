// The guided check of an arm that gives a position and takes a force: `dibhr devices --check`. It
// measures what the README.md of the device lists under To be measured, guides the user, and keeps
// a record of everything.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/haptics/vec.hpp"
#include "device/force_device.hpp"
#include "device/hand/check/console.hpp"

namespace dibhr {

/// A call of the device's library of which the time is measured.
struct TimedCall {
    const char* name;  ///< in the record
    std::function<void()> call;
};

/// An opened arm under check, in its own axes. Used by one thread. All functions but
/// release_force() throw DeviceError when the arm does not answer.
class CheckedArm {
  public:
    virtual ~CheckedArm() = default;

    [[nodiscard]] virtual const char* kind() const = 0;  ///< ForceDeviceKind::name
    [[nodiscard]] virtual std::string name() const = 0;  ///< "the omega.3 1234"
    [[nodiscard]] virtual std::string serial() const = 0;
    /// As it was found, for the head of the record.
    [[nodiscard]] virtual Json about() const = 0;
    /// Why there is no guardian process; empty: nothing to say.
    [[nodiscard]] virtual std::string unguarded() const = 0;
    /// The arm's axes to the right, up and towards the user, as dibhr takes them: "+y".
    [[nodiscard]] virtual std::array<const char*, 3> axes() const = 0;
    [[nodiscard]] virtual Vec3 down() const = 0;  ///< of length 1
    /// The greatest force that it may be given; the check gives 4 N at most.
    [[nodiscard]] virtual double most_newton() const = 0;
    [[nodiscard]] virtual std::vector<TimedCall> calls() = 0;

    [[nodiscard]] virtual Vec3 position_m() = 0;
    /// The motors are on, with a zero force.
    virtual void switch_force_on() = 0;
    virtual void set_force(Vec3 newton) = 0;
    virtual void release_force() noexcept = 0;
    /// From now on the arm gets neither a call nor a force, until force_after() or release_force().
    virtual void fall_silent() {}
    /// Ends the silence: whether the force is still on; nothing: the arm does not tell. Adds what
    /// is known of it to `line`.
    [[nodiscard]] virtual std::optional<bool> force_after(Json& line) = 0;
};

/// Durations of the check; tests shorten them.
struct ArmCheckTimes {
    using Span = std::chrono::milliseconds;

    Span calls{3000};      ///< of the measurement of each call's time
    Span moving{300'000};  ///< while the user moves the grip, at most
    Span ramp{500};        ///< up to a force
    Span hold{3000};       ///< of a force on the scale, at most
    Span short_hold{100};  ///< of the weak force before a silence
    /// Times without a call, after which the force may be off.
    std::vector<Span> silences{Span(5), Span(10), Span(15), Span(25), Span(50), Span(200)};
};

/// Runs all steps and writes the record after each; the user may skip any of them, or quit. There
/// is force only in steps that announce it, for 3 s at most, and any key ends it at once. However
/// the check ends, the force is released. Throws InputError when the record cannot be written.
[[nodiscard]] CheckResult check_arm(CheckedArm& arm, const CheckRecordOptions& options,
                                    CheckConsole& console, const ArmCheckTimes& times);

}  // namespace dibhr
