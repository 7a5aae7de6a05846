// Records a session for the tests of the Python module, into the current folder.
#include <filesystem>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr::test;

TEST_CASE("mine.dibhr: a second of touching, the last 50 ticks without a surface") {
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -v error -f lavfi -i testsrc2=size=120x90:rate=30:duration=0.5 "
              "-c:v ffv1 film_color.mkv");
    run_shell(folder, "ffmpeg -v error -i film_color.mkv -pix_fmt gray -c:v ffv1 film_depth.mkv");
    record_session(std::filesystem::current_path() / "mine.dibhr",
                   {.colour = folder / "film_color.mkv",
                    .depth = folder / "film_depth.mkv",
                    .ticks_without_surface = 50});
}
