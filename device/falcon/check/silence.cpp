// Step 6: does a force outlive its last packet? (../README.md, Safety numbers)
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include <glm/geometric.hpp>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/push.hpp"

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

constexpr int kCounts = 300;
// A motion of fewer counts between force and no force tells nothing.
constexpr double kLeastMotion_counts = 10.0;
// A person sees a scale fall only after so long.
constexpr milliseconds kVisible{100};

struct Silence {
    Vec3 pushed{0.0};         ///< counts at the end of the hold
    Vec3 after{0.0};          ///< right after the silence
    Vec3 without_force{0.0};  ///< later, without force

    /// The part of the force that was still there after the silence, as far as the grip's place
    /// tells; nothing when the grip gave way too little.
    [[nodiscard]] std::optional<double> part_left() const {
        const double whole = glm::distance(pushed, without_force);
        if (whole < kLeastMotion_counts) return std::nullopt;
        return glm::dot(after - without_force, pushed - without_force) / (whole * whole);
    }
};

PushEnd push_and_fall_silent(CheckDesk& desk, const Counts& motor, milliseconds time,
                             Silence& silence) {
    Push push(desk, motor);
    PushEnd end = push.rise();
    if (end == PushEnd::held) end = push.hold(desk.options.times.short_hold);
    silence.pushed = as_vec(push.last_reply().encoder);
    Reply reply;
    if (end == PushEnd::held) end = push.be_silent(time, reply);
    silence.after = as_vec(reply.encoder);
    return end;
}

std::string percent(double part) {
    return std::to_string(std::lround(part * 100.0)) + " %";
}

/// In words: what was seen after this silence.
std::string check_one(CheckDesk& desk, milliseconds time, Json& part) {
    const Vec3 without_force = sample_counts(desk).mean;
    const Counts motor = downward(desk, without_force, kCounts);
    desk.wait_for("The grip will press down with " + strength_of(desk, motor, without_force) +
                  " for about a second, then the program is silent for " +
                  std::to_string(time.count()) +
                  " ms. Any key lets go. Look at the scale. Enter = force, s = skip, q = quit");
    Silence silence;
    const PushEnd end = push_and_fall_silent(desk, motor, time, silence);
    part["silence_ms"] = time.count();
    part["motor_counts"] = motor;
    part["end"] = sentence_of(end);
    desk.guide.say(end == PushEnd::held ? "no force any more" : sentence_of(end));
    if (end != PushEnd::held) return "not measured";
    silence.without_force = sample_counts(desk).mean;
    part["counts_pushed"] = as_json(silence.pushed);
    part["counts_after_silence"] = as_json(silence.after);
    part["counts_without_force"] = as_json(silence.without_force);
    std::string found;
    if (const auto left = silence.part_left()) {
        part["part_of_the_force_left"] = *left;
        found = percent(*left) + " of it is left by the encoders";
    } else {
        found = "the grip did not give way";
    }
    if (time < kVisible) return found;
    const std::string seen = desk.word(
        "Did the scale keep its weight to the end of the silence? y = yes, n = it fell before, "
        "Enter alone = not seen");
    part["scale_kept_its_weight"] = seen;
    return seen.empty() ? found : found + ", the scale kept its weight: " + seen;
}

}  // namespace

void check_silence(CheckDesk& desk, Json& measured) {
    home_with_person(desk, measured);
    std::string found;
    for (const milliseconds time : desk.options.times.silences) {
        const std::string name = std::to_string(time.count()) + " ms";
        Json& part = measured["after " + name] = Json::object();
        found += (found.empty() ? "" : "; ") + name + ": " + check_one(desk, time, part);
        desk.findings.settle(OpenQuestion::after_last_packet, found);
    }
}

}  // namespace dibhr::falcon
