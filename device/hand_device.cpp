// Makes the device named on the command line.
#include "device/hand_device.hpp"

#include <cstddef>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "device/device_or_mouse.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kGoals = "goals:";

HandDevice mouse_hand() {
    HandDevice hand;
    auto mouse = std::make_unique<MouseHand>();
    hand.mouse = mouse.get();
    hand.device = std::move(mouse);
    return hand;
}

/// The part of `name` behind `start`; empty: there is none.
std::string after(std::string_view start, std::string_view name) {
    return name.starts_with(start) ? std::string(name.substr(start.size())) : std::string{};
}

/// The kind that a name asks for, and which device of it; no kind: all of them.
struct Named {
    const ForceDeviceKind* kind{nullptr};
    std::string which{};
};
Named named(const std::string& name) {
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        if (name == kind->name) return {kind, {}};
        std::string which = after(std::string(kind->name) + ":", name);
        if (!which.empty()) return {kind, std::move(which)};
    }
    return {};
}

/// The requested devices, with the mouse as fallback.
HandDevice device_hand(const DeviceChoice& choice, const Named& requested) {
    HandDevice hand;
    DeviceOrMouse::Devices devices;
    const DeviceArguments given{requested.which, choice.firmware};
    for (std::size_t k = 0; k < force_device_kinds().size(); ++k) {
        const ForceDeviceKind& kind = *force_device_kinds()[k];
        auto& device = devices.emplace_back();
        if (requested.kind != nullptr && requested.kind != &kind) continue;
        if (requested.kind != nullptr) {
            const std::string refusal = kind.why_none(choice.settings[k], given);
            if (!refusal.empty()) throw DeviceError(refusal);
        }
        device = kind.make(choice.settings[k], given);
    }
    for (const auto& device : devices) hand.devices.push_back(device.get());
    auto all = std::make_unique<DeviceOrMouse>(std::move(devices));
    hand.mouse = &all->mouse();
    hand.device = std::move(all);
    return hand;
}

}  // namespace

bool names_device(const std::string& name) {
    return name == "auto" || name == "mouse" || !after(kGoals, name).empty() ||
           named(name).kind != nullptr;
}

bool moves_hand(const std::string& name) {
    return name != "mouse" && after(kGoals, name).empty();
}

std::string device_names(const std::string& of_auto) {
    std::string names = "auto" + of_auto;
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        const std::string name = kind->name;
        names += ", " + name + ", " + name + ":" + kind->which;
    }
    return names + ", mouse or goals:FILE";
}

std::string meaning_of_auto() {
    std::string articles;
    for (const ForceDeviceKind* const kind : force_device_kinds())
        articles += (articles.empty() ? "" : " or ") + std::string(kind->article);
    return " (" + articles + ", and the mouse until one is there)";
}

HandDevice make_hand_device(const std::string& name, const DeviceChoice& choice) {
    if (!names_device(name)) {
        throw DeviceError("no device is called " + name + "; use " + device_names());
    }
    if (name == "mouse") return mouse_hand();
    if (std::string file = after(kGoals, name); !file.empty()) {
        HandDevice hand;
        hand.device = std::make_unique<GoalStream>(name, read_goals(file));
        return hand;
    }
    return device_hand(choice, named(name));
}

}  // namespace dibhr
