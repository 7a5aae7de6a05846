// What the grip's buttons say at an adjustment, and how a long press of one is told from a short
// one.
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

/// At what is turned, of an adjustment.
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
    CHECK(press.ended(kBegin, kDown) == std::nullopt);
    CHECK(press.ended(kBegin + 999ms, kDown) == std::nullopt);
    CHECK(press.ended(kBegin + 999ms, !kDown) == false);
    CHECK(press.ended(kBegin + 2s, !kDown) == std::nullopt);
}

TEST_CASE("a press that is held for a second is long, and is told then and once", "[study]") {
    LongPress press = begun();
    CHECK(press.ended(kBegin + 1s, kDown) == true);
    CHECK(press.ended(kBegin + 2s, kDown) == std::nullopt);
    CHECK(press.ended(kBegin + 2s, !kDown) == std::nullopt);
    press.begin(kBegin + 3s);
    CHECK(press.ended(kBegin + 3s, !kDown) == false);
}

TEST_CASE("a press that is forgotten is none", "[study]") {
    LongPress press = begun();
    press.forget();
    CHECK(press.ended(kBegin + 1s, !kDown) == std::nullopt);
}

TEST_CASE("at an adjustment the grip turns, feels the other one, and says equal by a long press",
          "[study]") {
    const StudyRun run = at_adjustment();
    const StudyShown view;
    const auto said = [&](int button, bool held = false) {
        return press_of_button(run, view, button, held).value();
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
        const auto press = press_of_key(run, view, key, false);
        if (!press || press->kind != StudyPress::Kind::choose) return std::nullopt;
        return press->which;
    };
    CHECK(chosen("1") == 0);
    CHECK(chosen("2") == 1);
    CHECK(chosen("Left") == 0);
    CHECK(chosen("Right") == 1);
    for (const char* key : {"0", "3", "9", "a", "Enter", " "}) CHECK(chosen(key) == std::nullopt);
}
