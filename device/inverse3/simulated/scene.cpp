// The devices of the simulated service as JSON, and the effect of a client's messages.
#include "device/inverse3/simulated/scene.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/files/json.hpp"

namespace dibhr::inverse3::simulated {

namespace {

Json vector_of(Vec3 v) {
    return {{"x", v.x}, {"y", v.y}, {"z", v.z}};
}

Json config_of(const Arm& arm, bool newer) {
    Json config{{"type", arm.minverse ? "minverse" : "inverse3"},
                {"handedness", arm.handedness},
                {"gravity_compensation", {{"enabled", true}}}};
    if (newer) config["preset"] = arm.preset;
    config["basis"] = {{"permutation", arm.basis}};
    return config;
}

constexpr const char* kPositionHere = "position is put here";

Json entry_of(const Arm& arm, const Scene& scene, bool whole) {
    const bool newer = scene.behaviour.newer_shape;
    Json entry{{"device_id", arm.id}};
    if (whole) entry["config"] = config_of(arm, newer);
    Json state{{"cursor_position", vector_of(arm.position_m)},
               {"cursor_velocity", vector_of(arm.velocity_m_per_s)}};
    if (!arm.position_text.empty()) state["cursor_position"] = kPositionHere;
    if (newer) state["current_cursor_force"] = vector_of(arm.force_newton);
    entry["state"] = std::move(state);
    entry["status"] = {{"calibrated", arm.calibrated},
                       {"in_use", arm.in_use},
                       {"power_supply", arm.powered},
                       {"ready", arm.ready && arm.calibrated && arm.powered},
                       {"started", true}};
    return entry;
}

Json entry_of(const Grip& grip) {
    constexpr std::array kLetters{"a", "b", "c", "home"};
    Json buttons = Json::object();
    for (std::size_t k = 0; k < kLetters.size(); ++k) {
        const std::string name = grip.numbered ? "button_" + std::to_string(k) : kLetters[k];
        buttons[name] = (grip.buttons >> k & 1U) != 0;
    }
    Json state{{"orientation", {{"w", 1}, {"x", 0}, {"y", 0}, {"z", 0}}}};
    if (grip.list == "verse_grip") {
        state["button"] = (grip.buttons & 1U) != 0;
        state["hall"] = 3;
    } else {
        state["buttons"] = std::move(buttons);
        state["battery_level"] = grip.battery;
    }
    return {{"device_id", grip.id},
            {"state", std::move(state)},
            {"status", {{"connected", true}, {"awake", grip.awake}, {"ready", grip.awake}}}};
}

std::optional<Vec3> vector_in(const Json& force, const char* dialect) {
    const auto found = force.find(dialect);
    if (found == force.end() || !found->is_object()) return {};
    return Vec3{found->value("x", 0.0), found->value("y", 0.0), found->value("z", 0.0)};
}

void apply_force(Scene& scene, const Json& force, Arm* arm, Clock::time_point now,
                 MessageEffect& done) {
    const AcceptedDialect accepts = scene.behaviour.accepts;
    const auto vector = vector_in(force, "vector");
    const auto values = vector_in(force, "values");
    done.drives = true;
    done.force_newton = vector ? *vector : values.value_or(Vec3{0.0});
    done.wrong_dialect =
        vector ? accepts == AcceptedDialect::values : accepts == AcceptedDialect::vector;
    if (arm == nullptr || done.wrong_dialect) return;
    arm->force_newton = done.force_newton;
    arm->force_at = now;
}

void apply_to_device(Scene& scene, const Json& device, Clock::time_point now, MessageEffect& done) {
    done.arm = device.value("device_id", "");
    Arm* const arm = scene.arm(done.arm);
    const Json configure = device.value("configure", Json::object());
    done.requests_preset = configure.contains("preset");
    if (arm != nullptr && done.requests_preset && scene.behaviour.takes_preset) {
        arm->preset = configure["preset"].value("preset", arm->preset);
        arm->basis = "XYZ";
    }
    const Json commands = device.value("commands", Json::object());
    if (commands.contains("set_cursor_force")) {
        apply_force(scene, commands["set_cursor_force"], arm, now, done);
    }
}

void apply_commands(Scene& scene, const Json& root, Clock::time_point now, MessageEffect& done) {
    done.requests_whole_state =
        root.value("session", Json::object()).contains("force_render_full_state");
    for (const Json& device : root.value("inverse3", Json::array())) {
        apply_to_device(scene, device, now, done);
    }
}

}  // namespace

Arm* Scene::arm(std::string_view id) {
    const auto found =
        std::find_if(arms.begin(), arms.end(), [&](const Arm& one) { return one.id == id; });
    return found == arms.end() ? nullptr : &*found;
}

void Scene::forget_old_forces(Clock::time_point now) {
    if (behaviour.force_held.count() == 0) return;
    for (Arm& one : arms) {
        if (now - one.force_at > behaviour.force_held) one.force_newton = Vec3{0.0};
    }
}

std::string state_text(const Scene& scene, bool whole) {
    Json message;
    if (scene.behaviour.newer_shape) message["session_id"] = 7;
    message["inverse3"] = Json::array();
    for (const Arm& arm : scene.arms) message["inverse3"].push_back(entry_of(arm, scene, whole));
    for (const Grip& grip : scene.grips) message[grip.list].push_back(entry_of(grip));
    message["something_new"] = {{"of", "a later version"}};
    std::string text = json_line(message);
    for (const Arm& arm : scene.arms) {
        const std::string here = '"' + std::string(kPositionHere) + '"';
        const auto at = text.find(here);
        if (at != std::string::npos) text.replace(at, here.size(), arm.position_text);
    }
    return text;
}

MessageEffect apply_message(Scene& scene, std::string_view message, Clock::time_point now) {
    MessageEffect done;
    const Json root = parsed_json(message);
    if (!root.is_object()) return done;
    try {
        apply_commands(scene, root, now, done);
        done.understood = true;
    } catch (const Json::exception&) {
        done.understood = false;  // a member has the wrong type
    }
    return done;
}

}  // namespace dibhr::inverse3::simulated
