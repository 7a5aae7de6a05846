// The functions of Force Dimension's library that dibhr calls. The declarations are our own, from
// the tables of README.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace dibhr::forcedimension {

enum class Function : std::uint8_t {
    sdk_version,
    device_count,
    open_index,
    open_type,
    close,
    stop,
    type,
    serial,
    controller_version,
    has_gripper,
    is_left_handed,
    position,
    status,
    button_mask,
    set_force,
    enable_force,
    set_gravity_compensation,
    set_max_force,
    emulate_button,
    enable_expert_mode,
    set_watchdog,
    get_watchdog,
    reset,
    is_supported,
    is_initialised,
    auto_initialise,
    stop_regulation,
    last_error
};

/// `name` as in the library and in records; how many numbers it is given and answers beside its
/// result; `of_device`: its last argument is the device's ID.
struct FunctionShape {
    const char* name;
    std::size_t given;
    std::size_t answered;
    bool of_device;
};

inline constexpr std::size_t kMostNumbers = 32;  ///< of one call; more than any status vector

inline constexpr std::array<FunctionShape, 28> kFunctions{{
    {"dhdGetSDKVersion", 0, 4, false},
    {"dhdGetDeviceCount", 0, 0, false},
    {"drdOpenID", 1, 0, false},
    {"dhdOpenType", 1, 0, false},
    {"drdClose", 0, 0, true},
    {"dhdStop", 0, 0, true},
    {"dhdGetSystemType", 0, 0, true},
    {"dhdGetSerialNumber", 0, 1, true},
    {"dhdGetVersion", 0, 1, true},
    {"dhdHasGripper", 0, 0, true},
    {"dhdIsLeftHanded", 0, 0, true},
    {"dhdGetPosition", 0, 3, true},
    {"dhdGetStatus", 0, kMostNumbers, true},
    {"dhdGetButtonMask", 0, 0, true},
    {"dhdSetForceAndTorqueAndGripperForce", 3, 0, true},
    {"dhdEnableForce", 1, 0, true},
    {"dhdSetGravityCompensation", 1, 0, true},
    {"dhdSetMaxForce", 1, 0, true},
    {"dhdEmulateButton", 1, 0, true},
    {"dhdEnableExpertMode", 0, 0, false},
    {"dhdSetWatchdog", 1, 0, true},
    {"dhdGetWatchdog", 0, 1, true},
    {"dhdReset", 0, 0, true},
    {"drdIsSupported", 0, 0, true},
    {"drdIsInitialized", 0, 0, true},
    {"drdAutoInit", 0, 0, true},
    {"drdStop", 1, 0, true},
    {"dhdErrorGetLast", 0, 0, false},
}};
static_assert(kFunctions.size() == static_cast<std::size_t>(Function::last_error) + 1);

[[nodiscard]] constexpr const FunctionShape& shape_of(Function function) noexcept {
    return kFunctions[static_cast<std::size_t>(function)];
}

/// A library that answers calls: the maker's, one that also records, or a record that is played.
/// Any thread may call it; a call may take as long as the device takes.
class Calls {
  public:
    virtual ~Calls() = default;

    /// `given` and `answered` are as long as the function's shape says. Returns the function's
    /// result: below 0 it is an error, and `answered` is not to be used.
    virtual int call(Function function, int id, std::span<const double> given,
                     std::span<double> answered) = 0;
    /// The library cannot initialise an arm by itself (it is libdhd, without libdrd's functions).
    [[nodiscard]] virtual bool by_hand_only() const noexcept = 0;
    /// "/opt/sdk/libdrd.so.3", for the user.
    [[nodiscard]] virtual const std::string& file() const noexcept = 0;
};

/// The library, or why there is none.
struct FoundCalls {
    std::shared_ptr<Calls> calls{};
    std::string trouble{};  ///< one sentence; empty while `calls` is null: none is installed
};

/// `chosen`: a file or a folder, or a record to be played; empty: as README.md, Where it is looked
/// for.
[[nodiscard]] FoundCalls load_calls(const std::string& chosen);

}  // namespace dibhr::forcedimension
