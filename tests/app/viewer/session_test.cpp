// Recording from the real window and replaying in it: by mouse and keys, on full and vanishing
// disks.
#include <sys/mount.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "app/settings/material.hpp"
#include "app/settings/settings.hpp"
#include "core/session/session.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/open_dialog.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

namespace fs = std::filesystem;

/// A second of film with shapes, holes and noise, so that cleaning and looping have work to do.
void make_films(const TemporaryFolder& folder) {
    static const TemporaryFolder films;
    static const bool made = [] {
        const std::string film = "ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=80x60:r=30:d=1";
        run_shell(film + " -c:v ffv1 '" + (films / "film_color.mkv").string() + "'");
        run_shell(film + ",format=gray -c:v ffv1 '" + (films / "film_depth.mkv").string() + "'");
        return true;
    }();
    static_cast<void>(made);
    for (const std::string name : {"film_color.mkv", "film_depth.mkv"})
        fs::copy_file(films / name, folder / name);
}

WindowProgram start_window(const Desk& desk, const TemporaryFolder& folder,
                           std::vector<std::string> arguments,
                           const std::string& size = "640x480") {
    const std::vector<std::string> more{"--device", "mouse", "--size", size};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return desk.start_viewer(folder, arguments);
}

/// Settings with only the Touch panel open, so that its rows begin near the top.
void open_touch_panel_only(const TemporaryFolder& folder) {
    fs::create_directories(folder / "config/dibhr");
    std::ofstream(folder / "config/dibhr/settings.toml")
        << "[panels]\nvideo = false\ntouch = true\ndevice = false\n";
}

/// A stroke over the relief, pressed in, which goes on.
void begin_stroke(const WindowProgram& viewer) {
    viewer.act("mousemove 100 " + std::to_string(viewer.seen().rows / 2 + 10));
    wait_for_ticks(viewer, kTicksToRest);
    viewer.act("mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    for (int step = 0; step < 4; ++step) viewer.act("mousemove_relative 28 6");
    wait_for_ticks(viewer, kTicksToRest);
}

void stroke(const WindowProgram& viewer) {
    begin_stroke(viewer);
    viewer.act("mouseup 1");
    viewer.wait_until([](const Seen& now) { return !now.contact; });
}

void begin_recording(const WindowProgram& viewer) {
    viewer.act("key ctrl+r");
    viewer.wait_until([](const Seen& now) { return now.records; });
}

void end_recording(const WindowProgram& viewer) {
    viewer.act("key ctrl+r");
    viewer.wait_until([](const Seen& now) { return !now.records; });
}

void click(const WindowProgram& viewer, int x, int y) {
    viewer.act("mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1");
}

/// Clicks on the list of algorithms, under three lines of materials, on an entry of it, and on the
/// sliders under it.
void change_touch_panel(const WindowProgram& viewer) {
    for (const int y : {170, 213, 193, 216, 239, 262, 285}) click(viewer, 550, y);
}

/// In the message box, which is closed.
void take_message(const WindowProgram& viewer, const std::string& words) {
    viewer.wait_until([&](const Seen& now) { return contains(now.message.str(), words); });
    viewer.act("key Escape");
    CHECK(viewer.seen().message.str().empty());
}

/// The file that Ctrl+R made.
fs::path recorded_by_key(const TemporaryFolder& folder) {
    fs::path found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
        if (entry.path().extension() != ".dibhr" ||
            !entry.path().filename().string().starts_with("dibhr-")) {
            continue;
        }
        CHECK(found.empty());
        found = entry.path();
    }
    REQUIRE_FALSE(found.empty());
    return found;
}

std::size_t contacts_in(const fs::path& session) {
    std::size_t contacts = 0;
    for (const Row& row : read_session(session)) contacts += row.contact ? 1 : 0;
    return contacts;
}

