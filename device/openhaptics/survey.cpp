// The Touch that answers.
#include "device/openhaptics/survey.hpp"

#include <chrono>
#include <memory>
#include <thread>

namespace dibhr::openhaptics {

namespace {

constexpr std::chrono::seconds kPatience{8};
constexpr std::chrono::milliseconds kLookEvery{10};

bool is_known(Stage stage) noexcept {
    return stage != Stage::opening && stage != Stage::starting;
}

}  // namespace

Status known_status(const Driver& driver) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!is_known(driver.status().stage) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(kLookEvery);
    Status status = driver.status();
    if (status.stage == Stage::opening)
        status.sentence =
            "3D Systems' library did not answer within 8 s: unplug the Touch, plug it "
            "in again, and try 3D Systems' setup program";
    return status;
}

Status survey_device(const ConnectionOptions& options) {
    ConnectionOptions without_force = options;
    without_force.forces = false;
    return known_status(Driver(without_force, std::make_shared<ArmBuffers>()));
}

bool answers(const Status& status) noexcept {
    return status.stage > Stage::looking;
}

bool is_attached(const Status& status, const ConnectionOptions& options) {
    return answers(status) || status.stage == Stage::cannot_open || is_on_usb(options.usb_devices);
}

}  // namespace dibhr::openhaptics
