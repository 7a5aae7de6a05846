// The rows of the Video panel that say what depth means, under a synthetic pointer and keyboard.
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "core/video/depth/kept_choices.hpp"
#include "core/video/depth/sidecar.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.6 ";

/// A person's folder, whose settings leave only the Video panel open: its rows stand near the top.
struct Home {
    TemporaryFolder folder{};
    fs::path file{folder / "slope_depth.png"};

    Home() {
        write_depth_png(file, 64, 48, 100, 2);
        fs::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[panels]\nvideo = true\ntouch = false\ndevice = false\n");
    }
    [[nodiscard]] DepthStatement kept() const {
        return with_kept_choice({.find_out = true, .kept_in = folder / "config/dibhr/depth"}, file)
            .panel;
    }
    /// Once that is kept, which takes as long as opening the file again.
    [[nodiscard]] bool comes_to_keep(const DepthStatement& wanted) const {
        const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!(kept() == wanted) && std::chrono::steady_clock::now() < latest)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return kept() == wanted;
    }
    [[nodiscard]] Process view(const Desk& desk) const {
        return desk.start_viewer(folder, {"slope_depth.png", "--depth-unit", "mm", "--device",
                                          "mouse", "--size", "1280x800", "--seconds", "60"});
    }
};

std::string click(int x, int y) {
    return "mousemove " + std::to_string(x) + " " + std::to_string(y) +
           " sleep 0.2 mousedown 1 sleep 0.2 mouseup 1 sleep 0.4 ";
}

const std::string kOpenRows = click(998, 185);
const std::string kChooseTrueShape = click(1160, 366) + click(1100, 426) + "sleep 1 ";
const std::string kTypeView =
    click(1160, 389) + "key --delay 60 6 0 d e g sleep 0.2 keydown Return sleep 0.2 keyup Return ";
const std::string kDragColour =
    "mousemove 1110 412 sleep 0.2 mousedown 1 sleep 0.2 mousemove 1130 412 sleep 0.2 mousemove "
    "1150 412 sleep 0.3 mouseup 1 sleep 0.4 ";
const std::string kTakeViewBack = click(1258, 389);
const std::string kSaveSidecar = click(1005, 412);

}  // namespace

TEST_CASE("what is said on the Depth rows is kept for that file until it is taken back",
          "[depth_rows]") {
    const Desk desk;
    const Home home;
    const DepthStatement view{.intrinsics = Intrinsics{.field_of_view_deg = 60.0}};
    {
        Process viewer = home.view(desk);
        desk.act(kMeet + kOpenRows + kTypeView);
        CHECK(home.comes_to_keep(view));
        desk.act("key ctrl+q");
        REQUIRE(viewer.wait() == 0);
    }
    Process viewer = home.view(desk);
    desk.act(kMeet + kOpenRows);
    CHECK(home.kept() == view);
    desk.act(kTakeViewBack);
    CHECK(home.comes_to_keep({}));
    desk.act("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    CHECK_FALSE(fs::exists(sidecar_of(home.file)));
}

TEST_CASE("a choice that cannot be is not kept, and a sidecar takes the place of what is",
          "[depth_rows]") {
    const Desk desk;
    const Home home;
    Process viewer = home.view(desk);
    desk.act(kMeet + kOpenRows + kChooseTrueShape + "key Escape sleep 0.3");
    CHECK(home.kept() == DepthStatement{});  // no camera is known
    desk.act(kTypeView);
    CHECK(home.comes_to_keep({.intrinsics = Intrinsics{.field_of_view_deg = 60.0}}));
    desk.act(kChooseTrueShape);
    const DepthStatement chosen{.geometry = Geometry::true_shape,
                                .intrinsics = Intrinsics{.field_of_view_deg = 60.0}};
    CHECK(home.comes_to_keep(chosen));
    desk.act(kSaveSidecar);
    CHECK(home.comes_to_keep({}));
    desk.act("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    const auto sidecar = read_sidecar(home.file);
    REQUIRE(sidecar);
    CHECK(sidecar->geometry == Geometry::true_shape);
    CHECK(sidecar->intrinsics == in_pixels(*chosen.intrinsics, 64, 48));
}

TEST_CASE("colour is dragged over the depth, and lies there for that file", "[depth_rows]") {
    const Desk desk;
    const Home home;
    write_depth_png(home.folder / "slope_color.png", 64, 48, 100, 2);
    Process viewer = desk.start_viewer(
        home.folder, {"slope_color.png", "slope_depth.png", "--depth-unit", "mm", "--device",
                      "mouse", "--size", "1280x800", "--seconds", "60"});
    desk.act(kMeet + kOpenRows + kDragColour);
    CHECK(home.comes_to_keep({.registration = Registration{10.0, 0.0, 1.0}}));
    desk.act("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
}
