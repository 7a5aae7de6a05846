// What the window says, written down by a stand-in of speech-dispatcher's library.
#include "app/viewer/guide/speaking.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "app/sound/speaker.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/speech_bench.hpp"
#include "tests/app/viewer/two_halves.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kLibrary = std::string(STAND_IN_SPEECH) + "/libspeechd.so.2";

bool has_call(const fs::path& file, const std::string& call) {
    const auto calls = calls_in(file);
    return std::ranges::find(calls, call) != calls.end();
}

}  // namespace

TEST_CASE("of several news the weightiest is said and what ended is none", "[speech]") {
    const Spoken before{.region = "Cup", .caption = "A cup"};
    CHECK(news_of(before, before).empty());
    CHECK(news_of({}, before).empty());
    CHECK(news_of({.region = "Table", .caption = "A table"}, before) == "Table");
    CHECK(news_of({.region = "Cup", .text = "Blue.", .caption = "A table"}, before) == "Blue.");
    CHECK(news_of({.message = "No", .notice = "Saved", .focus = "Play", .region = "Table"},
                  before) == "No");
    CHECK(news_of({.focus = "Play", .help = "Plays"}, {.focus = "Play"}) == "Plays");
    CHECK(news_of({.notice = "Saved", .focus = "Play", .region = "Table"}, before) == "Saved");
}

TEST_CASE("a newer text breaks off the one before and the same text can be said again",
          "[speech]") {
    const TemporaryFolder folder;
    const fs::path spoken = folder / "spoken";
    const EnvironmentVariable name("DIBHR_SPOKEN", spoken.c_str());
    {
        Speaker speaker(kLibrary);
        speaker.say("one");
        CHECK(eventually([&] { return has_call(spoken, "say one"); }));
        speaker.say("two");
        CHECK(eventually([&] { return has_call(spoken, "say two"); }));
        speaker.say("two");
        CHECK(eventually([&] {
            const auto calls = calls_in(spoken);
            return std::ranges::count(calls, "say two") == 2;
        }));
        CHECK_FALSE(speaker.take_trouble());
    }
    const auto calls = calls_in(spoken);
    for (std::size_t k = 0; k < calls.size(); ++k)
        if (calls[k].starts_with("say")) CHECK(calls.at(k - 1) == "cancel ");
    CHECK(calls.back() == "close ");
}

TEST_CASE("a missing library is told once in one line with the package's name", "[speech]") {
    Speaker speaker("libspeechd-that-is-nowhere.so.2");
    speaker.say("one");
    std::optional<std::string> trouble;
    CHECK(eventually([&] { return (trouble = speaker.take_trouble()).has_value(); }));
    CHECK_THAT(*trouble, Contains("libspeechd2") && !Contains("\n"));
    speaker.say("two");
    CHECK_FALSE(speaker.take_trouble());
}

TEST_CASE("what is touched is spoken by its name and then its text and another place at once",
          "[speech]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    const fs::path spoken = folder / "spoken";
    WindowProgram viewer =
        desk.start_viewer(folder, cup_options({"--speak"}), with_stand_in(folder));
    viewer.wait_for_surface();
    viewer.act(std::string(kLeft) + " mousedown 1");
    CHECK(eventually([&] { return has_call(spoken, "say Cup"); }));
    CHECK(eventually([&] { return has_call(spoken, "say A blue cup."); }));
    viewer.act(kRight);
    CHECK(eventually([&] { return has_call(spoken, "say Table"); }));
    viewer.act("mouseup 1");
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("captions and notices and messages are spoken and nothing is without --speak",
          "[speech]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    write_text(folder / "cup.vtt", "WEBVTT\n\n00:00.000 --> 00:05.000\nA cup on a table\n");
    const fs::path spoken = folder / "spoken";
    {
        WindowProgram viewer = desk.start_viewer(folder, cup_options(), with_stand_in(folder));
        viewer.wait_for_surface();
        viewer.wait_until([](const Seen& now) { return !now.caption.str().empty(); });
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
        CHECK_FALSE(fs::exists(spoken));
    }
    WindowProgram viewer =
        desk.start_viewer(folder, cup_options({"--speak"}), with_stand_in(folder));
    viewer.wait_for_surface();
    CHECK(eventually([&] { return has_call(spoken, "say A cup on a table"); }));
    viewer.act("key m");
    CHECK(eventually([&] { return has_call(spoken, "say " + viewer.seen().notice.str()); }));
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE(
    "the tooltip of what has the keyboard is said after its name once the keyboard rests there",
    "[speech]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    const fs::path spoken = folder / "spoken";
    WindowProgram viewer =
        desk.start_viewer(folder, cup_options({"--speak"}), with_stand_in(folder));
    viewer.wait_for_surface();
    viewer.act("key F6 key F6");
    for (int k = 0; k < 250 && viewer.seen().focus.str() != "Speak"; ++k) {
        viewer.act("key Tab");
        viewer.wait_for_turn();
        viewer.wait_for_turn();
    }
    REQUIRE(viewer.seen().focus.str() == "Speak");
    const auto of_tooltip = [&](const std::vector<std::string>& calls) {
        return std::ranges::find_if(
            calls, [](const auto& call) { return call.starts_with("say What is touched, "); });
    };
    REQUIRE(eventually([&] {
        const auto calls = calls_in(spoken);
        return of_tooltip(calls) != calls.end();
    }));
    const auto calls = calls_in(spoken);
    const auto said = of_tooltip(calls);
    CHECK(*(said - 1) == "say Speak, check box, on");  // which is not broken off
    desk.press("key Escape key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("a daemon that does not answer is told and one that hangs holds nothing up", "[speech]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    const std::string variable = GENERATE("DIBHR_NO_SPEECH=1", "DIBHR_SPEECH_HANGS=1");
    WindowProgram viewer =
        desk.start_viewer(folder, cup_options({"--speak"}), with_stand_in(folder, {variable}));
    viewer.wait_for_surface();
    viewer.act(std::string(kLeft) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.region.str() == "Cup"; });
    if (variable.starts_with("DIBHR_NO"))
        viewer.wait_until(
            [](const Seen& now) { return contains(now.notice.str(), "speech-dispatcher"); });
    viewer.act(std::string(kRight));
    viewer.wait_until([](const Seen& now) { return now.region.str() == "Table"; });
    viewer.act("mouseup 1");
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}
