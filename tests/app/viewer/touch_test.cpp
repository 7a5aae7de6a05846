// The real window under a synthetic pointer: what is recorded is what a hand on the mouse must
// feel.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

namespace fs = std::filesystem;
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

/// Two seconds of film, 240 x 180, without loss, which all tests read and none changes.
const TemporaryFolder& plane_films() {
    static const TemporaryFolder folder;
    static const bool made = [] {
        const std::string quiet = "ffmpeg -nostdin -v error -f lavfi -i ";
        run_shell(folder, quiet + "testsrc2=s=240x180:r=30:d=2 -c:v ffv1 plane_color.mkv");
        run_shell(folder, quiet +
                              "nullsrc=s=240x180:r=30:d=2,format=gray,geq=lum='X+10' "
                              "-c:v ffv1 plane_depth.mkv");
        return true;
    }();
    static_cast<void>(made);
    return folder;
}

/// Starts a window over the plane, which is recorded.
WindowProgram view_plane(const Desk& desk, const TemporaryFolder& home,
                         const std::vector<std::string>& options) {
    std::vector<std::string> arguments{(plane_films() / "plane_color.mkv").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const std::vector<std::string> more{"--device",     "mouse",    "--record", "hand.dibhr",
                                        "--screenshot", "last.png", "--size",   "640x480"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return desk.start_viewer(home, arguments);
}

/// Options for the film's plane, uncleaned.
std::vector<std::string> raw_with_friction(const std::string& friction) {
    return {"--raw-depth", "--relief", "100", "--friction", friction};
}

bool is_felt(const Seen& now) {
    return now.sent_newton > 0.3;
}

void hover_and_press(const WindowProgram& viewer) {
    viewer.act("mousemove 80 230");
    wait_for_ticks(viewer, kTicksToRest);
    viewer.act("mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    wait_for_ticks(viewer, kTicksToRest);
    viewer.wait_until(is_felt);
}

void drag_to_the_right(const WindowProgram& viewer) {
    for (int step = 0; step < 20; ++step) viewer.act("mousemove_relative 10 0");
    wait_for_ticks(viewer, kTicksToRest);
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

template <typename Property>
auto rows_without(const std::vector<Row>& rows, const Property& has) {
    return std::count_if(rows.begin(), rows.end(), std::not_fn(has));
}

/// Checks the rows in contact: all on the plane, and the sliding ones by the current friction.
void check_drag(const std::vector<Row>& rows, double friction) {
    std::vector<Row> contacts;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(contacts),
                 [](const Row& row) { return row.contact; });
    REQUIRE(contacts.size() > 500);
    CHECK(rows_without(contacts, [](const Row& row) {
              return std::abs(row.proxy.z - elevation(row.proxy)) < 1e-6;
          }) == 0);
    CHECK(rows_without(contacts, [](const Row& row) { return row.goal.z < elevation(row.goal); }) ==
          0);
    CHECK(rows_without(contacts, [](const Row& row) {
              const Vec3 spring = kStiffness_newton_per_mm * kPitch_mm * (row.proxy - row.goal);
              return glm::distance(row.spring_newton, spring) < 1e-9;
          }) == 0);
    CHECK(rows_without(contacts, [](const Row& row) {
              return glm::length(row.sent_newton) <= SafetyLimits{}.max_force_newton + 1e-9;
          }) == 0);
    CHECK(rows_without(contacts, [friction](const Row& row) {
              return friction_felt(row) < friction + 0.01;
          }) == 0);

    const std::vector<Row> sliding = sliding_rows(rows);
    REQUIRE(sliding.size() > 100);
    CHECK(rows_without(sliding, [friction](const Row& row) {
              return std::abs(friction_felt(row) - friction) < 0.01;
          }) == 0);
    CHECK(rows_without(sliding, [friction](const Row& row) {
              return !(friction > 0.0) || row.spring_newton.x < 0.0;
          }) == 0);
    CHECK(rows_without(sliding, [](const Row& row) { return row.sent_newton.z >= 0.0; }) == 0);
    CHECK(std::any_of(sliding.begin(), sliding.end(),
                      [](const Row& row) { return row.sent_newton.z > 0.1; }));
}

/// Checks that the force goes to zero while the proxy stays in contact, and comes back.
void check_force_off(const std::vector<Row>& rows) {
    const auto is_off = [](const Row& row) { return row.cut == static_cast<int>(SafetyCut::off); };
    const auto is_strong = [](const Row& row) { return glm::length(row.sent_newton) > 0.3; };
    const auto off = std::find_if(rows.begin(), rows.end(), is_off);
    const auto on = std::find_if(rows.rbegin(), rows.rend(), is_off).base();
    REQUIRE(on - off > 200);
    CHECK(std::any_of(rows.begin(), off, is_strong));
    CHECK(std::all_of(off, on, [](const Row& row) { return row.sent_newton == Vec3(0.0); }));
    CHECK((on - 1)->contact);
    CHECK(glm::length((on - 1)->spring_newton) > 0.3);
    CHECK(std::any_of(on, rows.end(), is_strong));
}

/// Whether the touched surface had its holes filled, at each change of that.
std::vector<bool> cleaned_in(const fs::path& file) {
    const Session session(file);
    std::vector<bool> cleaned;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) {
        const bool is_cleaned = tick.frames.source.fill_holes;
        if (tick.surface && (cleaned.empty() || cleaned.back() != is_cleaned))
            cleaned.push_back(is_cleaned);
    }
    return cleaned;
}

/// The last picture is of the window's size, and nothing is kept of what nobody changed.
void check_last_picture(const TemporaryFolder& home) {
    const MediaDescription picture = describe_media(home / "last.png");
    CHECK(picture.colour_columns == 640);
    CHECK(picture.colour_rows == 480);
    CHECK_FALSE(fs::exists(home / "config"));
}

}  // namespace

TEST_CASE(
    "a pressed mouse puts the proxy on the surface, the goal under it, and dragged it is held "
    "back; the force key takes the force off in the middle of the contact, and puts it on again",
    "[window]") {
    const Desk desk;
    const TemporaryFolder home;
    WindowProgram viewer = view_plane(desk, home, raw_with_friction("0.8"));
    viewer.wait_for_surface();
    hover_and_press(viewer);
    viewer.act("key f");
    wait_for_ticks(viewer, kTicksToRest);
    CHECK(viewer.seen().contact);
    viewer.act("key f");
    viewer.wait_until(is_felt);
    drag_to_the_right(viewer);
    viewer.wait_until(is_felt);
    viewer.act("mouseup 1");
    viewer.wait_until([](const Seen& now) { return !now.contact && now.sent_newton == 0.0; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);

    const std::vector<Row> rows = read_session(home / "hand.dibhr");
    check_hovering(rows);
    check_drag(rows, 0.8);
    check_force_off(rows);
    CHECK_FALSE(rows.back().contact);
    CHECK_THAT(glm::length(rows.back().sent_newton), WithinAbs(0.0, 1e-12));
}

TEST_CASE(
    "without friction nothing holds a drag back; what ends in the middle of the contact has its "
    "recording and its picture whole",
    "[window]") {
    const Desk desk;
    const TemporaryFolder home;
    WindowProgram viewer = view_plane(desk, home, raw_with_friction("0"));
    viewer.wait_for_surface();
    hover_and_press(viewer);
    drag_to_the_right(viewer);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    const std::vector<Row> rows = read_session(home / "hand.dibhr");
    check_hovering(rows);
    check_drag(rows, 0.0);
    CHECK(rows.back().contact);
    check_last_picture(home);
}

// 600 ms after the signal the program would end itself at once, with exit code 1.
TEST_CASE(
    "Ctrl+C in the middle of a contact ends the viewer in order, its recording and picture whole",
    "[window][realtime]") {
    const Desk desk;
    const TemporaryFolder home;
    WindowProgram viewer = view_plane(desk, home, {});
    viewer.wait_for_surface();
    hover_and_press(viewer);
    viewer.interrupt();
    CHECK(viewer.wait() == 0);
    const std::vector<Row> rows = read_session(home / "hand.dibhr");
    CHECK(rows.size() > 500);
    CHECK(rows.back().contact);
    check_last_picture(home);
}

TEST_CASE(
    "while its key is held the depth is felt as recorded; a file that cannot be opened is told in "
    "the window, and the program goes on",
    "[window]") {
    const Desk desk;
    const TemporaryFolder home;
    WindowProgram viewer = view_plane(desk, home, {});
    viewer.wait_for_surface();
    const fs::path session = home / "hand.dibhr";
    const auto come_to = [&session](const std::vector<bool>& cleaned) {
        return eventually([&] { return cleaned_in(session) == cleaned; });
    };
    CHECK(come_to({true}));
    viewer.act("keydown b");
    CHECK(viewer.seen().as_recorded);
    CHECK(come_to({true, false}));
    viewer.act("keyup b");
    CHECK_FALSE(viewer.seen().as_recorded);
    CHECK(come_to({true, false, true}));

    // The file's name begins with the key that quits: typing must not act.
    viewer.act("key ctrl+o");
    viewer.wait_until([](const Seen& now) { return now.dialog_typing; });
    write_text(home / "quartz.mp4", "no video");
    viewer.act("type quartz.mp4 key Return");
    viewer.wait_until([](const Seen& now) { return contains(now.message.str(), "quartz.mp4"); });
    viewer.act("key Escape");
    CHECK(viewer.seen().message.str().empty());
    const std::uint64_t rows = viewer.seen().recorded_rows;
    viewer.act("key F12");
    const auto is_picture = [](const std::string& name) {
        return name.starts_with("dibhr-") && name.ends_with(".png");
    };
    CHECK(eventually([&] {
        const auto names = names_in(home.path());
        return std::any_of(names.begin(), names.end(), is_picture);
    }));
    viewer.wait_until([rows](const Seen& now) { return now.recorded_rows > rows; });
    desk.press("key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(fs::file_size(home / "errors.txt") == 0);
    CHECK(cleaned_in(session) == std::vector{true, false, true});
}
