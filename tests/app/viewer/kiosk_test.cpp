// A window for visitors: what they can do, what they cannot, and what it does when they have gone.
#include <string>

#include "app/settings/settings.hpp"
#include "app/viewer/viewer.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/two_halves.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// Two recordings in a kiosk.
std::vector<std::string> kiosk_options(std::initializer_list<const char*> more = {}) {
    std::vector<std::string> options{"cup_depth.png", "--raw-depth", "--device", "mouse",
                                     "--no-sync",     "--kiosk",     "--next",   "pot_depth.png"};
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

void write_both(const TemporaryFolder& folder) {
    write_cup(folder);
    write_depth_png(folder / "pot_depth.png", kWide, kHigh, 90);
}

bool shows(const Seen& now, const char* name) {
    return now.surface && !now.opening && contains(now.file.str(), name);
}

/// The button in the middle of the lower edge.
constexpr const char* kNext = "mousemove 640 755 click 1";

}  // namespace

TEST_CASE("a kiosk fills the screen without panels and no key but its chord leaves it", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer = desk.start_viewer(folder, kiosk_options());
    viewer.wait_for_surface();
    CHECK(viewer.seen().columns == 1280);
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
    viewer.act("key F8");
    viewer.wait_until([](const Seen& then) { return !then.force_enabled; });
    desk.press("key ctrl+shift+q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("a kiosk goes on to the next recording by button or key and back to the first alone",
          "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    WindowProgram viewer = desk.start_viewer(folder, kiosk_options({"--return-after", "3"}));
    viewer.wait_for_surface();
    viewer.act(kNext);
    viewer.wait_until([](const Seen& now) { return shows(now, "pot"); });
    viewer.wait_until([](const Seen& now) { return shows(now, "cup"); });  // nobody touches
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return shows(now, "pot"); });
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return shows(now, "cup"); });  // after the last
    desk.press("key ctrl+shift+q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("a kiosk sends a share of the force limit and keeps none of its settings", "[kiosk]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_both(folder);
    const double most_newton = KioskOptions::kForceShare * Settings{}.max_force_newton;
    WindowProgram viewer = desk.start_viewer(folder, kiosk_options());
    viewer.wait_for_surface();
    viewer.act("mousemove 400 400 mousedown 1");
    for (int k = 0; k < 20; ++k) viewer.act("click 4");
    viewer.wait_until(
        [most_newton](const Seen& now) { return now.contact && now.spring_newton > most_newton; });
    viewer.wait_until(
        [most_newton](const Seen& now) { return now.sent_newton > 0.99 * most_newton; });
    CHECK(viewer.seen().sent_newton <= most_newton * (1.0 + 1e-9));
    viewer.act("mouseup 1");
    desk.press("key ctrl+shift+q");
    REQUIRE(viewer.wait() == 0);
    WindowProgram usual = desk.start_viewer(folder, cup_options());
    usual.wait_for_surface();
    CHECK(usual.seen().panels);
    desk.press("key q");
    REQUIRE(usual.wait() == 0);
}
