// The steps without force: what the service says, how fast, and what positions come.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <thread>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/inverse3/check/desk.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr double kMetre_mm = 1000.0;

double quantile(std::vector<double>& values, double part) {
    if (values.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

Json as_json(Vec3 values) {
    return Json::array({values.x, values.y, values.z});
}

/// What positions came while somebody moved the grip.
struct Positions {
    Vec3 lowest_mm{1e9};
    Vec3 highest_mm{-1e9};
    double smallest_step_mm{0.0};  ///< along an axis, above 0
    int count{0};
    int changes{0};
    double seconds{0.0};

    void add(Vec3 position_mm) {
        lowest_mm = glm::min(lowest_mm, position_mm);
        highest_mm = glm::max(highest_mm, position_mm);
        if (count++ > 0) add_step(position_mm - last_mm_);
        last_mm_ = position_mm;
    }

  private:
    void add_step(Vec3 step_mm) {
        bool any = false;
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::abs(step_mm[axis]);
            if (!(step > 0.0)) continue;
            any = true;
            smallest_step_mm = smallest_step_mm > 0.0 ? std::min(smallest_step_mm, step) : step;
        }
        changes += any ? 1 : 0;
    }

    Vec3 last_mm_{0.0};
};

/// What the service tells of a device while its cable is out.
struct Absence {
    using Clock = CheckTalk::Clock;
    using Seconds = std::chrono::duration<double>;

    Seconds gone{0.0};    ///< longest time without an entry
    Seconds frozen{0.0};  ///< and with one whose position stayed
    bool not_powered{false}, not_calibrated{false}, not_ready{false};  ///< told meanwhile
    bool is_back{true};
    std::string ended_by{};  ///< what the service did in the end instead of answering

    void add(const std::optional<Arm>& arm, Clock::time_point now) {
        is_back = arm.has_value();
        if (!arm) {
            gone = std::max<Seconds>(gone, now - seen_);
            if (moved_) moved_ = now;
            return;
        }
        seen_ = now;
        not_powered = not_powered || !arm->powered;
        not_calibrated = not_calibrated || !arm->calibrated;
        not_ready = not_ready || arm->locked;
        const Vec3 position_m = arm->position_m.value_or(last_m_);
        if (count_++ > 0 && position_m != last_m_) moved_ = now;
        last_m_ = position_m;
        if (moved_) frozen = std::max<Seconds>(frozen, now - *moved_);
    }

    [[nodiscard]] std::string in_words(Seconds counts_as_frozen) const {
        std::string words;
        const auto say = [&words](const std::string& more) {
            words += (words.empty() ? "" : ", ") + more;
        };
        if (gone.count() > 0.0)
            say("it goes (" + number_text(gone.count(), 1) + " s)");
        else if (frozen > counts_as_frozen)
            say("it stays, frozen (" + number_text(frozen.count(), 1) + " s)");
        if (not_powered) say("told to have no power");
        if (not_calibrated) say("told not to be calibrated");
        if (not_ready) say("told not to be ready");
        if (!ended_by.empty()) say("and then: " + ended_by);
        if (words.empty()) say("nothing of it changed");
        return words;
    }

  private:
    Clock::time_point seen_{Clock::now()};
    std::optional<Clock::time_point> moved_{};  ///< before it has moved nothing is frozen
    Vec3 last_m_{0.0};
    int count_{0};
};

std::string names_in(const ServiceMessage& message) {
    std::string names;
    for (std::size_t k = 0; k < message.arm_count; ++k)
        names += (names.empty() ? "" : ", ") + std::string(message.arms[k].id.view());
    return names.empty() ? "nothing" : names;
}

}  // namespace

