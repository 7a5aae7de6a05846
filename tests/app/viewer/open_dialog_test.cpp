// The window's own dialog: folders that are recordings, previews, the filter, and the keyboard.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/viewer/browsing/recording_folders.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

/// A folder of colour and depth pictures, one that is none, and a pair of videos.
void make_recordings(const TemporaryFolder& folder) {
    for (const char* const name : {"take/rgb", "take/depth", "notes"})
        fs::create_directories(folder / name);
    std::ofstream(folder / "notes/read.txt") << "nothing to feel";
    std::ofstream(folder / "list.txt") << "nothing to open";
    run_shell(folder,
              "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=s=64x48:r=10:d=1 -f lavfi -i "
              "\"nullsrc=s=64x48:r=10:d=1,format=gray,geq=lum='110+40*sin(X/12)'\" "
              "-map 0 take/rgb/%03d.png -map 1 take/depth/%03d.png "
              "-map 0 -c:v ffv1 wave_color.mkv -map 1 -c:v ffv1 wave_depth.mkv");
}

WindowProgram view_sample_here(const Desk& desk, const TemporaryFolder& folder) {
    return desk.start_viewer(folder, {"--device", "mouse", "--open-dialog", "window"});
}

void open_dialog(const WindowProgram& viewer) {
    viewer.wait_for_surface();
    viewer.act("key ctrl+o");
    viewer.wait_until([](const Seen& now) {
        return now.dialog_typing && !now.dialog_reads && now.dialog_entries > 0;
    });
}

void choose(const WindowProgram& viewer, const std::string& name) {
    for (int k = 0; k < 20; ++k) {
        if (viewer.seen().dialog_chosen.str().ends_with(name)) return;
        viewer.act("key Down");
        viewer.wait_for_turn();
    }
    FAIL("no entry is called " + name);
}

}  // namespace

TEST_CASE("a folder that is a recording is marked and opens and another one is entered",
          "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    viewer.wait_until([](const Seen& now) { return now.dialog_recordings == 1; });
    choose(viewer, "notes");
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) {
        return now.dialog_folder.str().ends_with("notes") && !now.dialog_reads;
    });
    CHECK(viewer.seen().dialog);
    viewer.act("key Escape key ctrl+o");
    viewer.wait_until([](const Seen& now) {
        return now.dialog_recordings == 1 && now.dialog_typing && !now.dialog_reads;
    });
    choose(viewer, "take");
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) {
        return !now.dialog && now.surface && now.file.str().ends_with("take");
    });
}

TEST_CASE("of a recording the folders beside those of its frames are counted", "[dialog]") {
    const TemporaryFolder folder;
    for (const char* const name : {"rgb", "depth", ".cache", "other", "third"})
        fs::create_directory(folder / name);
    CHECK(folders_beside_frames(folder.path()) == 2);
    CHECK(folders_beside_frames(folder / "rgb") == 0);
}

TEST_CASE("a folder that is a recording can be looked into by keyboard", "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    viewer.wait_until([](const Seen& now) { return now.dialog_recordings == 1; });
    choose(viewer, "take");
    for (int k = 0; k < 30 && viewer.seen().focus.str() != "Look inside"; ++k) {
        viewer.act("key Tab");
        viewer.wait_for_turn();
        viewer.wait_for_turn();
    }
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) {
        return now.dialog_folder.str().ends_with("take") && !now.dialog_reads;
    });
    CHECK(viewer.seen().dialog);
    viewer.act("key Escape");
    viewer.wait_until([](const Seen& now) { return !now.dialog; });
}

TEST_CASE("a typed path that is nothing keeps the dialog and opens no other entry", "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    viewer.wait_until([](const Seen& now) { return now.dialog_recordings == 1; });
    choose(viewer, "take");
    viewer.act("type ./tak key Return");
    viewer.wait_until([](const Seen& now) { return now.dialog_refuses && now.dialog_typing; });
    CHECK(viewer.seen().dialog);
    viewer.act("key ctrl+a type ./take key Return");
    viewer.wait_until([](const Seen& now) {
        return !now.dialog && now.surface && now.file.str().ends_with("take");
    });
}

TEST_CASE("a point of the ruler goes with the recording it was set on", "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    viewer.wait_for_surface();
    viewer.act("mousemove 450 400 key n");
    viewer.wait_until([](const Seen& now) { return now.ruler; });
    viewer.act("click 1");
    viewer.wait_until([](const Seen& now) { return now.ruler_points == 1; });
    open_dialog(viewer);
    viewer.wait_until([](const Seen& now) { return now.dialog_recordings == 1; });
    viewer.act("type take key Return");
    viewer.wait_until([](const Seen& now) {
        return now.surface && now.file.str().ends_with("take") && now.ruler_points == 0;
    });
    CHECK(viewer.seen().ruler);
}

TEST_CASE("the chosen entry shows its length and its size and a picture of its depth", "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    for (const char* const name : {"take", "wave_color.mkv"}) {
        choose(viewer, name);
        viewer.wait_until([](const Seen& now) { return now.preview_depth; });
        CHECK_THAT(viewer.seen().preview_text.str(), StartsWith("64 x 48\n"));
        CHECK_THAT(viewer.seen().preview_text.str(), Contains("10 frames"));
    }
}

TEST_CASE("a preview that hangs holds up neither the window nor the next one", "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    REQUIRE(::mkfifo((folder / "hang.mp4").c_str(), 0600) == 0);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    choose(viewer, "hang.mp4");
    const auto turn = viewer.seen().turn;
    viewer.wait_until([turn](const Seen& now) { return now.turn > turn + 30; });
    CHECK_FALSE(viewer.seen().preview_depth);
    choose(viewer, "wave_color.mkv");
    viewer.wait_until([](const Seen& now) { return now.preview_depth; });
    desk.press("key ctrl+q");
    viewer.wait();
}

TEST_CASE("what cannot be opened is listed on wish and the box is reached by keyboard",
          "[dialog]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_recordings(folder);
    WindowProgram viewer = view_sample_here(desk, folder);
    open_dialog(viewer);
    const auto before = viewer.seen().dialog_entries;
    for (int k = 0; k < 30 && viewer.seen().focus.str() != "All files"; ++k) {
        viewer.act("key Tab");
        viewer.wait_for_turn();
        viewer.wait_for_turn();
    }
    CHECK(viewer.seen().focus_value.str() == "off");
    viewer.act("key space");
    viewer.wait_until([before](const Seen& now) { return now.dialog_entries > before; });
}
