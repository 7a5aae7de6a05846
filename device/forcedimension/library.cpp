// Typed functions of Force Dimension's library.
#include "device/forcedimension/library.hpp"

#include <algorithm>
#include <cmath>

#include "core/files/plain_text.hpp"

namespace dibhr::forcedimension {

namespace {

// Places in the status vector: README.md, Numbers.
constexpr std::size_t kPower = 0;
constexpr std::size_t kReset = 3;
constexpr std::size_t kForce = 5;
constexpr std::size_t kError = 9;
constexpr std::size_t kCause = 14;

ForceOff cause_of(double number) noexcept {
    const bool known = number >= 0.0 && number <= static_cast<double>(ForceOff::dead_man);
    return known ? static_cast<ForceOff>(static_cast<int>(number)) : ForceOff::software;
}

}  // namespace

std::string Library::version() {
    std::array<double, 4> part{};
    (void)calls_->call(Function::sdk_version, -1, {}, part);
    std::string text;
    for (const double number : part) text += (text.empty() ? "" : ".") + number_text(number, 0);
    return text;
}

std::optional<int> Library::opened(Function function, int which) {
    const int id = calls_->call(function, -1, std::array{static_cast<double>(which)}, {});
    return id >= 0 ? std::optional(id) : std::nullopt;
}

std::optional<int> Library::serial(int id) {
    std::array<double, 1> serial{};
    if (calls_->call(Function::serial, id, {}, serial) < 0) return std::nullopt;
    if (!(serial[0] >= 0.0 && serial[0] <= 65535.0)) return std::nullopt;
    return static_cast<int>(serial[0]);
}

std::optional<double> Library::controller_version(int id) {
    std::array<double, 1> version{};
    if (calls_->call(Function::controller_version, id, {}, version) < 0) return std::nullopt;
    return version[0];
}

std::optional<ArmStatus> Library::status(int id) {
    std::array<double, kMostNumbers> value{};
    if (calls_->call(Function::status, id, {}, value) < 0) return std::nullopt;
    ArmStatus status;
    status.power = value[kPower] != 0.0;
    status.initialised = is_initialised(id, value[kReset] != 0.0);
    status.force = value[kForce] != 0.0;
    status.error = value[kError] != 0.0;
    status.cause = cause_of(value[kCause]);
    return status;
}

bool Library::is_initialised(int id, bool reset_light) {
    return can_initialise(id) ? ask(Function::is_initialised, id) > 0 : reset_light;
}

std::optional<Vec3> Library::position_m(int id) {
    std::array<double, 3> at{};
    if (calls_->call(Function::position, id, {}, at) < 0) return std::nullopt;
    const Vec3 position{at[0], at[1], at[2]};
    return is_finite(position) ? std::optional(position) : std::nullopt;
}

bool Library::set_force(int id, Vec3 newton) {
    return calls_->call(Function::set_force, id, std::array{newton.x, newton.y, newton.z}, {}) >= 0;
}

double Library::start_watchdog(int id) {
    std::array<double, 1> periods{};
    const bool set_it = ask(Function::enable_expert_mode) >= 0 &&
                        set(Function::set_watchdog, id, kWatchdogPeriods) &&
                        calls_->call(Function::get_watchdog, id, {}, periods) >= 0;
    return set_it ? periods[0] * kWatchdogPeriod_ms : 0.0;
}

}  // namespace dibhr::forcedimension
