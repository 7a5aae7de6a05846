// The list of recent files, and typed paths.
#include "app/settings/recent_files.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

TEST_CASE("the last file opened is the first, twelve are kept, and none twice", "[recent]") {
    const TemporaryFolder folder;
    const fs::path history = folder / "state/dibhr/recent";
    CHECK(read_recent_files(history).empty());
    for (int k = 0; k < 20; ++k) {
        const std::string name = "/films/" + std::to_string(k);
        add_recent_file({name + " a.mp4", k % 2 == 0 ? fs::path{} : fs::path(name + " b.mp4")},
                        history);
    }
    add_recent_file({"/films/15 a.mp4", "/films/15 b.mp4"}, history);
    const std::vector<RecentFile> files = read_recent_files(history);
    REQUIRE(files.size() == 12);
    CHECK(files[0] == RecentFile{"/films/15 a.mp4", "/films/15 b.mp4"});
    CHECK(files[1] == RecentFile{"/films/19 a.mp4", "/films/19 b.mp4"});
    CHECK(files[2] == RecentFile{"/films/18 a.mp4", {}});
    CHECK(files[5] == RecentFile{"/films/14 a.mp4", {}});
    CHECK(names_in(folder / "state/dibhr") == std::vector<std::string>{"recent"});
}

TEST_CASE("paths are kept whole, and what a line cannot hold is not", "[recent]") {
    const TemporaryFolder folder;
    const fs::path history = folder / "recent";
    add_recent_file({"film.mp4", {}}, history);
    add_recent_file({"two\nlines.mp4", {}}, history);
    add_recent_file({"a\ttab.mp4", {}}, history);
    add_recent_file({}, history);
    const std::vector<RecentFile> files = read_recent_files(history);
    REQUIRE(files.size() == 1);
    CHECK(files[0].colour == fs::current_path() / "film.mp4");
    write_text(history, "no tab\n\t\n/a.mp4\t\n" + std::string(20000, 'x') + "\t\n");
    CHECK(read_recent_files(history) == std::vector<RecentFile>{{"/a.mp4", {}}});
}

TEST_CASE("a tilde is the home folder, and only at the beginning", "[recent]") {
    const char* const home = std::getenv("HOME");
    REQUIRE(home != nullptr);
    CHECK(expand_home("~/films/a.mp4") == fs::path(home) / "films/a.mp4");
    CHECK(expand_home("~") == fs::path(home));
    CHECK(expand_home("a~/b.mp4") == fs::path("a~/b.mp4"));
    CHECK(expand_home("~other/b.mp4") == fs::path("~other/b.mp4"));
}

TEST_CASE("a file opened before is opened again from the list of recent ones", "[window]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "first_depth.png", 64, 48, 100, 2);
    write_depth_png(folder / "next_depth.png", 32, 24, 100, 2);
    const fs::path history = folder / "state/dibhr/recent";
    add_recent_file({folder / "first_depth.png", {}}, history);
    WindowProgram viewer =
        desk.start_viewer(folder, {"next_depth.png", "--device", "mouse", "--size", "1280x800"});
    viewer.wait_for_surface();
    viewer.act("mousemove 1230 93 click 1 mousemove 1180 132 click 1");
    CHECK(eventually(
        [&] { return read_recent_files(history).at(0).colour.filename() == "first_depth.png"; }));
    desk.press("key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    const std::vector<RecentFile> files = read_recent_files(history);
    REQUIRE(files.size() == 2);
    CHECK(files[0].colour.filename() == "first_depth.png");
    CHECK(files[1].colour.filename() == "next_depth.png");
}
