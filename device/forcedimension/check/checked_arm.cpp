// A Force Dimension arm under check.
#include "device/forcedimension/check/checked_arm.hpp"

#include <thread>
#include <utility>

#include "core/error.hpp"
#include "device/forcedimension/models.hpp"
#include "device/forcedimension/usb_bus.hpp"

namespace dibhr::forcedimension {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kSettle{100};
constexpr std::chrono::milliseconds kBetweenForces{1};

}  // namespace

ArmUnderCheck::ArmUnderCheck(const ConnectionOptions& options) {
    const UsbBus bus = read_usb_bus(options.usb_devices);
    FoundCalls calls = load_calls(options.library);
    if (calls.calls == nullptr)
        throw DeviceError(calls.trouble.empty() ? why_no_library(bus) : calls.trouble);
    const auto library = std::make_shared<Library>(std::move(calls.calls));
    found_.library = library->file() + ", version " + library->version();
    ArmSearch search(library, bus);
    while ((arm_ = search.next()) != nullptr) {
        arm_->identify(found_);
        if (options.serial.empty() || found_.serial == options.serial) break;
    }
    if (arm_ == nullptr) throw DeviceError(why_no_arm(search, bus, options.serial).sentence);
    const ArmStatus now = status();
    if (!now.power) throw DeviceError(sentence_for(Stage::no_power, found_));
    if (!now.initialised) throw DeviceError(sentence_for(Stage::not_initialised, found_));
    arm_->prepare(found_);
}

Json ArmUnderCheck::about() const {
    return {{"type", found_.type},
            {"library", found_.library},
            {"controller", found_.controller_version ? Json(*found_.controller_version) : Json()},
            {"watchdog_ms", found_.watchdog_ms},
            {"library_limits_force", found_.clamped}};
}

double ArmUnderCheck::most_newton() const {
    return model_of(found_.type).force_newton;
}

std::vector<TimedCall> ArmUnderCheck::calls() {
    return {{"position", [this] { (void)position_m(); }},
            {"status", [this] { (void)status(); }},
            {"buttons", [this] { (void)library().buttons(id()); }}};
}

Vec3 ArmUnderCheck::position_m() {
    if (const auto position = library().position_m(id())) return *position;
    throw DeviceError(name_of(found_) + " gave no position: check its USB cable and its power");
}

ArmStatus ArmUnderCheck::status() {
    if (const auto status = library().status(id())) return *status;
    throw DeviceError(name_of(found_) + " gave no status: check its USB cable and its power");
}

void ArmUnderCheck::switch_force_on() {
    if (!arm_->switch_force_on())
        throw DeviceError(name_of(found_) + " does not switch its force on: see its force button");
    const auto settled = Clock::now() + kSettle;
    while (Clock::now() < settled) {
        set_force(Vec3{0.0});
        std::this_thread::sleep_for(kBetweenForces);
    }
}

void ArmUnderCheck::set_force(Vec3 newton) {
    if (!library().set_force(id(), newton))
        throw DeviceError(name_of(found_) + " took no force: check its USB cable and its power");
}

void ArmUnderCheck::release_force() noexcept {
    library().set_force(id(), Vec3{0.0});
    library().stop(id());
}

std::optional<bool> ArmUnderCheck::force_after(Json& line) {
    const ArmStatus now = status();
    line["cause"] = static_cast<int>(now.cause);
    return now.force;
}

}  // namespace dibhr::forcedimension
