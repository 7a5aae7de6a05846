// The steps without force and without the user: the service's data, and the rate of exchanges.
#include <array>
#include <string>
#include <thread>

#include "core/files/plain_text.hpp"
#include "device/hand/check/numbers.hpp"
#include "device/inverse3/check/context.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::array kKept{"gravity compensation", "torque scaling", "filters", "force scale"};

/// The settings that the service keeps for a device, by name.
Json kept_of(const SurveyedArm& arm) {
    Json all;
    for (const char* const name : kKept) all[name] = "not answered";
    for (const KeptSetting& kept : arm.kept) {
        const Json answer = parsed_json(kept.answer);
        all[kept.name] = answer.is_discarded() ? Json(kept.answer) : answer;
    }
    return all;
}

/// The member `name`; null: there is none.
Json member(const Json& answer, const char* name) {
    return answer.is_object() ? answer.value(name, Json()) : Json();
}

std::string word(const Json& answer) {
    return answer.is_string() ? answer.get<std::string>() : "not told";
}

}  // namespace

void CheckContext::keep_alive() {
    (void)device.exchange(std::nullopt, likely_dialect());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void CheckContext::print_timeout(CheckTimes::Span after) const {
    const std::chrono::duration<double> seconds = after;
    console.print("It went on by itself, after " + number_text(seconds.count(), 1) +
                  " s without an Enter.");
}

Json reported_frame(const CheckedInverse3& device) {
    const Json config = config_in(device.configured_state(), device.id());
    return {{"preset", member(config, "preset")},
            {"basis", member(member(config, "basis"), "permutation")}};
}

void check_service(CheckContext& context, Json& measured) {
    const Survey survey = survey_service(context.options.connection);
    const CheckedInverse3& device = context.device;
    const Json config = config_in(device.configured_state(), device.id());
    measured["version"] = survey.version;
    measured["version_answer"] = device.version_answer();
    measured["type"] = member(config, "type");
    measured["handedness"] = member(config, "handedness");
    measured["preset_before"] = member(config_in(device.inventory(), device.id()), "preset");
    measured["preset_complaint"] = device.error_text();
    measured.update(reported_frame(device));
    measured["inventory_sent_at_once"] = device.inventory_unrequested();
    measured["inventory"] = device.inventory();
    measured["introduced"] = device.configured_state();
    for (const SurveyedArm& arm : survey.arms) measured["kept"][arm.id] = kept_of(arm);
    const std::string preset(context.options.connection.preset.view());
    if (device.newer() && word(measured["preset"]) != preset) {
        context.console.print("The service was asked for the preset \"" + preset +
                              "\", and tells: " + word(measured["preset"]) + ".");
    }
    context.findings.record_answer(
        OpenQuestion::service,
        (survey.version.empty() ? "version not told" : survey.version) + ", " +
            std::to_string(survey.arms.size()) + " device(s), " +
            std::to_string(survey.grips.size()) + " grip(s), inventory " +
            (device.inventory_unrequested() ? "sent at once" : "sent when asked for") +
            ", preset " + word(measured["preset"]));
}

void check_rate(CheckContext& context, Json& measured) {
    Sample round_trips_ms;
    Histogram histogram;
    const auto begin = CheckedInverse3::Clock::now();
    while (CheckedInverse3::Clock::now() < begin + context.options.times.rate) {
        context.quit_if_interrupted();
        const auto received = context.device.exchange(std::nullopt, context.likely_dialect());
        const std::chrono::duration<double, std::milli> took = received.round_trip;
        round_trips_ms.add(took.count());
        histogram.add(took.count());
    }
    const std::chrono::duration<double> took = CheckedInverse3::Clock::now() - begin;
    const double a_second = static_cast<double>(round_trips_ms.count()) / took.count();
    measured = {{"exchanges", round_trips_ms.count()},
                {"exchanges_per_s", a_second},
                {"round_trip_ms_p50", round_trips_ms.quantile(0.5)},
                {"round_trip_ms_p95", round_trips_ms.quantile(0.95)},
                {"round_trip_ms_p99", round_trips_ms.quantile(0.99)},
                {"round_trip_ms_max", round_trips_ms.most()},
                {"round_trip_histogram", histogram.as_json()}};
    const std::string words =
        rate_in_words(a_second, round_trips_ms) + ", without force and without pauses";
    context.console.print(words);
    context.findings.record_answer(OpenQuestion::rate, words);
}

}  // namespace dibhr::inverse3
