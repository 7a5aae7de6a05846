// Force Dimension's library as the driver uses it: typed functions over Calls.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/haptics/vec.hpp"
#include "device/forcedimension/calls.hpp"

namespace dibhr::forcedimension {

// Numbers of the library: README.md, Numbers.
inline constexpr int kFalconType = 60;
inline constexpr int kDeviceInUse = 20;                ///< an error
inline constexpr std::uint8_t kWatchdogPeriods = 160;  ///< 20 ms
inline constexpr double kWatchdogPeriod_ms = 0.125;

/// Why a device has switched its force off.
enum class ForceOff : int { none, button, velocity, watchdog, software, unplugged, dead_man };

/// The part of the status vector that dibhr uses.
struct ArmStatus {
    bool power{false};
    bool initialised{false};
    bool force{false};  ///< the motors take forces
    bool error{false};
    ForceOff cause{ForceOff::none};
};

/// All functions may be called by any thread, and may take as long as the device takes. A result of
/// false, or nothing, is an error; a library's results above 0 are remarks, not errors.
class Library {
  public:
    explicit Library(std::shared_ptr<Calls> calls) : calls_(std::move(calls)) {}

    [[nodiscard]] const std::string& file() const noexcept { return calls_->file(); }
    [[nodiscard]] std::string version();
    /// Number of the last error of the calling thread.
    [[nodiscard]] int last_error() { return ask(Function::last_error); }

    /// Attached devices, also those in use by other programs.
    [[nodiscard]] int count() { return ask(Function::device_count); }
    /// The ID of the opened device. Nothing moves.
    [[nodiscard]] std::optional<int> open(int index) { return opened(Function::open_index, index); }
    [[nodiscard]] std::optional<int> open_type(int type) {
        return opened(Function::open_type, type);
    }
    void close(int id) { (void)ask(Function::close, id); }
    /// Takes the force off and brakes.
    bool stop(int id) { return ask(Function::stop, id) >= 0; }

    [[nodiscard]] int type(int id) { return ask(Function::type, id); }
    [[nodiscard]] std::optional<int> serial(int id);
    [[nodiscard]] std::optional<double> controller_version(int id);
    [[nodiscard]] bool has_gripper(int id) { return ask(Function::has_gripper, id) > 0; }
    [[nodiscard]] bool is_left_handed(int id) { return ask(Function::is_left_handed, id) > 0; }
    [[nodiscard]] std::optional<ArmStatus> status(int id);

    [[nodiscard]] std::optional<Vec3> position_m(int id);
    /// Bits of the pressed buttons, four at most.
    [[nodiscard]] std::uint8_t buttons(int id) {
        return static_cast<std::uint8_t>(std::max(ask(Function::button_mask, id), 0) & 0xF);
    }
    /// Also holds the arm up against its weight.
    bool set_force(int id, Vec3 newton);
    bool enable_force(int id, bool on) { return set(Function::enable_force, id, on ? 1.0 : 0.0); }
    bool hold_weight(int id) { return set(Function::set_gravity_compensation, id, 1.0); }
    bool set_max_force(int id, double newton) { return set(Function::set_max_force, id, newton); }
    /// Closing the gripper is button 0.
    bool emulate_button(int id) { return set(Function::emulate_button, id, 1.0); }
    /// Sets the firmware's watchdog, and reads it back [ms]; 0: there is none.
    [[nodiscard]] double start_watchdog(int id);

    /// The arm can drive itself to its stops.
    [[nodiscard]] bool can_initialise(int id) {
        return !calls_->by_hand_only() && ask(Function::is_supported, id) > 0;
    }
    /// Blocks while **the arm moves by itself**: only after the user agreed.
    bool initialise(int id) { return ask(Function::auto_initialise, id) >= 0; }
    /// Ends initialise() of another thread, and brakes.
    bool stop_initialising(int id) { return set(Function::stop_regulation, id, 0.0); }
    /// The user holds the end-effector at its rest.
    bool reset(int id) { return ask(Function::reset, id) >= 0; }

  private:
    [[nodiscard]] int ask(Function function, int id = -1) {
        return calls_->call(function, id, {}, {});
    }
    bool set(Function function, int id, double value) {
        return calls_->call(function, id, std::array{value}, {}) >= 0;
    }
    [[nodiscard]] std::optional<int> opened(Function function, int which);
    [[nodiscard]] bool is_initialised(int id, bool reset_light);

    std::shared_ptr<Calls> calls_;
};

}  // namespace dibhr::forcedimension
