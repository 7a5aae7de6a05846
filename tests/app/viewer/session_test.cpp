// Recording from the real window and replaying in it: by mouse and keys, on full and vanishing
// disks.
#include <sys/mount.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/settings/material.hpp"
#include "app/settings/settings.hpp"
#include "core/session/session.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

namespace fs = std::filesystem;

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.4 ";

/// A second of film with shapes, holes and noise, so that cleaning and looping have work to do.
void make_films(const TemporaryFolder& folder) {
    const std::string quiet = "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=s=160x120:r=30:d=1";
    run_shell(quiet + " -c:v ffv1 '" + (folder / "film_color.mkv").string() + "'");
    run_shell(quiet + ",format=gray -c:v ffv1 '" + (folder / "film_depth.mkv").string() + "'");
}

/// Of all panels only Touch stands open: its rows begin near the top.
void open_touch_panel_only(const TemporaryFolder& folder) {
    fs::create_directories(folder / "config/dibhr");
    std::ofstream(folder / "config/dibhr/settings.toml")
        << "[panels]\nvideo = false\ntouch = true\ndevice = false\n";
}

/// Strokes over the relief, pressed in.
std::string stroke() {
    std::string commands = "mousemove 330 380 sleep 0.4 mousedown 1 sleep 0.3 ";
    for (int step = 0; step < 25; ++step) commands += "mousemove_relative -- 9 2 sleep 0.01 ";
    return commands;
}