/// A disk of that many kilobytes; only root may make one.
class SmallDisk {
  public:
    SmallDisk(const fs::path& place, int kilobytes) : place_(place) {
        fs::create_directory(place_);
        const std::string size = "size=" + std::to_string(kilobytes) + "k";
        mounted_ = ::mount("none", place_.c_str(), "tmpfs", 0, size.c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    [[nodiscard]] bool mounted() const { return mounted_; }

  private:
    fs::path place_;
    bool mounted_{false};
};

}  // namespace

TEST_CASE("a mark has the time at which its key was pressed, not that of the picture that took it",
          "[session]") {
    using Clock = std::chrono::steady_clock;
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    WindowProgram viewer =
        start_window(desk, folder, {"film_color.mkv", "--record", "marked.dibhr"});
    viewer.wait_for_surface();
    viewer.wait_until([](const Seen& now) { return now.records && now.recorded_rows > 0; });
    const auto seconds = [](Clock::duration time) {
        return std::chrono::duration<double>(time).count();
    };
    constexpr double kServer_s = 0.002;  // it counts whole milliseconds
    std::vector<double> least_s, most_s;
    for (std::uint64_t round = 1; round <= 5; ++round) {
        viewer.send(SIGSTOP);
        std::array<Clock::time_point, 2> before{}, after{};
        for (std::size_t k = 0; k < 2; ++k) {
            before[k] = Clock::now();
            desk.press("key m");
            after[k] = Clock::now();
            // The time that is to be found between the marks.
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
        }
        viewer.send(SIGCONT);
        viewer.wait_until([&](const Seen& now) { return now.marks == 2 * round; });
        least_s.push_back(seconds(before[1] - after[0]) - kServer_s);
        most_s.push_back(seconds(after[1] - before[0]) + kServer_s);
    }
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    const std::vector<SessionMark> marks = Session(folder / "marked.dibhr").marks();
    REQUIRE(marks.size() == 10);
    std::size_t right = 0;
    for (std::size_t k = 0; k < 5; ++k) {
        const double apart_s = marks[2 * k + 1].t_s - marks[2 * k].t_s;
        right += apart_s > least_s[k] && apart_s < most_s[k] ? 1 : 0;
    }
    // A window that was stopped just before it reads its keys has no times for them.
    CHECK(right >= 2);
}

TEST_CASE(
    "a recording begun, marked and ended by key replays to the same bits, whatever was changed "
    "meanwhile; a material is chosen by one click, and there the next time",
    "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    open_touch_panel_only(folder);
    {
        // So high that the panels need not be scrolled when the recording's own opens.
        WindowProgram viewer = start_window(desk, folder, {"film_color.mkv"}, "640x800");
        viewer.wait_for_surface();
        begin_recording(viewer);
        begin_stroke(viewer);
        viewer.act("key m");
        CHECK(viewer.seen().marks == 1);
        viewer.act("key f");
        wait_for_ticks(viewer, 20);
        viewer.act("key f mouseup 1");
        change_touch_panel(viewer);
        begin_stroke(viewer);
        viewer.act("mouseup 1");
        click(viewer, 477, 101);  // bark
        begin_stroke(viewer);
        viewer.act("key space");
        CHECK_FALSE(viewer.seen().playing);
        viewer.act("key period key Right mouseup 1");
        end_recording(viewer);
        desk.press("key ctrl+q");
        REQUIRE(viewer.wait() == 0);
    }
    const fs::path file = recorded_by_key(folder);
    CHECK_FALSE(fs::exists(file.string() + "-wal"));
    const Session session(file);
    session.check();
    CHECK(session.fact("complete") == "1");
    for (const auto& [library, version] : library_versions())
        CHECK(session.fact(library) == version);
    CHECK(session.missing() == 0);
    CHECK(contacts_in(file) > 200);
    REQUIRE(session.marks().size() == 1);
    CHECK(session.marks().front().t_s > session.begin_s());
    CHECK(session.marks().front().t_s < session.end_s());
    const TouchParameters& plain = session.parameters().front().touch;
    CHECK(session.parameters().front().bump.file.empty());
    bool other_algorithm = false, other_friction = false, other_cutoff = false, force_off = false;
    for (const SessionParameters& parameters : session.parameters()) {
        if (!parameters.bump.file.empty()) continue;  // they are the material's
        other_algorithm = other_algorithm || parameters.touch.algorithm != plain.algorithm;
        other_friction = other_friction || !(parameters.touch.friction == plain.friction);
        const double cutoff_hz = parameters.touch.coupling.damping_cutoff_hz;
        other_cutoff = other_cutoff || cutoff_hz > 0.0;
        CHECK_THAT(cutoff_hz, WithinAbs(std::round(cutoff_hz), 0.0));  // as it is shown, from "off"
        force_off = force_off || !parameters.force_enabled;
    }
    CHECK(other_algorithm);
    CHECK(other_friction);
    CHECK(other_cutoff);
    CHECK(force_off);
    const SessionParameters& chosen = session.parameters().back();
    CHECK(chosen.bump.file.filename() == "bark.png");
    CHECK(is_made_of(material_named("bark"), chosen.touch));
    CHECK_FALSE(chosen.touch == plain);
    require_same_bits(folder, file);

    WindowProgram viewer = start_window(desk, folder, {"film_color.mkv", "--record", "next.dibhr"});
    viewer.wait_for_surface();
    stroke(viewer);
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    require_same_bits(folder, folder / "next.dibhr");
    const Session next(folder / "next.dibhr");
    CHECK(next.fact("material") == "bark");
    CHECK(next.parameters().front().touch == chosen.touch);
    CHECK(next.parameters().front().bump.file == chosen.bump.file);
    // The session's facts are the values in use, after fitting to the picture.
    for (const TouchNumber& number : touch_numbers()) {
        CAPTURE(number.name);
        CHECK(std::stod(next.fact(std::string(number.name))) == number.of(chosen.touch));
    }
    for (const TouchSwitch& entry : touch_switches()) {
        CAPTURE(entry.name);
        CHECK(next.fact(std::string(entry.name)) == (entry.of(chosen.touch) ? "on" : "off"));
    }
    for (const TouchChoice& choice : touch_choices()) {
        CAPTURE(choice.name);
        CHECK(next.fact(std::string(choice.name)) == choice.of(chosen.touch));
    }
}

TEST_CASE(
    "a session is replayed in the window by itself or moved by keys, reported on by a button, left "
    "for touching, and ends like any other",
    "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    {
        WindowProgram viewer = start_window(
            desk, folder, {"film_color.mkv", "--relief", "40", "--record", "hand.dibhr"});
        viewer.wait_for_surface();
        stroke(viewer);
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
    }
    const std::string recorded = read_text(folder / "hand.dibhr");
    {
        WindowProgram viewer = desk.start_viewer(
            folder, {"hand.dibhr", "--speed", "4", "--size", "320x240", "--screenshot", "r.png"});
        viewer.wait_until([](const Seen& now) {
            return now.replays && now.surface && !now.playing && now.media_s == now.duration_s;
        });
        desk.press("key q");
        CHECK(viewer.wait() == 0);
        CHECK(describe_media(folder / "r.png").colour_columns == 320);
        CHECK_FALSE(fs::exists(folder / "config"));
        CHECK(read_text(folder / "errors.txt").empty());
    }
    WindowProgram viewer =
        start_window(desk, folder, {"hand.dibhr", "--algorithm", "pga", "--pause"});
    viewer.wait_until([](const Seen& now) { return now.replays && now.surface && now.tick == 0; });
    const auto is_at = [&viewer](std::int64_t tick) {
        viewer.wait_until([tick](const Seen& now) { return now.tick == tick; });
    };
    viewer.act("key period");
    is_at(1);
    viewer.act("key period");
    is_at(2);
    viewer.act("key comma");
    is_at(1);
    viewer.act("key Home");
    is_at(0);
    // The effect of a key on a replay is seen in the next picture.
    viewer.act("key l key bracketright");
    viewer.wait_until([](const Seen& now) { return now.looping && now.speed == 1.1; });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.tick > 200; });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.playing; });
    const double forward_s = std::min(viewer.seen().media_s + 5.0, viewer.seen().duration_s);
    viewer.act("key Right");
    viewer.wait_until([=](const Seen& now) { return now.media_s > forward_s - 1e-3; });
    const double back_s = std::max(viewer.seen().media_s - 5.0, 0.0);
    viewer.act("key Left");
    viewer.wait_until([=](const Seen& now) { return now.media_s < back_s + 0.5; });

    click(viewer, 556, 98);  // Make a report
    viewer.wait_until([](const Seen& now) { return now.notice.str().starts_with("Report: "); });
    const std::string page = read_text(folder / "hand-report/report.html");
    CHECK(contains(page, "</html>"));

    viewer.act("key ctrl+r");
    CHECK(contains(viewer.seen().notice.str(), "A replay is not recorded"));
    CHECK_FALSE(viewer.seen().records);
    viewer.act("key ctrl+o");
    open_by_name(viewer, "film_color.mkv");
    viewer.wait_until([](const Seen& now) { return !now.replays && now.touchable && now.surface; });
    begin_recording(viewer);
    stroke(viewer);
    end_recording(viewer);
    desk.press("key ctrl+q");
    CHECK(viewer.wait() == 0);
    const fs::path again = recorded_by_key(folder);
    CHECK(contacts_in(again) > 100);
    // With the parameters from before the replay: those of the session are not saved.
    const Fit fit = fit_of(open_depth(folder / "film_depth.mkv")->description());
    CHECK(Session(again).parameters().front().touch.shape == SurfaceShape{fit.relief_px});
    require_same_bits(folder, again);
    CHECK(load_settings(folder / "config/dibhr/settings.toml").touch == Settings{}.touch);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(read_text(folder / "hand.dibhr") == recorded);
}

