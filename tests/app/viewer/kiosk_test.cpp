// A window for visitors: what they can do, what they cannot, and what it does when they have gone.
#include <algorithm>
#include <filesystem>
#include <string>

#include "app/settings/settings.hpp"
#include "app/viewer/viewer.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/speech_bench.hpp"
#include "tests/app/viewer/two_halves.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kRegionsOfCup = 2;
constexpr std::size_t kRegionsOfPot = 1;

/// A kiosk of the recordings after the first one, which is `first`.
std::vector<std::string> kiosk_options(const char* first, std::initializer_list<const char*> more) {
    std::vector<std::string> options{first,   "--raw-depth", "--device",
                                     "mouse", "--no-sync",   "--kiosk"};
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

/// A cup of two regions, and a pot of one: which of them is shown is told by their number.
void write_both(const TemporaryFolder& folder) {
    write_cup(folder);
    write_depth_png(folder / "pot_depth.png", kWide, kHigh, 90);
    write_text(folder / "pot_regions.toml", "[[region]]\nlevel = 1\nname = \"Pot\"\n");
    write_halves(folder / "pot_regions.png");
}

bool shows(const Seen& now, std::size_t regions) {
    return now.surface && !now.opening && now.regions == regions;
}

bool shows_cup(const Seen& now) {
    return shows(now, kRegionsOfCup);
}

bool shows_pot(const Seen& now) {
    return shows(now, kRegionsOfPot);
}

void leave(const Desk& desk, WindowProgram& viewer) {
    desk.press("key ctrl+shift+q");
    REQUIRE(viewer.wait() == 0);
}

/// The button in the middle of the lower edge.
constexpr const char* kMiddleButton = "mousemove 640 745 click 1";
constexpr const char* kLeftButton = "mousemove 500 745 click 1";
constexpr const char* kRightButton = "mousemove 780 745 click 1";

}  // namespace

TEST_CASE("a kiosk fills the screen without panels and no key but its chord leaves it", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer =
        desk.start_viewer(folder, kiosk_options("cup_depth.png", {"--next", "pot_depth.png"}));
    viewer.wait_for_surface();
    for (const char* keys : {"key Escape", "key q", "key ctrl+q", "key Tab", "key question",
                             "key F11", "key ctrl+o", "key g", "key ctrl+r"})
        viewer.act(keys);
    const Seen now = viewer.seen();
    CHECK_FALSE(now.panels);
    CHECK_FALSE(now.help);
    CHECK_FALSE(now.dialog);
    CHECK_FALSE(now.brush);
    CHECK_FALSE(now.records);
    CHECK(now.columns == 1280);
    CHECK(now.rows == 800);
    viewer.act("key F8");
    viewer.wait_until([](const Seen& then) { return !then.force_enabled; });
    viewer.act("key f");
    viewer.wait_until([](const Seen& then) { return then.force_enabled; });
    leave(desk, viewer);
}

TEST_CASE("a kiosk goes on by button or key and after its last recording to the first", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer =
        desk.start_viewer(folder, kiosk_options("cup_depth.png", {"--next", "pot_depth.png"}));
    viewer.wait_for_surface();
    CHECK(shows_cup(viewer.seen()));
    viewer.act(kMiddleButton);
    viewer.wait_until(shows_pot);
    CHECK_FALSE(viewer.seen().contact);  // the button is not the relief
    viewer.act(kMiddleButton);
    viewer.wait_until(shows_cup);
    viewer.act("key Return");
    viewer.wait_until(shows_pot);
    leave(desk, viewer);
}

TEST_CASE("a kiosk that nobody touches returns to its first recording as it was first seen",
          "[kiosk]") {
    constexpr const char* kPlace = "mousemove 500 300";
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer = desk.start_viewer(
        folder, kiosk_options("cup_depth.png", {"--next", "pot_depth.png", "--return-after", "3"}));
    viewer.wait_for_surface();
    viewer.act(kPlace);
    const auto is_first_view = [first = viewer.seen()](const Seen& now) {
        return now.pointed_column == first.pointed_column && now.pointed_row == first.pointed_row;
    };
    viewer.act("mousedown 3 mousemove 700 400 mouseup 3");
    viewer.act(kPlace);
    viewer.wait_until([&](const Seen& now) { return !is_first_view(now); });
    viewer.wait_until(is_first_view);  // nobody touches
    viewer.act("click 5 click 5");     // the wheel
    viewer.wait_until([&](const Seen& now) { return !is_first_view(now); });
    viewer.wait_until(is_first_view);
    viewer.act("key Return");
    viewer.wait_until(shows_pot);
    viewer.wait_until(shows_cup);
    leave(desk, viewer);
}

TEST_CASE("the whole relief of a kiosk is above its buttons, however high it is", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    write_depth_png(folder / "tall_depth.png", 300, 600, 120);
    WindowProgram viewer =
        desk.start_viewer(folder, kiosk_options("tall_depth.png", {"--next", "pot_depth.png"}));
    viewer.wait_for_surface();
    viewer.act("mousemove 600 560");
    viewer.wait_until([](const Seen& now) { return now.pointed_column >= 0.0F; });
    viewer.act("mousemove 600 670");  // a little above the button
    viewer.wait_until([](const Seen& now) { return now.pointed_column < 0.0F; });
    leave(desk, viewer);
}