void CheckDesk::keep_talking() {
    (void)talk.exchange(std::nullopt, likely_dialect());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void check_service(CheckDesk& desk, Json& measured) {
    const Survey survey = survey_service(desk.options.connection);
    measured["version"] = survey.version;
    measured["inventory"] = desk.talk.inventory();
    for (const SurveyedArm& arm : survey.arms) {
        for (const KeptSetting& kept : arm.kept) measured["kept"][arm.id][kept.name] = kept.told;
    }
    desk.settle(OpenQuestion::service,
                (survey.version.empty() ? "version not told" : survey.version) + ", " +
                    std::to_string(survey.arms.size()) + " device(s), " +
                    std::to_string(survey.grips.size()) + " grip(s), inventory " +
                    (desk.talk.inventory().empty() ? "not sent" : "sent at once"));
}

void check_rate(CheckDesk& desk, Json& measured) {
    std::vector<double> round_trips_ms;
    const auto begin = CheckTalk::Clock::now();
    while (CheckTalk::Clock::now() < begin + desk.options.times.rate) {
        desk.quit_if_interrupted();
        const auto heard = desk.talk.exchange(std::nullopt, desk.likely_dialect());
        round_trips_ms.push_back(
            std::chrono::duration<double, std::milli>(heard.round_trip).count());
    }
    const std::chrono::duration<double> took = CheckTalk::Clock::now() - begin;
    const double a_second = static_cast<double>(round_trips_ms.size()) / took.count();
    const double half_ms = quantile(round_trips_ms, 0.5);
    const double most_ms = quantile(round_trips_ms, 0.99);
    measured = {{"exchanges", round_trips_ms.size()},
                {"exchanges_per_s", a_second},
                {"round_trip_ms_p50", half_ms},
                {"round_trip_ms_p99", most_ms},
                {"round_trip_ms_max", quantile(round_trips_ms, 1.0)}};
    const std::string words = number_text(a_second, 0) + " a second (half within " +
                              number_text(half_ms, 2) + " ms, 99 % within " +
                              number_text(most_ms, 2) + " ms)";
    desk.guide.say(words);
    desk.settle(OpenQuestion::rate, words);
}

void check_moving(CheckDesk& desk, Json& measured) {
    desk.guide.ask(
        "Move the grip slowly, then to every end; Enter when you have been everywhere. No force.");
    Positions positions;
    const auto begin = CheckTalk::Clock::now();
    const auto limit = begin + desk.options.times.moving;
    bool answered = false;
    while (!(answered = desk.answered()) && CheckTalk::Clock::now() < limit) {
        const auto heard = desk.talk.exchange(std::nullopt, desk.likely_dialect());
        if (heard.arm.position_m) positions.add(*heard.arm.position_m * kMetre_mm);
    }
    const std::chrono::duration<double> took = CheckTalk::Clock::now() - begin;
    if (!answered) {
        desk.guide.say("It went on by itself, after " + number_text(took.count(), 0) +
                       " s without an Enter.");
    }
    if (positions.count == 0) throw DeviceError("no position came that makes sense");
    const double changes_per_s = positions.changes / took.count();
    const Vec3 size_mm = positions.highest_mm - positions.lowest_mm;
    measured = {{"positions", positions.count},
                {"ended_by_enter", answered},
                {"new_positions_per_s", changes_per_s},
                {"smallest_step_mm", positions.smallest_step_mm},
                {"lowest_mm", as_json(positions.lowest_mm)},
                {"highest_mm", as_json(positions.highest_mm)}};
    desk.settle(OpenQuestion::device_rate, number_text(changes_per_s, 0) + " while it moved");
    desk.settle(OpenQuestion::step, number_text(positions.smallest_step_mm, 4) + " mm");
    desk.settle(OpenQuestion::workspace, number_text(size_mm.x, 0) + " x " +
                                             number_text(size_mm.y, 0) + " x " +
                                             number_text(size_mm.z, 0) + " mm were reached");
}

void check_unplugged(CheckDesk& desk, Json& measured) {
    desk.guide.ask(
        "Keep the grip moving. Pull the USB cable out, count to five, plug it in again, and wait "
        "until the light is as before; then Enter");
    Absence absence;
    const auto begin = CheckTalk::Clock::now();
    try {
        while (!desk.answered() &&
               CheckTalk::Clock::now() < begin + desk.options.times.unplugging) {
            absence.add(desk.talk.look(desk.likely_dialect()), CheckTalk::Clock::now());
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    } catch (const DeviceError& failure) {  // which is a finding, too
        absence.ended_by = failure.what();
    }
    measured = {
        {"gone_s", absence.gone.count()},       {"frozen_s", absence.frozen.count()},
        {"told_no_power", absence.not_powered}, {"told_not_calibrated", absence.not_calibrated},
        {"told_not_ready", absence.not_ready},  {"is_back", absence.is_back},
        {"ended_by", absence.ended_by},         {"at_the_end", names_in(desk.talk.message())}};
    desk.settle(
        OpenQuestion::unplugged,
        absence.in_words(desk.options.times.frozen) +
            (absence.is_back ? "" : "; not back, there is " + names_in(desk.talk.message())));
}

}  // namespace dibhr::inverse3
