// The steps without force and without the user: the service's data, and the rate of exchanges.
#include <array>
#include <string>
#include <thread>

#include "core/files/plain_text.hpp"
#include "device/hand/check/numbers.hpp"
#include "device/inverse3/check/desk.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::array kKept{"gravity compensation", "torque scaling", "filters", "force scale"};

/// The settings that the service keeps for a device, by name.
Json kept_of(const SurveyedArm& arm) {
    Json all;
    for (const char* const name : kKept) all[name] = "not answered";
    for (const KeptSetting& kept : arm.kept) {
        const Json told = parsed_json(kept.told);
        all[kept.name] = told.is_discarded() ? Json(kept.told) : told;
    }
    return all;
}

/// The member `name`; null: there is none.
Json member(const Json& told, const char* name) {
    return told.is_object() ? told.value(name, Json()) : Json();
}

std::string word(const Json& told) {
    return told.is_string() ? told.get<std::string>() : "not told";
}

}  // namespace

void CheckDesk::keep_talking() {
    (void)talk.exchange(std::nullopt, likely_dialect());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void CheckDesk::tell_gone_on(CheckTimes::Span after) const {
    const std::chrono::duration<double> seconds = after;
    guide.say("It went on by itself, after " + number_text(seconds.count(), 1) +
              " s without an Enter.");
}

Json told_frame(const CheckTalk& talk) {
    const Json config = config_in(talk.introduced(), talk.id());
    return {{"preset", member(config, "preset")},
            {"basis", member(member(config, "basis"), "permutation")}};
}

void check_service(CheckDesk& desk, Json& measured) {
    const Survey survey = survey_service(desk.options.connection);
    const CheckTalk& talk = desk.talk;
    const Json config = config_in(talk.introduced(), talk.id());
    measured["version"] = survey.version;
    measured["version_answer"] = talk.version_answer();
    measured["type"] = member(config, "type");
    measured["handedness"] = member(config, "handedness");
    measured["preset_before"] = member(config_in(talk.inventory(), talk.id()), "preset");
    measured["preset_complaint"] = talk.complaint();
    measured.update(told_frame(talk));
    measured["inventory_sent_at_once"] = talk.inventory_unasked();
    measured["inventory"] = talk.inventory();
    measured["introduced"] = talk.introduced();
    for (const SurveyedArm& arm : survey.arms) measured["kept"][arm.id] = kept_of(arm);
    const std::string preset(desk.options.connection.preset.view());
    if (talk.newer() && word(measured["preset"]) != preset) {
        desk.guide.say("The service was asked for the preset \"" + preset +
                       "\", and tells: " + word(measured["preset"]) + ".");
    }
    desk.findings.settle(OpenQuestion::service,
                         (survey.version.empty() ? "version not told" : survey.version) + ", " +
                             std::to_string(survey.arms.size()) + " device(s), " +
                             std::to_string(survey.grips.size()) + " grip(s), inventory " +
                             (talk.inventory_unasked() ? "sent at once" : "sent when asked for") +
                             ", preset " + word(measured["preset"]));
}

void check_rate(CheckDesk& desk, Json& measured) {
    Sample round_trips_ms;
    Histogram histogram;
    const auto begin = CheckTalk::Clock::now();
    while (CheckTalk::Clock::now() < begin + desk.options.times.rate) {
        desk.quit_if_interrupted();
        const auto heard = desk.talk.exchange(std::nullopt, desk.likely_dialect());
        const std::chrono::duration<double, std::milli> took = heard.round_trip;
        round_trips_ms.add(took.count());
        histogram.add(took.count());
    }
    const std::chrono::duration<double> took = CheckTalk::Clock::now() - begin;
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
    desk.guide.say(words);
    desk.findings.settle(OpenQuestion::rate, words);
}

}  // namespace dibhr::inverse3
