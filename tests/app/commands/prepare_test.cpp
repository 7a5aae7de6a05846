// `dibhr prepare` as scripts use it.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

void put_film(const TemporaryFolder& folder) {
    const std::string noisy =
        "ffmpeg -nostdin -v error -f lavfi -i "
        "testsrc2=s=96x72:r=10:d=2,noise=alls=12:allf=t:all_seed=5";
    run_shell(folder, noisy + " -c:v ffv1 film_color.mkv && " + noisy +
                          ",format=gray -c:v ffv1 film_depth.mkv");
    std::string goals = "t,x,y,z\n";
    for (int k = 0; k < 1500; ++k)
        goals += std::to_string(0.001 * k) + "," + std::to_string(20 + 0.03 * k) + ",36,5\n";
    write_text(folder / "goals.csv", goals);
}

std::string done(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    const ProgramResult result = run_dibhr(folder, arguments);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    return result.output;
}

/// All columns but the time that an update took.
std::string touched(const TemporaryFolder& folder) {
    std::string rows;
    for (const std::string& line :
         split(done(folder, {"touch", "--depth", "film_depth.mkv", "--color", "film_color.mkv",
                             "--video", "--goals", "goals.csv", "--cleaning", "sensor"}),
               '\n'))
        rows += line.substr(0, line.rfind(',')) + "\n";
    return rows;
}

std::string surface(const TemporaryFolder& folder) {
    done(folder,
         {"surface", "film_color.mkv", "--time", "1.25", "--cleaning", "sensor", "--out", "s.pfm"});
    return read_text(folder / "s.pfm");
}

}  // namespace

TEST_CASE("what is prepared feels the same and is listed and emptied", "[prepare]") {
    const TemporaryFolder folder;
    put_film(folder);
    const std::string touched_before = touched(folder);
    const std::string surface_before = surface(folder);
    const std::vector<std::string> prepare{"prepare", "film_color.mkv", "--cleaning", "sensor"};
    CHECK(contains(done(folder, prepare), "20 frames prepared, "));
    CHECK(contains(done(folder, prepare), "20 frames prepared before"));
    CHECK(touched(folder) == touched_before);
    CHECK(surface(folder) == surface_before);
    const std::string listed = done(folder, {"prepare", "--list"});
    CHECK(contains(listed, "film_color.mkv: 20 frames of 96x72"));
    CHECK(contains(listed, "cleaning sensor"));

    SECTION("a damaged one is told in one line and changes no bit") {
        const std::vector<std::string> shows{"surface",    "film_color.mkv", "--time", "1.25",
                                             "--cleaning", "sensor",         "--out",  "s.pfm"};
        const std::size_t lines_before = split(run_dibhr(folder, shows).errors, '\n').size();
        run_shell(folder,
                  "f=$(find . -name surface -size +1k | head -1); n=$(stat -c %s $f); "
                  "dd if=/dev/zero of=$f bs=1 seek=$((n / 4)) count=$((n / 2)) "
                  "conv=notrunc status=none");
        const ProgramResult result = run_dibhr(folder, shows);
        CHECK(result.exit_code == 0);
        CHECK(contains(result.errors, "is damaged"));
        CHECK(split(result.errors, '\n').size() == lines_before + 1);
        CHECK(read_text(folder / "s.pfm") == surface_before);
    }
    SECTION("emptied is cleaned again") {
        CHECK(contains(done(folder, {"prepare", "--empty"}), "removed"));
        CHECK(contains(done(folder, {"prepare", "--list"}), "0 MB in"));
        CHECK(surface(folder) == surface_before);
    }
}

TEST_CASE("what cannot be prepared is one line", "[prepare]") {
    const TemporaryFolder folder;
    put_film(folder);
    const auto refused = [&](const std::vector<std::string>& arguments, int exit_code,
                             const std::string& words) {
        const ProgramResult result = run_dibhr(folder, arguments);
        INFO(result.errors);
        CHECK(result.exit_code == exit_code);
        CHECK(split(result.errors, '\n').size() == 2);
        CHECK(contains(result.errors, words));
    };
    refused({"prepare"}, 2, "RECORDING is required");
    refused({"prepare", "none.mkv"}, 1, "none.mkv");
    refused({"prepare", "a.mkv", "b.mkv", "--depth", "c.mkv"}, 2, "--depth is of one recording");
    refused({"prepare", "film_color.mkv", "--most", "0"}, 2, "--most");
}
