// The real window under a synthetic pointer: what is recorded is what a hand on the mouse must
// feel.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/media.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kRelief_px = 100.0;
constexpr double kPitch_mm = 101.6 / 720.0;
constexpr double kStiffness_newton_per_mm = 0.5;

/// The depth film shows a plane that rises to the right: level 10 in column 0, one more in each
/// column.
double elevation(Vec3 p) {
    return kRelief_px * (p.x + 10.0) / 255.0;
}

Vec3 plane_normal() {
    return glm::normalize(Vec3{-kRelief_px / 255.0, 0.0, 1.0});
}

/// Two seconds of film, 240 x 180, without loss.
void make_films(const TemporaryFolder& folder) {
    const std::string quiet = "ffmpeg -nostdin -v error -y -f lavfi -i ";
    run_shell(quiet + "testsrc2=s=240x180:r=30:d=2 -c:v ffv1 '" +
              (folder / "plane_color.mkv").string() + "'");
    run_shell(quiet + "nullsrc=s=240x180:r=30:d=2,format=gray,geq=lum='X+10' -c:v ffv1 '" +
              (folder / "plane_depth.mkv").string() + "'");
}

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.4 ";
constexpr const char* kHoverAndPress = "mousemove 330 400 sleep 0.7 mousedown 1 sleep 0.6 ";

std::string drag_to_the_right() {
    std::string commands;
    for (int step = 0; step < 100; ++step) commands += "mousemove_relative -- 3 0 sleep 0.012 ";
    return commands;
}

/// Plays a chain of commands to the viewer over the plane and gives back what it recorded.
std::vector<Row> recorded(const std::string& commands, const std::string& friction) {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer = desk.start_viewer(
        folder, {"plane_color.mkv", "--raw-depth", "--relief", "100", "--friction", friction,
                 "--device", "mouse", "--record", "hand.dibhr", "--screenshot", "last.png",
                 "--size", "1280x800", "--seconds", "30"});
    desk.act(kMeet + commands + "key q");
    REQUIRE(viewer.wait() == 0);
    const MediaDescription picture = describe_media(folder / "last.png");
    CHECK(picture.colour_columns == 1280);
    CHECK(picture.colour_rows == 800);
    return read_session(folder / "hand.dibhr");
}

std::size_t first_press(const std::vector<Row>& rows) {
    const auto press =
        std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.pressed; });
    REQUIRE(press != rows.end());
    return static_cast<std::size_t>(press - rows.begin());
}

/// Rows of the drag in which the proxy slides to the right.
std::vector<Row> sliding_rows(const std::vector<Row>& rows) {
    std::vector<Row> sliding;
    const double start_x = rows[first_press(rows)].goal.x;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const bool slides =
            rows[k - 1].contact && rows[k].contact && rows[k].proxy.x > rows[k - 1].proxy.x + 1e-6;
        if (rows[k].pressed && slides && rows[k].goal.x > start_x + 15.0)
            sliding.push_back(rows[k]);
    }
    return sliding;
}

double friction_felt(const Row& row) {
    const Vec3 normal = plane_normal();
    const double pressing = glm::dot(row.spring_newton, normal);
    return glm::length(row.spring_newton - pressing * normal) / pressing;
}

void check_hovering(const std::vector<Row>& rows) {
    const std::size_t press = first_press(rows);
    REQUIRE(press > 200);
    for (std::size_t k = press - 100; k < press; ++k) {
        CHECK_FALSE(rows[k].contact);
        CHECK(rows[k].goal.z > elevation(rows[k].goal));
        CHECK_THAT(glm::length(rows[k].sent_newton), WithinAbs(0.0, 1e-12));
    }
}

void check_contact(const Row& row) {
    CAPTURE(row.t_s, row.goal.x, row.goal.z, row.proxy.x, row.proxy.z);
    CHECK_THAT(row.proxy.z, WithinAbs(elevation(row.proxy), 1e-6));
    CHECK(row.goal.z < elevation(row.goal));
    const Vec3 spring = kStiffness_newton_per_mm * kPitch_mm * (row.proxy - row.goal);
    CHECK_THAT(glm::distance(row.spring_newton, spring), WithinAbs(0.0, 1e-9));
    CHECK(glm::length(row.sent_newton) <= SafetyLimits{}.max_force_newton + 1e-9);
}

}  // namespace

