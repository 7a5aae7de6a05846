// What hands did in the intervals of a trial, from its session.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/session/session.hpp"
#include "core/study_report/study_fields.hpp"
#include "core/study_report/study_motion.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_sentences.hpp"
#include "tests/core/report/made_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

struct Mark {
    double t_s{0.0};
    std::string tag{};
};

/// Two seconds of a hand that presses all the time, whatever the marks say.
std::vector<IntervalMotion> measured(const std::vector<Mark>& marks, std::size_t intervals) {
    const TemporaryFolder folder;
    const auto file = folder / "trial.dibhr";
    record(file, {.ticks = ticks_touching(2000, 0, 2000), .also = [&marks](Recorder& recorder) {
                      for (const Mark& mark : marks) recorder.mark_at(mark.t_s, mark.tag);
                  }});
    return motion_in(Session(file), intervals);
}

}  // namespace

TEST_CASE("an interval ends at its rest: waits and the question are no part of it",
          "[study motion]") {
    const auto motion =
        measured({{0.1, "interval 1"}, {0.4, "rest"}, {0.9, "interval 2"}, {1.1, "rest"}}, 2);
    CHECK_THAT(motion.at(0).duration_s, WithinAbs(0.3, 1e-9));
    CHECK(motion.at(0).updates == 300);
    CHECK_THAT(motion.at(0).contact_s, WithinAbs(0.3, 1e-9));
    CHECK_THAT(motion.at(0).sent_newton, WithinAbs(0.5, 1e-9));
    CHECK_THAT(motion.at(1).duration_s, WithinAbs(0.2, 1e-9));
}

TEST_CASE("an interval that is felt again counts on, and any mark ends it", "[study motion]") {
    const auto motion = measured({{0.1, "interval 1"},
                                  {0.2, "rest"},
                                  {0.5, "interval 2"},
                                  {0.8, "rest"},
                                  {1.2, "interval 1"},
                                  {1.6, "a note"}},
                                 2);
    CHECK(motion.at(0).updates == 500);
    CHECK(motion.at(1).updates == 300);
}

TEST_CASE("intervals without a rest between them, as the modelled hand has them, end at the next",
          "[study motion]") {
    const auto motion = measured({{0.0, "interval 1"}, {0.75, "interval 2"}}, 2);
    CHECK(motion.at(0).updates == 750);
    CHECK(motion.at(1).updates == 1250);
    // Of a trial with fewer intervals a mark beyond them is none of its own.
    CHECK(measured({{0.0, "interval 1"}, {0.75, "interval 2"}}, 1).at(0).updates == 750);
}

TEST_CASE(
    "of two intervals together times and counts add up, and means weigh by the time in contact",
    "[study motion]") {
    const IntervalMotion a{.updates = 10,
                           .contact_updates = 4,
                           .moves = 7,
                           .duration_s = 2.0,
                           .contact_s = 1.0,
                           .sent_newton = 0.5,
                           .sent_peak_newton = 3.0,
                           .spring_newton = 1.5,
                           .spring_peak_newton = 5.0,
                           .path_mm = 11.0};
    const IntervalMotion b{.updates = 20,
                           .contact_updates = 15,
                           .moves = 13,
                           .duration_s = 4.0,
                           .contact_s = 3.0,
                           .sent_newton = 0.9,
                           .sent_peak_newton = 2.0,
                           .spring_newton = 2.5,
                           .spring_peak_newton = 6.0,
                           .path_mm = 17.0};
    const bool swapped = GENERATE(false, true);
    const IntervalMotion all = swapped ? joined(b, a) : joined(a, b);
    CHECK(all.updates == 30);
    CHECK(all.contact_updates == 19);
    CHECK(all.moves == 20);
    CHECK_THAT(all.duration_s, WithinAbs(6.0, 1e-12));
    CHECK_THAT(all.contact_s, WithinAbs(4.0, 1e-12));
    CHECK_THAT(all.sent_newton, WithinAbs(0.8, 1e-12));
    CHECK_THAT(all.sent_peak_newton, WithinAbs(3.0, 0.0));
    CHECK_THAT(all.spring_newton, WithinAbs(2.25, 1e-12));
    CHECK_THAT(all.spring_peak_newton, WithinAbs(6.0, 0.0));
    CHECK_THAT(all.path_mm, WithinAbs(28.0, 1e-12));
}

