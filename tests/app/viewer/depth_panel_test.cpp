// The rows of the Video panel that say what depth means, under a synthetic pointer and keyboard.
#include <filesystem>
#include <string>

#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// A home folder whose settings open only the Video panel, so that its rows are near the top.
struct Home {
    TemporaryFolder folder{};
    fs::path file{folder / "slope_depth.png"};

    Home() {
        write_depth_png(file, 64, 48, 100, 2);
        write_depth_png(folder / "slope_color.png", 64, 48, 100, 2);
        fs::create_directories(folder / "config/dibhr");
        write_text(folder / "config/dibhr/settings.toml",
                   "[panels]\nvideo = true\ntouch = false\ndevice = false\n");
    }
    [[nodiscard]] DepthStatement kept() const {
        return with_kept_choice({.find_out = true, .kept_in = folder / "config/dibhr/depth"}, file)
            .panel;
    }
    /// A window in which the Depth rows stand open.
    [[nodiscard]] WindowProgram view(const Desk& desk) const {
        return desk.start_viewer(folder, {"slope_color.png", "slope_depth.png", "--depth-unit",
                                          "mm", "--device", "mouse", "--size", "640x560"});
    }
};

/// A hand on the rows, by mouse and keyboard.
class DepthRows {
  public:
    DepthRows(const Home& home, const WindowProgram& viewer) : home_(home), viewer_(viewer) {
        viewer_.wait_for_surface();
        click(395, 185);
    }

    void choose_true_shape() const {
        click(528, 366);
        click(490, 426);
    }
    void type_view() const {
        click(528, 389);
        viewer_.act("type 60deg key Return");
    }
    void take_view_back() const { click(608, 389); }
    void drag_colour() const {
        viewer_.act("mousemove 480 412 mousedown 1 mousemove 500 412 mousemove 520 412 mouseup 1");
    }
    void save_sidecar() const { click(415, 458); }

    /// Waits until the choice is saved, which takes as long as opening the file again.
    [[nodiscard]] bool come_to_keep(const DepthStatement& wanted) const {
        const bool kept = eventually([&] { return home_.kept() == wanted; });
        viewer_.wait_until([](const Seen& now) { return !now.opening; });
        return kept;
    }

  private:
    void click(int x, int y) const {
        viewer_.act("mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1");
    }

    const Home& home_;
    const WindowProgram& viewer_;
};

}  // namespace

TEST_CASE(
    "what is said on the Depth rows is kept for that file until it is taken back or a sidecar "
    "takes its place; what cannot be is not kept",
    "[depth_rows]") {
    const Desk desk;
    const Home home;
    DepthStatement wanted;
    {
        WindowProgram viewer = home.view(desk);
        const DepthRows rows(home, viewer);
        rows.choose_true_shape();  // no camera is known
        viewer.wait_until([](const Seen& now) { return !now.message.str().empty(); });
        viewer.act("key Escape");
        CHECK(viewer.seen().message.str().empty());
        CHECK(home.kept() == wanted);
        rows.drag_colour();
        wanted.registration = Registration{10.0, 0.0, 1.0};
        CHECK(rows.come_to_keep(wanted));
        rows.type_view();
        wanted.intrinsics = Intrinsics{.field_of_view_deg = 60.0};
        CHECK(rows.come_to_keep(wanted));
        desk.press("key ctrl+q");
        REQUIRE(viewer.wait() == 0);
    }
    WindowProgram viewer = home.view(desk);
    const DepthRows rows(home, viewer);
    CHECK(home.kept() == wanted);
    rows.take_view_back();
    CHECK(rows.come_to_keep({.registration = wanted.registration}));
    rows.type_view();
    CHECK(rows.come_to_keep(wanted));
    rows.choose_true_shape();
    wanted.geometry = Geometry::true_shape;
    CHECK(rows.come_to_keep(wanted));
    CHECK_FALSE(fs::exists(sidecar_of(home.file)));
    rows.save_sidecar();
    CHECK(rows.come_to_keep({}));
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    const auto sidecar = read_sidecar(home.file);
    REQUIRE(sidecar);
    CHECK(sidecar->geometry == Geometry::true_shape);
    CHECK(sidecar->intrinsics == in_pixels(*wanted.intrinsics, 64, 48));
    CHECK(sidecar->registration == wanted.registration);
}
