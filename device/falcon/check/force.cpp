// Step 7: the force at the grip on a kitchen scale, and the torque scale S that follows by least
// squares (../README.md, Motors).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/push.hpp"

namespace dibhr::falcon {

namespace {

constexpr std::array kCounts{500, 1000, 2000, 4095};  // from weak to strong
constexpr int kFullScale = 4095;
constexpr double kStandardGravity = 9.80665;  // m/s2
constexpr double kHeaviest_g = 10000.0;

struct Reading {
    int counts{0};
    double unit_newton{0.0};  ///< the force for one count a newton metre
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

PushEnd push_and_hold(CheckDesk& desk, const Counts& motor, CountsSample& held) {
    Push push(desk, motor);
    PushEnd end = push.rise();
    if (end == PushEnd::held) end = push.hold(desk.options.times.hold);
    held = push.held();
    if (end == PushEnd::held) end = push.fall();
    return end;
}

void agree(CheckDesk& desk, int counts, const std::string& strength) {
    const std::string warning = "The grip will press down with " + strength + ", " +
                                std::to_string(counts) +
                                " counts, for 3 s. Any key lets go. Read the scale meanwhile. ";
    if (counts < kFullScale) {
        desk.wait_for(warning + "Enter = force, s = skip, q = quit");
        return;
    }
    const std::string answer =
        desk.word(warning +
                  "This is ALL it has: nothing but the scale under the grip. Type yes "
                  "for the force, s = skip, q = quit");
    if (answer != "yes") throw StepSkipped{};
}

/// One force, as often as the person wants; nothing without a reading.
std::optional<Reading> weigh(CheckDesk& desk, int counts, Json& part) {
    for (;;) {
        const Vec3 without_force = sample_counts(desk).mean;
        const Counts motor = downward(desk, without_force, counts);
        agree(desk, counts, strength_of(desk, motor, without_force));
        CountsSample held;
        const PushEnd end = push_and_hold(desk, motor, held);
        desk.guide.say(end == PushEnd::held ? "no force any more" : sentence_of(end));
        // A key that was pressed because the scale had been read is as good as the time.
        const bool readable = held.replies > 0 && (end == PushEnd::held || end == PushEnd::let_go);
        if (readable) {
            part["motor_counts"] = motor;
            part["counts_without_force"] = as_json(without_force);
            part["counts_held"] = as_json(held.mean);
            part["end"] = sentence_of(end);
            const auto grams = desk.number("What did the scale show? [g] (Enter alone = not seen)",
                                           0.0, kHeaviest_g);
            const auto unit = downward_force(motor, held.mean, desk.options.geometry);
            if (!grams || !unit) return std::nullopt;
            const Reading reading{counts, *unit, *grams / 1000.0 * kStandardGravity};
            part["scale_g"] = *grams;
            part["force_newton"] = reading.force_newton;
            part["force_for_one_count_per_newton_metre_newton"] = *unit;
            part["counts_per_newton_metre"] = *unit / reading.force_newton;
            return reading;
        }
        if (desk.word("Enter = the same force again, n = the next one, s = skip, q = quit") ==
            "n") {
            part["end"] = sentence_of(end);
            return std::nullopt;
        }
    }
}

void settle(CheckDesk& desk, const std::vector<Reading>& readings, Json& measured) {
    const auto scale = torque_scale(readings);
    if (!scale) return;
    desk.counts_per_newton_metre = scale;
    double worst_newton = 0.0;
    for (const Reading& one : readings) {
        worst_newton =
            std::max(worst_newton, std::abs(one.force_newton - one.unit_newton / *scale));
    }
    measured["counts_per_newton_metre_after_" + std::to_string(readings.back().counts)] = *scale;
    desk.findings.settle(OpenQuestion::torque_scale,
                         in_decimals(*scale) + " from " + std::to_string(readings.size()) +
                             " readings up to " + std::to_string(readings.back().counts) +
                             " counts, which it misses by at most " + in_decimals(worst_newton, 2) +
                             " N");
    desk.findings.set("counts-per-newton-metre", in_decimals(*scale));
}

}  // namespace

void check_force(CheckDesk& desk, Json& measured) {
    home_with_person(desk, measured);
    std::vector<Reading> readings;
    for (const int counts : kCounts) {
        Json& part = measured[std::to_string(counts) + "_counts"] = Json::object();
        if (const auto reading = weigh(desk, counts, part)) readings.push_back(*reading);
        settle(desk, readings, measured);
    }
}

}  // namespace dibhr::falcon
