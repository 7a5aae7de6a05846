// Named regions in the window: shown where they are touched, their outlines felt and replayed.
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/session/session.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/sources/picture_files.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* kSize = "640x480";
constexpr int kWide = 160;
constexpr int kHigh = 120;
/// Over the relief, which is left of the panels: in its left and in its right half.
constexpr const char* kLeft = "mousemove 100 240";
constexpr const char* kRight = "mousemove 240 240";

/// Level 1 in the left half, 2 in the right one.
void write_halves(const fs::path& file) {
    ColourImage picture{kWide, kHigh, {}};
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            picture.rgb.insert(picture.rgb.end(), 3,
                               static_cast<std::uint8_t>(i < kWide / 2 ? 1 : 2));
    write_png(picture, file);
}

/// How many versions of maps a session holds.
int versions_of_maps(const fs::path& file) {
    const Session session(file);
    int count = 0;
    constexpr std::uint32_t kMore = 200;
    for (std::uint32_t version = 1; version < kMore; ++version)
        count += session.maps_of(version).empty() ? 0 : 1;
    return count;
}

/// A level wall of which the left half is a cup, and the right half a table without a text.
void write_cup(const TemporaryFolder& folder) {
    write_depth_png(folder / "cup_depth.png", kWide, kHigh, 120);
    write_text(folder / "cup_regions.toml",
               "[[region]]\nlevel = 1\nname = \"Cup\"\ntext = \"A blue cup.\"\n"
               "[[region]]\nlevel = 2\nname = \"Table\"\n");
    write_halves(folder / "cup_regions.png");
}

std::vector<std::string> cup_options(std::initializer_list<const char*> more = {}) {
    std::vector<std::string> options{"cup_depth.png", "--raw-depth", "--device", "mouse",
                                     "--no-sync",     "--size",      kSize};
    options.insert(options.end(), more.begin(), more.end());
    return options;
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
