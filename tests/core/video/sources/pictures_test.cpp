// Bump maps are normalised; pictures are written whole or not at all.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <opencv2/core.hpp>
#include <string>

#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

ColourImage gradient() {
    ColourImage picture{31, 17, {}};
    for (int k = 0; k < 31 * 17 * 3; ++k) picture.rgb.push_back(static_cast<std::uint8_t>(k * 7));
    return picture;
}

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), {});
}

}  // namespace

TEST_CASE("a bump map reaches from 0 to 1, whatever levels the image uses", "[pictures]") {
    const TemporaryFolder folder;
    const auto [bits, lowest, step] =
        GENERATE(table<int, int, int>({{8, 50, 1}, {8, 0, 5}, {16, 20000, 300}}));
    CAPTURE(bits, lowest);
    write_picture(folder / "bump.png", 50, 4, bits, 1,
                  [lowest = lowest, step = step](int i, int, int) { return lowest + step * i; });
    const BumpMap bump = read_bump_map(folder / "bump.png");
    REQUIRE(bump.columns == 50);
    REQUIRE(bump.rows == 4);
    REQUIRE(bump.heights.size() == 200);
    for (int i = 0; i < 50; ++i)
        CHECK_THAT(bump.heights[static_cast<std::size_t>(i)], WithinAbs(i / 49.0, 1e-6));
}

TEST_CASE("a flat bump map has no height", "[pictures]") {
    const TemporaryFolder folder;
    write_picture(folder / "flat.png", 8, 8, 8, 3, [](int, int, int) { return 90; });
    const BumpMap bump = read_bump_map(folder / "flat.png");
    CHECK(std::count(bump.heights.begin(), bump.heights.end(), 0.0F) == 64);
}

TEST_CASE("a bump map that is missing, or one pixel, is refused by name", "[pictures]") {
    const TemporaryFolder folder;
    write_picture(folder / "dot.png", 1, 1, 8, 1, [](int, int, int) { return 1; });
    const std::string name = GENERATE("dot.png", "missing.png");
    CHECK(refusal([&] { (void)read_bump_map(folder / name); }).find(name) != std::string::npos);
}

TEST_CASE("a written picture reads back with the same colours", "[pictures]") {
    const TemporaryFolder folder;
    const ColourImage picture = gradient();
    write_png(picture, folder / "rgb.png");
    write_picture(folder / "depth.png", 4, 4, 8, 1, [](int, int, int) { return 1; });
    const auto frame = open_media(folder / "rgb.png")->next();
    REQUIRE(frame);
    CHECK(frame->colour.columns == 31);
    CHECK(frame->colour.rgb == picture.rgb);
    CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("writing over a picture replaces it", "[pictures]") {
    const TemporaryFolder folder;
    write_text(folder / "shot.png", "old");
    write_png(gradient(), folder / "shot.png");
    CHECK(describe_media(folder / "shot.png").colour_columns == 31);
}

TEST_CASE("a picture that cannot be written is refused by name and leaves nothing behind",
          "[pictures]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "taken.png" / "in");
    const std::string missing =
        refusal([&] { write_png(gradient(), folder.path() / "absent" / "shot.png"); });
    CHECK(missing.find("shot.png") != std::string::npos);
    const std::string taken = refusal([&] { write_png(gradient(), folder / "taken.png"); });
    CHECK(taken.find("taken.png") != std::string::npos);
    CHECK(files_in(folder.path()) == 1);
    CHECK_FALSE(refusal([&] { write_png({}, folder / "empty.png"); }).empty());
}

TEST_CASE("a picture in text is read, also without a blank after its last level", "[pictures]") {
    const TemporaryFolder folder;
    write_text(folder / "levels.pgm",
               std::string("P2\n3 2\n5000\n0 10 20\n30 40 5000") + GENERATE("", "\n"));
    const StillPicture still = read_still(folder / "levels.pgm", PictureRole::depth);
    REQUIRE(still.picture.type() == CV_16UC1);
    CHECK(still.picture.at<std::uint16_t>(0, 2) == 20);
    CHECK(still.picture.at<std::uint16_t>(1, 2) == 5000);
    write_text(folder / "part.pgm", "P2\n3 2\n5000\n0 10 20\n30");
    CHECK(refusal([&] {
              (void)read_still(folder / "part.pgm", PictureRole::depth);
          }).find("damaged") != std::string::npos);
}
