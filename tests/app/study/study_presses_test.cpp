// What device buttons do at an adjustment, and how a long press is told from a short one.
#include <chrono>
#include <optional>

#include "app/study/study_pages.hpp"
#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;

namespace {

constexpr bool kDown = true;
constexpr LongPress::Clock::time_point kBegin{5s};

LongPress begun() {
    LongPress press;
    press.begin(kBegin);
    return press;
}

/// A run in the interval of a trial that is answered yes or no.
StudyRun at_interval() {
    return StudyRun(protocol(page_of_conditions(1, R"([[block]]
form = "explore"
question = "Q"
)")),
                    1);
}

/// A run at the second interval of an adjustment, whose parameter can be changed.
StudyRun at_adjustment() {
    StudyRun run(protocol(page_of_conditions(1, R"([[block]]
form = "adjust"
vary = "friction"
reference = 0.3
question = "Q"
[block.adjust]
lowest = 0
highest = 0.6
)")),
                 1);
    while (run.step() != StudyStep::adjust) run.go_on();
    return run;
}

}  // namespace

TEST_CASE("a press that is let go of within a second is short, and is told once", "[study]") {
    LongPress press = begun();
    CHECK_FALSE(press.ended(kBegin, kDown));
    CHECK_FALSE(press.ended(kBegin + 999ms, kDown));
    CHECK_FALSE(press.ended(kBegin + 999ms, !kDown).value().held);
    CHECK_FALSE(press.ended(kBegin + 2s, !kDown));
}

TEST_CASE("a press that is held for a second is long, and is told then and once", "[study]") {
    LongPress press = begun();
    CHECK(press.ended(kBegin + 1500ms, kDown).value().at == kBegin + 1s);
    CHECK_FALSE(press.ended(kBegin + 2s, kDown));
    CHECK_FALSE(press.ended(kBegin + 2s, !kDown));
    press.begin(kBegin + 3s);
    CHECK_FALSE(press.ended(kBegin + 3s, !kDown).value().held);
}

TEST_CASE("a press that is forgotten is none", "[study]") {
    LongPress press = begun();
    press.forget();
    CHECK_FALSE(press.ended(kBegin + 1s, !kDown));
}

TEST_CASE("at an adjustment the grip turns, feels the other one, and says equal by a long press",
          "[study]") {
    const StudyRun run = at_adjustment();
    const StudyShown view;
    const auto said = [&](int button, bool held = false) {
        return press_of_button(run, view, {.number = button, .held = held}).value();
    };
    CHECK(said(0).kind == StudyPress::Kind::turn);
    CHECK(said(0).value < 0.0);
    CHECK(said(1).kind == StudyPress::Kind::turn);
    CHECK(said(1).value > 0.0);
    CHECK(said(kLongPressButton).kind == StudyPress::Kind::feel);
    CHECK(said(kLongPressButton).which == 1 - run.interval());
    CHECK(said(kLongPressButton, true).kind == StudyPress::Kind::go_on);
}

TEST_CASE("of two intervals the keys 1 and 2 and the arrows choose one, and no other key answers",
          "[study]") {
    StudyRun run(protocol(page_of_conditions(2, R"([[block]]
form = "two-interval"
question = "Q"
pairs = [["a", "b"]]
answer-s = 5
)")),
                 1);
    while (run.step() != StudyStep::question) run.go_on();
    const StudyShown view;
    const auto chosen = [&](const char* key) -> std::optional<int> {
        const auto press = press_of_key(run, view, {.name = key});
        if (!press || press->kind != StudyPress::Kind::choose) return std::nullopt;
        return press->which;
    };
    CHECK(chosen("1") == 0);
    CHECK(chosen("2") == 1);
    CHECK(chosen("Left") == 0);
    CHECK(chosen("Right") == 1);
    for (const char* key : {"0", "3", "9", "a", "Enter", " "}) CHECK(chosen(key) == std::nullopt);
}

TEST_CASE(
    "an answer that is pressed before its question is on the screen is early, and answers nothing",
    "[study]") {
    using Kind = StudyPress::Kind;
    StudyRun run = at_interval();
    StudyShown view;
    const auto kind_of = [&](const char* key, bool early) {
        return press_of_key(run, view, {.name = key, .early = early}).value().kind;
    };
    const auto kind_of_button = [&](int button, bool early) {
        return press_of_button(run, view, {.number = button, .early = early}).value().kind;
    };
    CHECK(kind_of("1", false) == Kind::early);
    CHECK(kind_of_button(1, false) == Kind::early);
    CHECK(kind_of("Enter", false) == Kind::go_on);
    CHECK_FALSE(press_of_key(run, view, {.name = "Enter", .early = true}));
    CHECK_FALSE(press_of_button(run, view, {.number = 0, .early = true}));
    run.go_on();
    CHECK(kind_of("1", true) == Kind::early);
    CHECK(kind_of_button(0, true) == Kind::early);
    CHECK(kind_of("1", false) == Kind::choose);
    CHECK(kind_of_button(0, false) == Kind::choose);
    view.waits = true;
    CHECK(kind_of("Right", false) == Kind::early);
    view.before_start = true;  // no question is shown
    CHECK_FALSE(press_of_key(run, view, {.name = "1", .early = true}));
}
