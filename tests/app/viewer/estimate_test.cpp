// Depth made for a video of colour alone, in the real window, by a small program in place of an
// estimator.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/settings/settings.hpp"
#include "core/video/sources/media.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/open_dialog.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds kPatience{60};

/// A home folder with a still picture with depth, a video without, and an estimator that waits
/// before the fourth frame until the test continues it.
struct Home {
    TemporaryFolder folder{};

    Home() {
        write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
        run_shell(folder,
                  "ffmpeg -v error -f lavfi -i \"color=black:s=64x48:r=30,format=gray,"
                  "geq=lum='X+5*N'\" -frames:v 12 -c:v libx264 -crf 8 -pix_fmt yuv420p clip.mp4");
        REQUIRE(::mkfifo((folder / "go").c_str(), 0600) == 0);
        const std::string here = folder.path().string();
        write_text(
            folder / "estimator",
            "#!/bin/sh\necho $$ >'" + here +
                "/pid'\nn=0\nfor f in \"$1\"/*.png; do\nn=$((n+1))\n[ $n = 4 ] && read go <'" +
                here + "/go'\ncp \"$f\" \"$2/${f##*/}\"\ndone\n");
        fs::permissions(folder / "estimator", fs::perms::owner_all);
        fs::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[estimators]\nmine = \"" + here + "/estimator {frames} {output}\"\n");
    }
    [[nodiscard]] WindowProgram view(const Desk& desk, std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--device", "mouse", "--size", "800x600"});
        return desk.start_viewer(folder, arguments,
                                 {"/usr/bin/env", "XDG_CACHE_HOME=" + (folder / "cache").string()});
    }
    /// Whether such a file of the estimator's, or of what was made of it, is kept.
    [[nodiscard]] bool keeps(const std::string& name) const {
        std::error_code changed;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "cache", changed))
            if (entry.path().filename() == name &&
                entry.path().parent_path().filename() != "frames")
                return true;
        return false;
    }
    [[nodiscard]] bool runs() const {
        const std::string pid = read_text(folder / "pid");
        return !pid.empty() && ::kill(std::stoi(pid), 0) == 0;
    }
    /// The estimator, before the fourth frame.
    [[nodiscard]] bool waits() const { return runs() && keeps("said.txt") && keeps("000003.png"); }
};

constexpr const char* kMake = "mousemove 100 115 click 1";
constexpr const char* kRun = "mousemove 100 184 click 1";
constexpr const char* kCancel = "mousemove 66 149 click 1";

}  // namespace

TEST_CASE(
    "depth that is made in the window is cancelled and goes on there, while a hand touches, "
    "and is touched when it is made",
    "[estimate_window]") {
    const Desk desk;
    const Home home;
    WindowProgram viewer = home.view(desk, {"slope_depth.png", "--record", "hand.dibhr"});
    viewer.wait_for_surface();
    viewer.act("key ctrl+o");
    open_by_name(viewer, "clip.mp4");
    viewer.wait_until([](const Seen& now) { return now.depth_offered; });
    viewer.act(kMake);
    viewer.wait_until([](const Seen& now) { return now.asks_command; });
    viewer.wait_for_turn();
    CHECK_FALSE(home.runs());
    viewer.act(kRun);
    REQUIRE(eventually([&] { return home.waits(); }, kPatience));
    viewer.act(kCancel);
    REQUIRE(eventually([&] { return !home.runs(); }, kPatience));
    CHECK(home.keeps("000003.png"));
    viewer.wait_until([](const Seen& now) { return !now.depth_in_work; });
    viewer.wait_for_turn();  // the button is drawn again
    viewer.act(kMake);
    REQUIRE(eventually([&] { return home.runs(); }, kPatience));
    // The open file is touched meanwhile.
    viewer.act("mousemove 230 300 mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    const std::uint64_t rows = viewer.seen().recorded_rows;
    viewer.wait_until([rows](const Seen& now) { return now.recorded_rows > rows + 200; });
    viewer.act("mouseup 1");
    write_text(home.folder / "go", "on\n");
    viewer.wait_until(
        [](const Seen& now) { return now.surface && now.file.str().ends_with("clip.mp4"); });
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    CHECK(contains(read_text(home.folder / "state/dibhr/recent"), "depth.mkv"));
    CHECK(home.keeps("depth.mkv"));
    CHECK(read_text(home.folder / "errors.txt").empty());
    CHECK(contains(read_text(home.folder / "state/dibhr/agreed"),
                   "run " + home.folder.path().string() + "/estimator {frames} {output}\n"));
    const std::vector<Row> touched = read_session(home.folder / "hand.dibhr");
    CHECK(std::count_if(touched.begin(), touched.end(),
                        [](const Row& row) { return row.contact; }) > 100);
    const auto settings = load_settings(home.folder / "config/dibhr/settings.toml");
    CHECK(settings.estimators.size() == 1);  // kept by a window that has written the file
}

TEST_CASE("depth that is being made ends with the window, and what is made of it is not lost",
          "[estimate_window]") {
    const Desk desk;
    const Home home;
    WindowProgram viewer = home.view(desk, {"clip.mp4", "--stay"});
    viewer.wait_until([](const Seen& now) { return now.depth_offered; });
    viewer.act(kMake);
    viewer.act(kRun);
    REQUIRE(eventually([&] { return home.waits(); }, kPatience));
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    CHECK(eventually([&] { return !home.runs(); }, kPatience));
    CHECK(home.keeps("000003.png"));
    CHECK(contains(read_text(home.folder / "errors.txt"), "needs a depth file"));
}
