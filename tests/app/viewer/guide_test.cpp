// Named regions in the window: shown where they are touched, their outlines felt and replayed.
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/session/session.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/two_halves.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// How many versions of maps a session holds.
int versions_of_maps(const fs::path& file) {
    const Session session(file);
    int count = 0;
    constexpr std::uint32_t kMore = 200;
    for (std::uint32_t version = 1; version < kMore; ++version)
        count += session.maps_of(version).empty() ? 0 : 1;
    return count;
}

}  // namespace

TEST_CASE("the region under the finger is named and its text follows when the finger rests",
          "[guide]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    WindowProgram viewer = desk.start_viewer(folder, cup_options());
    viewer.wait_for_surface();
    CHECK(viewer.seen().regions == 2);
    viewer.act(kLeft);
    CHECK(viewer.seen().region.str().empty());  // nothing is touched
    viewer.act("mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.region.str() == "Cup"; });
    viewer.wait_until([](const Seen& now) { return now.region_text; });
    viewer.act(kRight);
    viewer.wait_until([](const Seen& now) { return now.region.str() == "Table"; });
    viewer.act("mouseup 1");
    viewer.wait_until([](const Seen& now) { return now.region.str().empty(); });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("a replay names the region that was touched", "[guide]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    WindowProgram viewer = desk.start_viewer(folder, cup_options({"--record", "a.dibhr"}));
    viewer.wait_for_surface();
    viewer.act(std::string(kLeft) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.region.str() == "Cup"; });
    viewer.wait_until([rows = viewer.seen().recorded_rows](const Seen& now) {
        return now.contact && now.recorded_rows > rows + 500;
    });
    desk.press("mouseup 1 key q");
    REQUIRE(viewer.wait() == 0);
    WindowProgram replay = desk.start_viewer(folder, {"a.dibhr", "--size", kSize});
    replay.wait_until([](const Seen& now) { return now.replays && now.region.str() == "Cup"; });
    desk.press("key q");
    REQUIRE(replay.wait() == 0);
}

TEST_CASE("captions beside a recording are shown in their time", "[guide]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    write_text(folder / "cup.vtt", "WEBVTT\n\n00:00.000 --> 00:05.000\nA cup on a table\n");
    WindowProgram viewer = desk.start_viewer(folder, cup_options());
    viewer.wait_for_surface();
    viewer.wait_until([](const Seen& now) { return now.caption.str() == "A cup on a table"; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("regions that cannot be read are told and the recording is touched without them",
          "[guide]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_cup(folder);
    write_text(folder / "cup_regions.toml", "[[region]]\nlevel = 1\n");
    WindowProgram viewer = desk.start_viewer(folder, cup_options());
    viewer.wait_for_surface();
    CHECK(contains(viewer.seen().message.str(), "cup_regions.toml"));
    CHECK(viewer.seen().regions == 0);
    viewer.act("key Escape");
    viewer.act(std::string(kLeft) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    viewer.act("mouseup 1");
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("outlines that move with the sample are felt as ridges and replayed to the same bits",
          "[guide]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer =
        desk.start_viewer(folder, {"--device", "mouse", "--no-sync", "--size", kSize, "--outlines",
                                   "on", "--record", "a.dibhr"});
    viewer.wait_for_surface();
    CHECK(viewer.seen().regions == 12);
    viewer.act("mousemove 150 240 mousedown 1");
    const double begun_s = viewer.seen().media_s;
    viewer.wait_until([begun_s](const Seen& now) {
        return now.media_s > begun_s + 1.0 || now.media_s < begun_s;
    });
    viewer.act("mouseup 1");
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(versions_of_maps(folder / "a.dibhr") >= 3);
    require_same_bits(folder, folder / "a.dibhr");
}