TEST_CASE("a kiosk is not taken back while it is touched", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer = desk.start_viewer(
        folder, kiosk_options("cup_depth.png", {"--next", "pot_depth.png", "--return-after", "2"}));
    viewer.wait_for_surface();
    viewer.act("key Return");
    viewer.wait_until(shows_pot);
    viewer.act("mousemove 500 300 mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    const std::uint64_t ticks = viewer.seen().ticks;
    constexpr std::uint64_t kLonger = 3000;  // than until the return
    viewer.wait_until([&](const Seen& now) { return now.ticks > ticks + kLonger; });
    CHECK(shows_pot(viewer.seen()));
    viewer.act("mouseup 1");
    viewer.wait_until(shows_cup);
    leave(desk, viewer);
}

TEST_CASE("a kiosk passes over what cannot be opened and tells it in one line each", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    write_text(folder / "broken_depth.png", "no picture");
    fs::create_directory(folder / "empty");
    const bool first = GENERATE(true, false);
    WindowProgram viewer = desk.start_viewer(
        folder, first ? kiosk_options("broken_depth.png",
                                      {"--next", "missing.mp4", "--next", "pot_depth.png"})
                      : kiosk_options("cup_depth.png", {"--next", "broken_depth.png", "--next",
                                                        "empty", "--next", "pot_depth.png"}));
    viewer.wait_for_surface();
    if (!first) viewer.act("key Return");
    viewer.wait_until(shows_pot);
    const Seen now = viewer.seen();
    CHECK(now.message.str().empty());
    CHECK_FALSE(now.dialog);
    CHECK_FALSE(now.depth_offered);
    leave(desk, viewer);
    const auto lines = split(read_text(folder / "errors.txt"), '\n');
    const auto told = [&lines](const char* file) {
        return std::ranges::count_if(lines, [file](const std::string& line) {
            return line.starts_with("dibhr: ") && contains(line, file);
        });
    };
    CHECK(told("broken_depth.png") == 1);
    CHECK(told("missing.mp4") == (first ? 1 : 0));
    CHECK(told("'empty'") == (first ? 0 : 1));
}

TEST_CASE("a kiosk of which nothing can be opened ends with a sentence", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer =
        desk.start_viewer(folder, kiosk_options("missing.mp4", {"--next", "also_missing.mp4"}));
    CHECK(viewer.wait() == 1);
    CHECK_THAT(read_text(folder / "errors.txt"),
               Contains("missing.mp4") && Contains("also_missing.mp4") && Contains("none of the"));
}

TEST_CASE("a kiosk sends 40 percent of the force limit and keeps none of its settings", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    const double most_newton = 0.4 * Settings{}.max_force_newton;
    WindowProgram viewer =
        desk.start_viewer(folder, kiosk_options("cup_depth.png", {"--record", "visit.dibhr"}));
    viewer.wait_for_surface();
    viewer.act("mousemove 500 300 mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    for (int k = 0; k < 30; ++k) viewer.act("click 4");
    viewer.wait_until([most_newton](const Seen& now) {
        return now.spring_newton > most_newton && now.sent_newton > 0.99 * most_newton;
    });
    viewer.act("mouseup 1");
    leave(desk, viewer);
    const auto rows = read_session(folder / "visit.dibhr");
    const auto sent = [](const Row& row) { return glm::length(row.sent_newton); };
    REQUIRE_FALSE(rows.empty());
    const double strongest = sent(*std::ranges::max_element(rows, {}, sent));
    CHECK(strongest == Approx(most_newton).epsilon(1e-6));
    CHECK(strongest <= most_newton + 1e-9);
    WindowProgram usual = desk.start_viewer(folder, cup_options());
    usual.wait_for_surface();
    CHECK(usual.seen().panels);
    desk.press("key q");
    REQUIRE(usual.wait() == 0);
}

TEST_CASE("a kiosk says the last text again by button or key", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer = desk.start_viewer(
        folder, kiosk_options("cup_depth.png", {"--next", "pot_depth.png", "--speak"}),
        with_stand_in(folder));
    viewer.wait_for_surface();
    viewer.act("mousemove 500 300 mousedown 1");
    const auto times_said = [&folder](const char* text) {
        return std::ranges::count(calls_in(folder / "spoken"), std::string("say ") + text);
    };
    CHECK(eventually([&] { return times_said("A blue cup.") == 1; }));
    viewer.act("mouseup 1");
    viewer.act(kLeftButton);
    CHECK(eventually([&] { return times_said("A blue cup.") == 2; }));
    viewer.act("key space");
    CHECK(eventually([&] { return times_said("A blue cup.") == 3; }));
    viewer.act(kRightButton);
    viewer.wait_until(shows_pot);
    leave(desk, viewer);
}
