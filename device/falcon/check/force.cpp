// Steps 6 and 7, with a kitchen scale under the grip: how long a force lasts after its last packet,
// and the torque scale S, by least squares (../README.md: Safety numbers, Motors).
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/check/context.hpp"
#include "device/falcon/check/push.hpp"

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

constexpr int kWeak_counts = 300;
// A smaller motion between force and no force cannot be evaluated.
constexpr double kLeastMotion_counts = 10.0;
// A user can see a scale fall only in a silence of at least this length.
constexpr milliseconds kVisible{100};

struct Silence {
    Vec3 pushed{0.0};         ///< counts at the end of the hold
    Vec3 after{0.0};          ///< right after the silence
    Vec3 without_force{0.0};  ///< later, without force

    /// The part of the force that was left after the silence, from the grip's motion; nothing when
    /// the grip moved too little.
    [[nodiscard]] std::optional<double> part_left() const {
        const double whole = glm::distance(pushed, without_force);
        if (whole < kLeastMotion_counts) return std::nullopt;
        return glm::dot(after - without_force, pushed - without_force) / (whole * whole);
    }
};

PushEnd push_and_pause(CheckContext& context, const Counts& motor, milliseconds time,
                       Silence& silence) {
    Push push(context, motor);
    PushEnd end = push.rise();
    if (end == PushEnd::held) end = push.hold(context.options.times.short_hold);
    silence.pushed = as_vec(push.last_reply().encoder);
    Reply reply;
    if (end == PushEnd::held) end = push.pause_sending(time, reply);
    silence.after = as_vec(reply.encoder);
    return end;
}

/// Measures one silence; returns the result as text.
std::string check_one(CheckContext& context, milliseconds time, Json& part) {
    const Vec3 without_force = sample_counts(context).mean;
    const Counts motor = downward(context, without_force, kWeak_counts);
    context.agree_to_force(
        "The grip will press down with " + strength_of(context, motor, without_force) +
        " for about a second, then the program is silent for " + std::to_string(time.count()) +
        " ms. Any key ends the force. Look at the scale. F and Enter = force, s = skip, q = quit");
    Silence silence;
    const PushEnd end = push_and_pause(context, motor, time, silence);
    part["silence_ms"] = time.count();
    part["motor_counts"] = motor;
    part["end"] = sentence_of(end);
    context.console.print(end == PushEnd::held ? "no force any more" : sentence_of(end));
    if (end != PushEnd::held) return "not measured";
    silence.without_force = sample_counts(context).mean;
    part["counts_pushed"] = as_json(silence.pushed);
    part["counts_after_silence"] = as_json(silence.after);
    part["counts_without_force"] = as_json(silence.without_force);
    std::string found;
    if (const auto left = silence.part_left()) {
        part["part_of_the_force_left"] = *left;
        found = std::to_string(std::lround(*left * 100.0)) + " % of it is left by the encoders";
    } else {
        found = "the grip did not give way";
    }
    if (time < kVisible) return found;
    const std::string seen = context.word(
        "Did the scale keep its weight to the end of the silence? y = yes, n = it fell before, "
        "Enter alone = not seen");
    part["scale_kept_its_weight"] = seen;
    return seen.empty() ? found : found + ", the scale kept its weight: " + seen;
}

constexpr std::array kCounts{500, 1000, 2000, 4095};  // from weak to strong
constexpr int kFullScale = 4095;
constexpr double kHeaviest_g = 10000.0;

struct Reading {
    int counts{0};
    double unit_newton{0.0};  ///< the force for a torque scale of 1 count per newton metre
    double force_newton{0.0};
};

/// S of force = unit / S, by least squares.
std::optional<double> torque_scale(const std::vector<Reading>& readings) {
    double products = 0.0;
    double squares = 0.0;
    for (const Reading& one : readings) {
        products += one.force_newton * one.unit_newton;
        squares += one.unit_newton * one.unit_newton;
    }
    if (!(products > 0.0)) return std::nullopt;
    return squares / products;
}

PushEnd push_and_hold(CheckContext& context, const Counts& motor, CountsSample& held) {
    Push push(context, motor);
    PushEnd end = push.rise();
    if (end == PushEnd::held) end = push.hold(context.options.times.hold);
    held = push.held();
    if (end == PushEnd::held) end = push.fall();
    return end;
}

