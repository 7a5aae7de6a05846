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
        for (const auto& [name, value] : arm.kept) measured["kept"][arm.id][name] = value;
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
    desk.guide.ask("Move the grip slowly, then to every end; Enter when you have been everywhere");
    Positions positions;
    const auto begin = CheckTalk::Clock::now();
    while (!desk.answered() && CheckTalk::Clock::now() < begin + desk.options.times.moving) {
        const auto heard = desk.talk.exchange(std::nullopt, desk.likely_dialect());
        if (heard.arm.position_m) positions.add(*heard.arm.position_m * kMetre_mm);
    }
    const std::chrono::duration<double> took = CheckTalk::Clock::now() - begin;
    if (positions.count == 0) throw DeviceError("no position came that makes sense");
    const double changes_per_s = positions.changes / took.count();
    const Vec3 size_mm = positions.highest_mm - positions.lowest_mm;
    measured = {{"positions", positions.count},
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

}  // namespace dibhr::inverse3