TEST_CASE("what was done and felt is in the CSV and in the JSON, each number at its place",
          "[study motion]") {
    const IntervalMotion motion{.updates = 10,
                                .contact_updates = 4,
                                .moves = 7,
                                .duration_s = 2.0,
                                .contact_s = 1.0,
                                .sent_newton = 0.5,
                                .sent_peak_newton = 3.0,
                                .spring_newton = 1.5,
                                .spring_peak_newton = 5.0,
                                .path_mm = 11.0,
                                .turning = {.mean_deg = 0.25, .sd_deg = 0.75, .pairs = 9}};
    Study study;
    study.participants.push_back({.identity = {.participant = "P1"}});
    const std::string head =
        "participant,trial,interval,condition,practice,duration_s,contact_s,updates,"
        "contact_updates,moves,sent_newton,sent_peak_newton,spring_newton,spring_peak_newton,"
        "path_mm,speed_mm_per_s,turning_mean_deg,turning_sd_deg,turning_pairs,value\n";
    CHECK(intervals_csv(study, {}) == head);
    CHECK(intervals_csv(study, {{.trial = 2, .interval = 1, .condition = "a", .motion = motion}}) ==
          head + "P1,3,2,a,0,2,1,10,4,7,0.5,3,1.5,5,11,11,0.25,0.75,9,\n");
    const std::string json = json_line(
        fields_of(MotionFinding{.condition = "a", .all = motion, .intervals = 1}, true).json);
    CHECK(json.starts_with(
        R"({"condition":"a","intervals":1,"duration_s":2.0,"contact_s":1.0,"updates":10,)"
        R"("contact_updates":4,"moves_per_update":0.7,)"
        R"("force_sent_newton":{"mean":0.5,"peak":3.0},)"
        R"("force_spring_newton":{"mean":1.5,"peak":5.0},"path_mm":11.0,"speed_mm_per_s":11.0,)"
        R"("variation_deg":{"mean":0.25,"sd":0.75,"pairs":9},"participants_mean":{)"));
}

namespace {

IntervalRow row_of(std::size_t participant, const std::string& condition,
                   const IntervalMotion& motion) {
    return {.participant = participant,
            .condition = condition,
            .device = "Novint Falcon",
            .motion = motion};
}

const IntervalMotion kTouched{.updates = 10,
                              .contact_updates = 5,
                              .hand = {.all = 10},
                              .duration_s = 2.0,
                              .contact_s = 1.0,
                              .sent_newton = 0.5,
                              .path_mm = 3.0,
                              .turning = {.mean_deg = 0.25, .pairs = 4}};
const IntervalMotion kUntouched{.updates = 10, .hand = {.all = 10}, .duration_s = 2.0};

}  // namespace

TEST_CASE("conditions come in the order of the protocol, however they are called",
          "[study motion]") {
    Protocol page;
    for (const char* const name : {"low", "low, soft", "high"})
        page.conditions.push_back({.name = name});
    std::vector<IntervalRow> rows;
    for (const char* const name :
         {"high", "low, soft, friction above 0.3", "low, friction 0.3", "low, soft"})
        rows.push_back(row_of(0, name, kTouched));
    std::vector<std::string> names;
    for (const MotionFinding& found : motion_findings(page, rows)) names.push_back(found.condition);
    CHECK(names == std::vector<std::string>{"low, friction 0.3", "low, soft",
                                            "low, soft, friction above 0.3", "high"});
}

TEST_CASE("what was not touched has no force instead of a force of zero", "[study motion]") {
    const std::vector<MotionFinding> found =
        motion_findings({}, {row_of(0, "a", kTouched), row_of(1, "a", kUntouched),
                             row_of(0, "b", kUntouched), row_of(1, "b", kUntouched)});
    REQUIRE(found.size() == 2);
    CHECK(found[0].sent_newton.value == 0.5);  // of the one who touched it
    CHECK(found[0].sent_newton.count == 1);
    CHECK(found[0].contact_share.value == 0.25);  // of both
    for (const Estimate& none :
         {found[1].sent_newton, found[1].speed_mm_per_s, found[1].turning_deg}) {
        CHECK_FALSE(std::isfinite(none.value));
        CHECK(none.count == 0);
    }
    const Fields row = fields_of(found[1], true);
    CHECK(std::count(row.cells.begin(), row.cells.end(), "not touched") == 1);
    CHECK(std::count(row.cells.begin(), row.cells.end(), kNoCell) == 5);
    CHECK(row.json["participants_mean"]["force_sent_newton"]["count"] == 0);
}

TEST_CASE("a participant's devices are named, and the mouse where nothing else was there",
          "[study motion]") {
    IntervalMotion by_mouse = kTouched;
    by_mouse.hand.mouse_fallback = by_mouse.hand.all;
    const std::vector<ParticipantHand> hands =
        hands_in({row_of(0, "a", kTouched), row_of(1, "a", by_mouse), row_of(2, "a", kTouched),
                  row_of(2, "b", by_mouse)},
                 4);
    CHECK_FALSE(hands[0].used_mouse());
    CHECK(devices_text(hands[0]) == "Novint Falcon");
    CHECK(hands[1].used_only_mouse());
    CHECK(devices_text(hands[1]) == "mouse");
    CHECK(hands[2].used_mouse());
    CHECK_FALSE(hands[2].used_only_mouse());
    CHECK(devices_text(hands[2]) == "Novint Falcon, mouse");
    CHECK(devices_text(hands[3]).empty());
    CHECK_FALSE(hands[3].used_only_mouse());
}