void agree(CheckContext& context, int counts, const std::string& strength) {
    const std::string warning =
        "The grip will press down with " + strength + ", " + std::to_string(counts) +
        " counts, for 3 s. Any key ends the force. Read the scale meanwhile. ";
    if (counts < kFullScale) {
        context.agree_to_force(warning + "F and Enter = force, s = skip, q = quit");
        return;
    }
    const std::string answer =
        context.word(warning +
                     "This is ALL it has: nothing but the scale under the grip. Type yes "
                     "for the force, s = skip, q = quit");
    if (answer != "yes") throw StepSkipped{};
}

/// Weighs one force, repeated as often as the user wants; nothing without a reading.
std::optional<Reading> weigh(CheckContext& context, int counts, Json& part) {
    for (;;) {
        const Vec3 without_force = sample_counts(context).mean;
        const Counts motor = downward(context, without_force, counts);
        agree(context, counts, strength_of(context, motor, without_force));
        CountsSample held;
        const PushEnd end = push_and_hold(context, motor, held);
        context.console.print(end == PushEnd::held ? "no force any more" : sentence_of(end));
        // A key may also mean that the scale was read before the time was over.
        const bool readable =
            held.replies > 0 && (end == PushEnd::held || end == PushEnd::released);
        if (readable) {
            part["motor_counts"] = motor;
            part["counts_without_force"] = as_json(without_force);
            part["counts_held"] = as_json(held.mean);
            part["end"] = sentence_of(end);
            const auto grams = context.number(
                "What did the scale show? [g] (Enter alone = not seen)", 0.0, kHeaviest_g);
            const auto unit = downward_force(motor, held.mean, context.options.geometry);
            if (!grams || !unit) return std::nullopt;
            const Reading reading{counts, *unit, *grams / 1000.0 * kStandardGravity};
            part["scale_g"] = *grams;
            part["force_newton"] = reading.force_newton;
            part["force_for_one_count_per_newton_metre_newton"] = *unit;
            // A reading of zero gives no torque scale.
            if (reading.force_newton > 0.0)
                part["counts_per_newton_metre"] = *unit / reading.force_newton;
            return reading;
        }
        if (context.word("Enter = the same force again, n = the next one, s = skip, q = quit") ==
            "n") {
            part["end"] = sentence_of(end);
            return std::nullopt;
        }
    }
}

void record_answer(CheckContext& context, const std::vector<Reading>& readings, Json& measured) {
    const auto scale = torque_scale(readings);
    if (!scale) return;
    context.counts_per_newton_metre = scale;
    double worst_newton = 0.0;
    for (const Reading& one : readings) {
        worst_newton =
            std::max(worst_newton, std::abs(one.force_newton - one.unit_newton / *scale));
    }
    measured["counts_per_newton_metre_after_" + std::to_string(readings.back().counts)] = *scale;
    context.findings.record_answer(
        OpenQuestion::torque_scale,
        number_text(*scale, 0) + " from " + std::to_string(readings.size()) + " readings up to " +
            std::to_string(readings.back().counts) + " counts, which it misses by at most " +
            number_text(worst_newton, 2) + " N");
    context.findings.set("counts-per-newton-metre", number_text(*scale, 0));
}

}  // namespace

void check_silence(CheckContext& context, Json& measured) {
    home_with_person(context, measured);
    std::string found;
    for (const milliseconds time : context.options.times.silences) {
        const std::string name = std::to_string(time.count()) + " ms";
        Json& part = measured["after " + name] = Json::object();
        found += (found.empty() ? "" : "; ") + name + ": " + check_one(context, time, part);
        context.findings.record_answer(OpenQuestion::after_last_packet, found);
    }
}

void check_force(CheckContext& context, Json& measured) {
    home_with_person(context, measured);
    std::vector<Reading> readings;
    for (const int counts : kCounts) {
        Json& part = measured[std::to_string(counts) + "_counts"] = Json::object();
        if (const auto reading = weigh(context, counts, part)) readings.push_back(*reading);
        record_answer(context, readings, measured);
    }
}

}  // namespace dibhr::falcon
