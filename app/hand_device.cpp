// Makes the device named on the command line.
#include "app/hand_device.hpp"

#include <utility>

#include "core/error.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

HandDevice mouse_hand() {
    auto mouse = std::make_unique<MouseHand>();
    MouseHand* end = mouse.get();
    return {std::move(mouse), end};
}

}  // namespace

HandDevice make_hand_device(const std::string& name) {
    constexpr std::string_view kGoals = "goals:";
    if (name == "auto" || name == "mouse") return mouse_hand();
    if (name.starts_with(kGoals)) {
        return {std::make_unique<GoalStream>(name, read_goals(name.substr(kGoals.size()))),
                nullptr};
    }
    if (name == "falcon") {
        throw DeviceError("falcon: this version has no driver for the Falcon; use --device mouse");
    }
    throw DeviceError("no device is called " + name + "; use auto, mouse, falcon or goals:FILE");
}

}  // namespace dibhr