TEST_CASE("a session file that vanishes while it is recorded is told, and the program goes on",
          "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    WindowProgram viewer = start_window(desk, folder, {"film_color.mkv", "--record", "gone.dibhr"});
    viewer.wait_for_surface();
    viewer.wait_until([](const Seen& now) { return now.recorded_rows > 100; });
    run_shell("rm '" + (folder / "gone.dibhr").string() + "'*");
    take_message(viewer, "gone.dibhr stopped");
    begin_recording(viewer);
    stroke(viewer);
    end_recording(viewer);
    desk.press("key q");
    CHECK(viewer.wait() == 1);
    const std::string told = read_text(folder / "errors.txt");
    CHECK(told.starts_with("dibhr: Recording to gone.dibhr stopped: "));
    CHECK(told.find('\n') == told.size() - 1);
    const fs::path next = recorded_by_key(folder);
    CHECK(contacts_in(next) > 100);
    require_same_bits(folder, next);
}

TEST_CASE("a disk that becomes full in the midst of a recording stops neither hand nor program",
          "[session]") {
    const TemporaryFolder folder;
    const SmallDisk disk(folder / "disk", 1536);
    if (!disk.mounted()) {
        WARN("skipped: a small disk can only be mounted by root");
        CHECK_FALSE(disk.mounted());
        return;
    }
    const Desk desk;
    make_films(folder);
    WindowProgram viewer =
        start_window(desk, folder, {"film_color.mkv", "--record", "disk/full.dibhr"});
    viewer.wait_for_surface();
    begin_stroke(viewer);
    take_message(viewer, "disk/full.dibhr stopped");
    CHECK(viewer.seen().contact);
    viewer.act("mouseup 1");
    begin_recording(viewer);
    stroke(viewer);
    end_recording(viewer);
    desk.press("key q");
    CHECK(viewer.wait() == 1);
    const std::string told = read_text(folder / "errors.txt");
    INFO(told);
    CHECK(told.find("disk/full.dibhr stopped: ") != std::string::npos);
    CHECK(told.find("full") != std::string::npos);
    const Session kept(folder / "disk/full.dibhr");
    kept.check();
    CHECK(kept.rows() > 500);
    CHECK(kept.missing() == 0);
    require_same_bits(folder, kept.file());
    CHECK(contacts_in(recorded_by_key(folder)) > 100);
}
