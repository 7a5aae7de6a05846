// Moves the simulated hand and device by lines of text.
#include "device/inverse3/simulated/hand_script.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/files/plain_text.hpp"

namespace dibhr::inverse3::simulated {

namespace {

constexpr Vec3 kMiddle_m{0.0, -0.15, 0.18};
constexpr double kMetre_mm = 1000.0;

/// Moves the hand from where it is to `to_m`, smoothly at both ends.
void move_hand(Scene& scene, Vec3 to_m, double seconds, double now_s) {
    const Vec3 from_m = scene.hand_m         ? scene.hand_m(now_s)
                        : scene.arms.empty() ? to_m
                                             : scene.arms.front().position_m;
    scene.hand_m = [=](double t_s) {
        const double share = seconds > 0.0 ? std::clamp((t_s - now_s) / seconds, 0.0, 1.0) : 1.0;
        return from_m + share * share * (3.0 - 2.0 * share) * (to_m - from_m);
    };
}

bool press(Scene& scene, const std::string& button, bool down) {
    constexpr std::array kNames{"A", "B", "C", "HOME"};
    const auto* const found = std::find(kNames.begin(), kNames.end(), button);
    if (found == kNames.end() || scene.grips.empty()) return false;
    const auto bit = static_cast<std::uint8_t>(1U << (found - kNames.begin()));
    std::uint8_t& buttons = scene.grips.front().buttons;
    buttons = static_cast<std::uint8_t>(down ? buttons | bit : buttons & ~bit);
    return true;
}

/// "on" and "off"; anything else is neither.
bool set_flag(Scene& scene, const std::string& name, const std::string& value) {
    if (value != "on" && value != "off") return false;
    const bool on = value == "on";
    if (name == "silence") {
        scene.behaviour.answers = !on;
        return true;
    }
    if (scene.arms.empty()) return false;
    Arm& arm = scene.arms.front();
    bool* const flag = name == "calibrated" ? &arm.calibrated
                       : name == "power"    ? &arm.powered
                       : name == "in_use"   ? &arm.in_use
                                            : nullptr;
    if (flag != nullptr) *flag = on;
    return flag != nullptr;
}

std::string state_of(const Scene& scene) {
    if (scene.arms.empty()) return "no device";
    const Arm& arm = scene.arms.front();
    const Vec3 mm = kMetre_mm * (arm.position_m - kMiddle_m);
    std::string text = "hand_mm";
    for (int axis = 0; axis < 3; ++axis) text += ' ' + number_text(mm[axis], 2);
    text += " force_newton";
    for (int axis = 0; axis < 3; ++axis) text += ' ' + number_text(arm.force_newton[axis], 3);
    return text;
}

}  // namespace

HandScript::HandScript(Service& service) : service_(service) {}

std::string HandScript::run_line(const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    if (!(words >> verb)) return {};
    std::string first;
    std::string second;
    bool done = true;
    const double now_s = service_.seconds();
    if (verb == "drop") {
        service_.drop_clients(Loss::reset);
    } else if (verb == "state") {
        return service_.with([](const Scene& scene) { return state_of(scene); });
    } else if (verb == "hand") {
        Vec3 mm{0.0};
        double seconds = 0.0;
        done = static_cast<bool>(words >> mm.x >> mm.y >> mm.z >> seconds);
        if (done && is_finite(mm)) {
            service_.with([&](Scene& scene) {
                move_hand(scene, kMiddle_m + mm / kMetre_mm, seconds, now_s);
            });
        }
    } else if (verb == "plug" || verb == "unplug") {
        service_.with([&](Scene& scene) {
            scene.arms.clear();
            if (verb == "plug") scene.arms.push_back({});
        });
    } else {
        done = static_cast<bool>(words >> first) && service_.with([&](Scene& scene) {
            if (verb != "button") return set_flag(scene, verb, first);
            return (words >> second) && press(scene, first, second == "down");
        });
    }
    return done ? std::string{} : "not understood: " + line;
}

}  // namespace dibhr::inverse3::simulated
