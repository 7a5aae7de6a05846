// A Touch under check.
#include "device/openhaptics/check/checked_touch.hpp"

#include <chrono>
#include <glm/geometric.hpp>
#include <thread>

#include "core/error.hpp"
#include "device/openhaptics/openhaptics_device.hpp"
#include "device/openhaptics/survey.hpp"

namespace dibhr::openhaptics {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::chrono::seconds kPatience{2};  // until a pose is valid again
constexpr milliseconds kReported{100};        // the driver tells of the servo's errors
constexpr std::chrono::microseconds kLook{50};
constexpr double kMetre_mm = 1000.0;

/// In a silence no frame begins, and the force output stays on: the driver would switch it off, and
/// what the device does by itself could not be felt.
ConnectionOptions held_up(ConnectionOptions options,
                          const std::shared_ptr<std::atomic<bool>>& silent) {
    options.around = [silent](const HdLibrary& library) {
        HdLibrary held = library;
        held.begin_frame = [silent, begin = library.begin_frame](HdHandle device) {
            while (*silent) std::this_thread::sleep_for(milliseconds(1));
            begin(device);
        };
        held.disable = [silent, disable = library.disable](HdEnum what) {
            if (!*silent) disable(what);
        };
        return held;
    };
    return options;
}

}  // namespace

TouchUnderCheck::TouchUnderCheck(const ConnectionOptions& options)
    : driver_(held_up(options, silent_), buffers_), found_(known_status(driver_)) {
    if (found_.stage != Stage::ready) throw DeviceError(found_.sentence);
}

std::string TouchUnderCheck::name() const {
    return "the 3D Systems " + found_.model + " " + found_.serial;
}

Json TouchUnderCheck::about() const {
    return {{"model", found_.model},
            {"library", found_.library},
            {"library_version", found_.version},
            {"driver", found_.driver},
            {"continuous_newton", found_.continuous_newton},
            {"peak_newton", found_.peak_newton},
            {"stiffness_newton_per_mm", found_.stiffness_newton_per_mm},
            {"calibration_styles", found_.style}};
}

std::string TouchUnderCheck::unguarded() const {
    return state_of(found_).unguarded;
}

std::vector<TimedCall> TouchUnderCheck::calls() {
    return {{"servo tick", [this] { (void)position_m(); }}};
}

/// The newest pose that may get a force, read at `from` or later.
TimedPose TouchUnderCheck::pose(Clock::time_point from) {
    const auto until = Clock::now() + kPatience;
    while (Clock::now() < until) {
        const TimedPose& newest = buffers_->poses.front();
        const auto old_at = newest.at + ArmBuffers::kOldestForce;
        if (newest.epoch != kNoEpoch && newest.at >= from && Clock::now() < old_at) return newest;
        std::this_thread::sleep_for(kLook);
    }
    throw DeviceError(driver_.status().sentence);
}

Vec3 TouchUnderCheck::position_m() {
    return pose(Clock::now()).position_m;
}

void TouchUnderCheck::set_force(Vec3 newton) {
    const Epoch epoch = pose().epoch;
    buffers_->forces.publish({newton, Clock::now(), epoch});
}

void TouchUnderCheck::release_force() noexcept {
    buffers_->forces.publish(TimedForce{});
    *silent_ = false;
}

void TouchUnderCheck::fall_silent() {
    silent_at_m_ = position_m();
    errors_ = driver_.status().errors;
    *silent_ = true;
}

std::optional<bool> TouchUnderCheck::force_after(Json& line) {
    release_force();
    // A hand that holds the grip draws it back where the force has ended.
    line["rose_mm"] = -kMetre_mm * glm::dot(position_m() - silent_at_m_, down());
    std::this_thread::sleep_for(kReported);
    const Status now = driver_.status();
    line["errors"] = now.errors - errors_;
    line["last_error"] = now.last_error;
    return std::nullopt;
}

}  // namespace dibhr::openhaptics