TEST_CASE(
    "a pressed mouse puts the proxy on the surface, the goal under it, and dragged it is held back",
    "[window]") {
    const double friction = GENERATE(0.0, 0.8);
    CAPTURE(friction);
    const auto rows = recorded(kHoverAndPress + drag_to_the_right() + "mouseup 1 sleep 0.3 ",
                               friction > 0.0 ? "0.8" : "0");
    check_hovering(rows);
    std::size_t contacts = 0;
    for (const Row& row : rows) {
        if (!row.contact) continue;
        ++contacts;
        check_contact(row);
        CHECK(friction_felt(row) < friction + 0.01);
    }
    CHECK(contacts > 500);
    const auto sliding = sliding_rows(rows);
    REQUIRE(sliding.size() > 100);
    for (const Row& row : sliding) {
        CHECK_THAT(friction_felt(row), WithinAbs(friction, 0.01));
        if (friction > 0.0) CHECK(row.spring_newton.x < 0.0);
    }
    // Not in each row: a late tick on a busy machine takes the force off for a moment.
    const auto felt = std::count_if(sliding.begin(), sliding.end(),
                                    [](const Row& row) { return row.sent_newton.z > 0.0; });
    CHECK(static_cast<double>(felt) > 0.5 * static_cast<double>(sliding.size()));
    CHECK_FALSE(rows.back().contact);
    CHECK_THAT(glm::length(rows.back().sent_newton), WithinAbs(0.0, 1e-12));
}

TEST_CASE("the force key takes the force off in the middle of a contact, and puts it on again",
          "[window]") {
    const auto rows =
        recorded(std::string(kHoverAndPress) + "key f sleep 0.5 key f sleep 1 mouseup 1 ", "0.4");
    const auto is_off = [](const Row& row) { return row.cut == static_cast<int>(SafetyCut::off); };
    const auto off = std::find_if(rows.begin(), rows.end(), is_off);
    REQUIRE(off != rows.end());
    REQUIRE(off != rows.begin());
    // Not in the very row before: a late tick or the film's loop may just have begun the ramp
    // again.
    const auto before = off - std::min<std::ptrdiff_t>(1000, off - rows.begin());
    CHECK(std::any_of(before, off,
                      [](const Row& row) { return glm::length(row.sent_newton) > 0.3; }));
    const auto on = std::find_if_not(off, rows.end(), is_off);
    REQUIRE(on - off > 200);
    for (auto row = off; row != on; ++row)
        CHECK_THAT(glm::length(row->sent_newton), WithinAbs(0.0, 1e-12));
    CHECK((on - 1)->contact);
    CHECK(glm::length((on - 1)->spring_newton) > 0.3);
    const auto strongest = std::max_element(on, rows.end(), [](const Row& a, const Row& b) {
        return glm::length(a.sent_newton) < glm::length(b.sent_newton);
    });
    REQUIRE(strongest != rows.end());
    CHECK(glm::length(strongest->sent_newton) > 0.3);
}

TEST_CASE(
    "Ctrl+C in the middle of a contact ends the viewer in order, its recording and picture whole",
    "[window]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer =
        desk.start_viewer(folder, {"plane_color.mkv", "--record", "hand.dibhr", "--screenshot",
                                   "last.png", "--size", "640x480", "--seconds", "30"});
    desk.act(std::string(kMeet) + "mousemove 150 220 sleep 0.3 mousedown 1 sleep 0.5");
    viewer.interrupt();
    CHECK(viewer.wait() == 0);
    CHECK(read_session(folder / "hand.dibhr").size() > 500);
    CHECK(describe_media(folder / "last.png").colour_columns == 640);
    CHECK_FALSE(std::filesystem::exists(folder / "config"));
}

TEST_CASE("while its key is held the depth is felt as recorded", "[window]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer = desk.start_viewer(folder, {"plane_color.mkv", "--device", "mouse", "--record",
                                                "hand.dibhr", "--seconds", "30"});
    desk.act(kMeet + std::string("sleep 2 keydown b sleep 2 keyup b sleep 2 key q"));
    REQUIRE(viewer.wait() == 0);
    const Session session(folder / "hand.dibhr");
    std::vector<bool> cleaned;  // whenever it changed
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) {
        const bool is_cleaned = tick.frames.source.fill_holes;
        if (tick.surface && (cleaned.empty() || cleaned.back() != is_cleaned))
            cleaned.push_back(is_cleaned);
    }
    CHECK(cleaned == std::vector{true, false, true});
}

TEST_CASE("a file that cannot be opened from the window is told there, and the program goes on",
          "[window]") {
    const Desk desk;  // the file's name begins with the key that quits, so typing must not act
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer =
        desk.start_viewer(folder, {"plane_color.mkv", "--record", "hand.dibhr", "--seconds", "30"});
    desk.act(std::string(kMeet) + "key ctrl+o sleep 0.3 type quartz.mp4");
    desk.act("sleep 0.3 keydown Return sleep 0.3 keyup Return sleep 0.5 key Escape sleep 0.2");
    const auto pictures = [&folder] {
        const auto names = names_in(folder.path());
        return std::count_if(names.begin(), names.end(), [](const std::string& name) {
            return name.starts_with("dibhr-") && name.ends_with(".png");
        });
    };
    // On a busy machine the picture that takes Escape may come later than this key.
    for (int k = 0; k < 10 && pictures() == 0; ++k) desk.act("key F12 sleep 0.5");
    CHECK(pictures() > 0);
    desk.act("key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(std::filesystem::file_size(folder / "errors.txt") == 0);
    CHECK(read_session(folder / "hand.dibhr").size() > 1000);
}
