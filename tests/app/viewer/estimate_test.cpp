// Depth made for a video of colour alone, in the real window, by a small program in place of an
// estimator.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/settings/settings.hpp"
#include "core/video/media.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

const std::string kMeet = "search --sync --onlyvisible --name dibhr sleep 0.6 ";
constexpr std::chrono::seconds kPatience{60};

/// The folder of a person who has a still picture with depth, a video without, and an estimator,
/// which waits before the fourth frame until it may go on.
struct Home {
    TemporaryFolder folder{};

    Home() {
        write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
        run_shell(folder,
                  "ffmpeg -v error -f lavfi -i \"color=black:s=64x48:r=30,format=gray,"
                  "geq=lum='X+5*N'\" -frames:v 12 -c:v libx264 -crf 8 -pix_fmt yuv420p clip.mp4");
        const std::string here = folder.path().string();
        write_text(folder / "estimator", "#!/bin/sh\necho $$ >'" + here +
                                             "/pid'\nn=0\nfor f in \"$1\"/*.png; do\nn=$((n+1))\n"
                                             "while [ $n = 4 ] && [ ! -e '" +
                                             here +
                                             "/go' ]; do sleep 0.1; done\n"
                                             "cp \"$f\" \"$2/${f##*/}\"\ndone\n");
        fs::permissions(folder / "estimator", fs::perms::owner_all);
        fs::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[estimators]\nmine = \"" + here + "/estimator {frames} {output}\"\n");
    }
    [[nodiscard]] Process view(const Desk& desk, std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(),
                         {"--device", "mouse", "--size", "1280x800", "--seconds", "240"});
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
};

std::string click(int x, int y) {
    return "mousemove " + std::to_string(x) + " " + std::to_string(y) +
           " sleep 0.3 mousedown 1 sleep 0.3 mouseup 1 sleep 0.3 ";
}

const std::string kMake = click(340, 131);
const std::string kCancel = click(306, 148);

/// `type` takes the rest of its line.
void open_clip(const Desk& desk) {
    desk.act(kMeet + "key ctrl+o sleep 1 type clip.mp4");
    desk.act("sleep 0.5 keydown Return sleep 0.3 keyup Return sleep 1.5");
}

/// Presses until what it is to do has begun: a busy machine shows the button late.
template <typename Begun>
bool begins(const Desk& desk, const std::string& press, const Begun& begun) {
    for (int k = 0; k < 10; ++k) {
        desk.act(kMeet + press);
        if (eventually(begun, std::chrono::seconds(4))) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("a video of colour alone is touched with depth that is made in the window",
          "[estimate_window]") {
    const Desk desk;
    const Home home;
    Process viewer = home.view(desk, {"slope_depth.png", "--record", "hand.dibhr"});
    open_clip(desk);
    REQUIRE(begins(desk, kMake, [&] { return home.keeps("said.txt"); }));
    // What was open is touched meanwhile.
    desk.act("mousemove 400 420 sleep 0.3 mousedown 1 sleep 1 mouseup 1 sleep 0.2");
    write_text(home.folder / "go", "");
    const auto opened = [&] {
        return read_text(home.folder / "state/dibhr/recent").find("depth.mkv") != std::string::npos;
    };
    CHECK(eventually(opened, kPatience));
    desk.act("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    CHECK(home.keeps("depth.mkv"));
    CHECK(read_text(home.folder / "errors.txt").empty());
    const std::vector<Row> rows = read_session(home.folder / "hand.dibhr");
    CHECK(std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.contact; }) >
          100);
    const auto settings = load_settings(home.folder / "config/dibhr/settings.toml");
    CHECK(settings.estimators.size() == 1);  // kept by a window that has written the file
}

TEST_CASE("depth that is being made is cancelled in the window, or ends with it, and is not lost",
          "[estimate_window]") {
    const Desk desk;
    const Home home;
    Process viewer = home.view(desk, {"clip.mp4", "--stay"});
    const auto waits = [&] { return home.keeps("000003.png") && home.keeps("said.txt"); };
    const auto runs = [&] {
        const std::string pid = read_text(home.folder / "pid");
        return !pid.empty() && ::kill(std::stoi(pid), 0) == 0;
    };
    REQUIRE(begins(desk, kMake, runs));
    REQUIRE(eventually(waits, kPatience));
    CHECK(begins(desk, kCancel, [&] { return !runs(); }));
    CHECK(home.keeps("000003.png"));
    REQUIRE(begins(desk, kMake, runs));
    desk.act("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    CHECK(eventually([&] { return !runs(); }, kPatience));
    CHECK(home.keeps("000003.png"));
    CHECK(contains(read_text(home.folder / "errors.txt"), "'clip.mp4' needs a depth file"));
}