/// Clicks on the list of algorithms, under two lines of materials, an entry of it, and the sliders
/// under it.
std::string change_touch_panel() {
    std::string commands;
    for (const int y : {146, 186, 206, 218, 230, 242, 254, 266}) {
        commands += "mousemove 1130 " + std::to_string(y) + " sleep 0.15 mousedown 1 sleep 0.15 " +
                    "mouseup 1 sleep 0.15 ";
    }
    return commands;
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

TEST_CASE(
    "a recording begun, marked and ended by key replays to the same bits, whatever was changed "
    "meanwhile",
    "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    open_touch_panel_only(folder);
    Process viewer = desk.start_viewer(
        folder, {"film_color.mkv", "--device", "mouse", "--size", "1280x800", "--seconds", "60"});
    desk.act(std::string(kMeet) + "sleep 0.5 key ctrl+r sleep 0.3 " + stroke() +
             "key m sleep 0.2 " + "key f sleep 0.2 key f sleep 0.2 mouseup 1");
    desk.act(change_touch_panel());
    desk.act("mousemove 400 300 sleep 0.2 " + stroke() +
             "key space sleep 0.4 key period sleep 0.3 " +
             "key Right sleep 0.3 mouseup 1 key ctrl+r sleep 0.8 key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    const fs::path file = recorded_by_key(folder);
    CHECK_FALSE(fs::exists(file.string() + "-wal"));
    const Session session(file);
    session.check();
    CHECK(session.fact("complete") == "1");
    for (const auto& [library, version] : library_versions()) {
        CHECK(session.fact(library) == version);
    }
    CHECK(session.missing() == 0);
    CHECK(contacts_in(file) > 200);
    REQUIRE(session.marks().size() == 1);
    CHECK(session.marks().front().t_s > session.begin_s());
    CHECK(session.marks().front().t_s < session.end_s());
    bool other_algorithm = false, other_friction = false, other_cutoff = false, force_off = false;
    for (const SessionParameters& parameters : session.parameters()) {
        const TouchParameters& first = session.parameters().front().touch;
        other_algorithm = other_algorithm || parameters.touch.algorithm != first.algorithm;
        other_friction = other_friction || !(parameters.touch.friction == first.friction);
        const double cutoff_hz = parameters.touch.coupling.damping_cutoff_hz;
        other_cutoff = other_cutoff || cutoff_hz > 0.0;
        CHECK_THAT(cutoff_hz, WithinAbs(std::round(cutoff_hz), 0.0));  // as it is shown, from "off"
        force_off = force_off || !parameters.force_enabled;
    }
    CHECK(other_algorithm);
    CHECK(other_friction);
    CHECK(other_cutoff);
    CHECK(force_off);
    require_same_bits(folder, file);
}

TEST_CASE("a material is chosen by one click, felt, recorded and replayed, and there the next time",
          "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    open_touch_panel_only(folder);
    const auto view = [&](const std::string& recording, const std::string& commands) {
        Process viewer =
            desk.start_viewer(folder, {"film_color.mkv", "--device", "mouse", "--size", "1280x800",
                                       "--record", recording, "--seconds", "60"});
        desk.act(kMeet + commands + "key ctrl+q");
        REQUIRE(viewer.wait() == 0);
        require_same_bits(folder, folder / recording);
    };
    const std::string click_on_bark =
        "sleep 0.5 mousemove 1063 101 sleep 0.2 mousedown 1 sleep 0.2 mouseup 1 sleep 0.5 ";
    view("first.dibhr", click_on_bark + stroke() + "mouseup 1 sleep 0.3 ");
    view("next.dibhr", "sleep 0.5 " + stroke() + "mouseup 1 sleep 0.3 ");

    const Session first(folder / "first.dibhr");
    const TouchParameters plain = first.parameters().front().touch;
    CHECK(first.parameters().front().bump.file.empty());
    const SessionParameters& chosen = first.parameters().back();
    CHECK(chosen.bump.file.filename() == "bark.png");
    CHECK(is_made_of(material_called("bark"), chosen.touch));
    CHECK_FALSE(chosen.touch == plain);
    const Session next(folder / "next.dibhr");
    CHECK(next.fact("material") == "bark");
    CHECK(next.parameters().front().touch == chosen.touch);
    CHECK(next.parameters().front().bump.file == chosen.bump.file);
    // What is told of it in words is what was touched with, once that is fitted to the picture.
    for (const TouchNumber& number : touch_numbers()) {
        CAPTURE(number.name);
        CHECK(std::stod(next.fact(std::string(number.name))) == number.of(chosen.touch));
    }
}

TEST_CASE("a report is made from a replay by a button, while the window goes on", "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    {
        Process viewer =
            desk.start_viewer(folder, {"film_color.mkv", "--device", "mouse", "--size", "1280x800",
                                       "--record", "hand.dibhr", "--seconds", "60"});
        desk.act(kMeet + stroke() + "mouseup 1 key ctrl+q");
        REQUIRE(viewer.wait() == 0);
    }
    Process viewer =
        desk.start_viewer(folder, {"hand.dibhr", "--size", "1280x800", "--seconds", "60"});
    desk.act(std::string(kMeet) +
             "sleep 0.5 mousemove 1180 98 sleep 0.3 mousedown 1 sleep 0.2 mouseup 1");
    const fs::path page = folder / "hand-report/report.html";
    CHECK(eventually([&page] { return fs::exists(page); }, std::chrono::seconds(20)));
    desk.act(std::string(kMeet) + "key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(contains(read_text(page), "</html>"));
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("a session is replayed in the window, moved by keys, and ends like any other",
          "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    {
        Process viewer =
            desk.start_viewer(folder, {"film_color.mkv", "--device", "mouse", "--relief", "40",
                                       "--record", "hand.dibhr", "--seconds", "60"});
        desk.act(std::string(kMeet) + stroke() + "mouseup 1 sleep 0.2 key q");
        REQUIRE(viewer.wait() == 0);
    }
    const std::string recorded = read_text(folder / "hand.dibhr");
    SECTION("by itself") {
        Process viewer = desk.start_viewer(
            folder, {"hand.dibhr", "--seconds", "2", "--size", "800x600", "--screenshot", "r.png"});
        CHECK(viewer.wait() == 0);
        CHECK(describe_media(folder / "r.png").colour_columns == 800);
        CHECK_FALSE(fs::exists(folder / "config"));
    }
    SECTION("by keys, through another algorithm, and back to touching") {
        Process viewer = desk.start_viewer(
            folder, {"hand.dibhr", "--algorithm", "pga", "--seconds", "60", "--device", "mouse"});
        desk.act(std::string(kMeet) +
                 "sleep 0.5 key space sleep 0.2 key period sleep 0.2 key comma sleep 0.2 key Home "
                 "sleep 0.2 key l sleep 0.1 key bracketright sleep 0.1 key space sleep 0.4 key "
                 "Right sleep 0.3 key Left sleep 0.3");
        // A replay is not recorded; a video opened from it is touched again.
        desk.act("key ctrl+r sleep 0.2 key ctrl+o sleep 0.4 type film_color.mkv");
        desk.act("sleep 0.3 keydown Return sleep 0.3 keyup Return sleep 1 key ctrl+r sleep 0.5 " +
                 stroke() + "mouseup 1 key ctrl+r sleep 0.6 key ctrl+q");
        CHECK(viewer.wait() == 0);
        const fs::path again = recorded_by_key(folder);
        CHECK(contacts_in(again) > 100);
        // With the parameters of before, not those of the session, which do not last.
        const Fit fit = fit_of(open_depth(folder / "film_depth.mkv")->description());
        CHECK(Session(again).parameters().front().touch.shape == SurfaceShape{fit.relief_px});
        require_same_bits(folder, again);
        CHECK(load_settings(folder / "config/dibhr/settings.toml").touch == Settings{}.touch);
    }
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(read_text(folder / "hand.dibhr") == recorded);
}

TEST_CASE("a session file that vanishes while it is recorded is told, and the program goes on",
          "[session]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer = desk.start_viewer(folder, {"film_color.mkv", "--device", "mouse", "--record",
                                                "gone.dibhr", "--seconds", "60"});
    desk.act(std::string(kMeet) + "sleep 0.5");
    run_shell("rm '" + (folder / "gone.dibhr").string() + "'*");
    desk.act("sleep 1.2 key Escape sleep 0.2 key ctrl+r sleep 0.5 " + stroke() +
             "mouseup 1 key ctrl+r sleep 0.6 key q");
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
    const SmallDisk disk(folder / "disk", 1024);
    if (!disk.mounted()) {
        WARN("skipped: a small disk can only be mounted by root");
        CHECK_FALSE(disk.mounted());
        return;
    }
    const Desk desk;
    make_films(folder);
    Process viewer = desk.start_viewer(folder, {"film_color.mkv", "--device", "mouse", "--record",
                                                "disk/full.dibhr", "--seconds", "90"});
    desk.act(std::string(kMeet) + stroke() + "sleep 12");
    desk.act("key Escape mouseup 1 sleep 0.2 key ctrl+r sleep 0.5 " + stroke() +
             "mouseup 1 key ctrl+r sleep 0.6 key q");
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
