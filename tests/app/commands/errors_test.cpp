// Bad input ends with 1 and one line on stderr that names the file; nothing half-written remains.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr::test;

namespace {

struct BadInput {
    std::string what;  ///< of the test
    std::vector<std::string> arguments;
    std::string named;  ///< what the line has to name
};

void write_inputs(const TemporaryFolder& folder) {
    write_depth_png(folder / "depth.png", 16, 12, 100);
    std::filesystem::create_directory(folder / "nothing_here");
    write_depth_png(folder / "one.png", 1, 1, 100);
    write_text(folder / "text.mp4", "this is no video\n");
    write_text(folder / "empty.png", "");
    write_text(folder / "goals.csv", "t,x,y,z\n0,1,1,120\n0.001,1,1,90\n");
    write_text(folder / "nan.csv", "t,x,y,z\n0,1,1,120\n0.001,nan,1,90\n");
    write_text(folder / "column.csv", "t,x,y\n0,1,1\n");
    write_text(folder / "header.csv", "t,x,y,z\n");
    write_text(folder / "nothing.csv", "");
    write_text(folder / "falls.csv", "t,x,y,z\n1,1,1,120\n0.5,1,1,90\n");
}

std::vector<BadInput> bad_inputs() {
    const auto touch = [](const std::string& depth, const std::string& goals) {
        return std::vector<std::string>{"touch", "--depth", depth,    "--goals",
                                        goals,   "--out",   "out.csv"};
    };
    return {
        {"a missing depth file", touch("none.png", "goals.csv"), "none.png"},
        {"a folder without pictures", touch("nothing_here", "goals.csv"), "nothing_here"},
        {"text named .mp4", touch("text.mp4", "goals.csv"), "text.mp4"},
        {"an empty image", touch("empty.png", "goals.csv"), "empty.png"},
        {"a one-pixel image", touch("one.png", "goals.csv"), "one.png"},
        {"missing goals", touch("depth.png", "none.csv"), "none.csv"},
        {"goals with a NaN", touch("depth.png", "nan.csv"), "nan.csv"},
        {"goals without z", touch("depth.png", "column.csv"), "column.csv"},
        {"goals without rows", touch("depth.png", "header.csv"), "header.csv"},
        {"goals without anything", touch("depth.png", "nothing.csv"), "nothing.csv"},
        {"goals whose time falls", touch("depth.png", "falls.csv"), "falls.csv"},
        {"a missing bump map",
         {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--bump", "none.png", "--out",
          "out.csv"},
         "none.png"},
        {"an output folder that is not there",
         {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--out", "none/out.csv"},
         "none/out.csv"},
        {"an output that is a folder",
         {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--out", "."},
         "."},
        {"an output that is also read",
         {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--out", "./goals.csv"},
         "goals.csv"},
        {"a full disk",
         {"touch", "--depth", "depth.png", "--goals", "goals.csv", "--out", "/dev/full"},
         "/dev/full"},
        {"a missing file to view", {"none.mp4"}, "none.mp4"},
        {"text to view", {"view", "text.mp4", "depth.png"}, "text.mp4"},
        {"one-pixel images to view", {"one.png", "one.png"}, "one.png"},
        {"missing goals for the viewer",
         {"depth.png", "depth.png", "--device", "goals:none.csv"},
         "none.csv"},
        {"a missing file to describe", {"info", "none.mp4"}, "none.mp4"},
        {"a session that is none", {"info", "text.mp4"}, "text.mp4"},
    };
}

void check_one_line(const ProgramResult& result, const std::string& named) {
    CHECK(result.exit_code == 1);
    CHECK(result.output.empty());
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(result.errors.starts_with("dibhr: "));
    CHECK(result.errors.ends_with('\n'));
    CHECK(result.errors.find(named) != std::string::npos);
}

}  // namespace

TEST_CASE("bad input is told in one line that names the file, and leaves nothing", "[errors]") {
    const TemporaryFolder folder;
    write_inputs(folder);
    const std::vector<std::string> before = names_in(folder.path());
    for (const BadInput& bad : bad_inputs()) {
        const ProgramResult result = run_dibhr(folder, bad.arguments);
        INFO(bad.what << ": " << result.errors);
        check_one_line(result, bad.named);
        CHECK(names_in(folder.path()) == before);
    }
}

TEST_CASE("a failed run leaves an existing output as it was", "[errors]") {
    const TemporaryFolder folder;
    write_inputs(folder);
    write_text(folder / "out.csv", "of yesterday");
    const ProgramResult result = run_dibhr(
        folder, {"touch", "--depth", "depth.png", "--goals", "nan.csv", "--out", "out.csv"});
    CHECK(result.exit_code == 1);
    CHECK(read_text(folder / "out.csv") == "of yesterday");
}

TEST_CASE("a truncated video is refused in one line", "[errors]") {
    const TemporaryFolder folder;
    write_inputs(folder);
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i testsrc=size=160x120:rate=25:duration=2 "
              "-pix_fmt yuv420p -movflags faststart whole.mp4 && "
              "head -c $(($(stat -c %s whole.mp4) / 2)) whole.mp4 > depth.mp4");
    const ProgramResult result = run_dibhr(folder, {"touch", "--video", "--depth", "depth.mp4",
                                                    "--goals", "goals.csv", "--out", "out.csv"});
    INFO(result.errors);
    check_one_line(result, "depth.mp4");
    CHECK_FALSE(std::filesystem::exists(folder / "out.csv"));
}

TEST_CASE("where the picture codecs are not installed a picture but a PNG is refused in one line",
          "[errors]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    std::filesystem::copy_file(DIBHR_PROGRAM, folder / "alone");
    run_shell(folder,
              "ffmpeg -v error -i depth.png depth.tif && ./alone info depth.png > /dev/null && "
              "! ./alone info depth.tif > output.txt 2> errors.txt");
    CHECK(read_text(folder / "output.txt").empty());
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(std::count(errors.begin(), errors.end(), '\n') == 1);
    CHECK(contains(errors, "dibhr: a part of dibhr cannot be loaded: "));
    CHECK(contains(errors, "libdibhr_picture_codecs.so"));
    CHECK(contains(errors, "install dibhr again"));
}

TEST_CASE("an unreadable settings file is told and stays as it is", "[errors]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "depth.png", 16, 12, 100);
    std::filesystem::create_directory(folder / "dibhr");
    write_text(folder / "dibhr/settings.toml", "this = is = no toml");
    const ProgramResult result = run_dibhr(folder, {"view", "depth.png", "depth.png"});
    INFO(result.errors);
    check_one_line(result, "settings.toml");
    CHECK(read_text(folder / "dibhr/settings.toml") == "this = is = no toml");
}
