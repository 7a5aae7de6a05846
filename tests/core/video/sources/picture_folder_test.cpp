// Folders of pictures: which belong together, in which order, and when each is shown.
#include "core/video/sources/media.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

TEST_CASE("colour and depth of a folder are told apart by name and go together by number",
          "[folder]") {
    const TemporaryFolder folder;
    const auto [colour, depth] =
        GENERATE(table<std::string, std::string>({{"rgb/%.png", "depth/%.png"},
                                                  {"color/%.png", "depth/%.png"},
                                                  {"frame-000%.color.png", "frame-000%.depth.png"},
                                                  {"Colour_%.png", "Depth_%.png"},
                                                  {"%_rgb.png", "%_depth_mm.png"}}));
    CAPTURE(colour, depth);
    const auto named = [&](std::string pattern, int number) {
        return folder / pattern.replace(pattern.find('%'), 1, std::to_string(number));
    };
    // As text 100 comes before 97; colour lacks one, and there is a gap of forty.
    for (const int number : {97, 98, 99, 100, 141}) {
        write_depth(named(depth, number), number);
        if (number != 99) write_colour(named(colour, number), number);
    }
    write_text(folder / "notes.txt", "no picture");
    write_text(folder / ".hidden.png", "no picture");
    const auto media = open_media(folder.path());
    const auto shown = all_of(*media);
    REQUIRE(shown.size() == 5);
    const std::vector<Shown> wanted{
        {97, 97, 0.0}, {98, 98, 1.0}, {99, 98, 2.0}, {100, 100, 3.0}, {141, 141, 4.0}};
    for (std::size_t k = 0; k < shown.size(); ++k) {
        CHECK(shown[k].depth == wanted[k].depth);
        CHECK(shown[k].colour == wanted[k].colour);
        CHECK(std::abs(shown[k].time_s - wanted[k].time_s / 30.0) < 1e-9);
    }
    CHECK(media->description().depth_bits == 16);
    CHECK(media->description().frames == 5);
    CHECK(media->description().frames_exact);
    const MediaDescription told = describe_media(folder.path());
    CHECK(told.colour_columns == 20);
    CHECK(told.depth_columns == 16);
}

TEST_CASE("names that are seconds tell when a picture is shown", "[folder]") {
    const TemporaryFolder folder;
    int number = 1;
    for (const char* const seconds :
         {"1305031102.160407", "1305031102.194330", "1305031102.294330"})
        write_depth(folder / "depth" / (std::string(seconds) + ".png"), number++);
    number = 1;
    for (const char* const seconds : {"1305031102.175304", "1305031102.275326"})
        write_colour(folder / "rgb" / (std::string(seconds) + ".png"), number++);
    const auto shown = all_of(*open_media(folder / "rgb", folder / "depth"));
    REQUIRE(shown.size() == 3);
    CHECK(std::abs(shown[1].time_s - 0.033923) < 1e-6);
    CHECK(std::abs(shown[2].time_s - 0.133923) < 1e-6);
    CHECK(shown[0].colour == 1);
    CHECK(shown[1].colour == 1);
    CHECK(shown[2].colour == 2);
}

TEST_CASE("a folder of colour finds the folder of depth beside it, a folder of depth stands alone",
          "[folder]") {
    const TemporaryFolder folder;
    for (int number = 1; number < 4; ++number) {
        write_depth(folder / "my_depth" / (std::to_string(number) + ".png"), number);
        write_colour(folder / "my_rgb" / (std::to_string(number) + ".png"), number);
    }
    CHECK(all_of(*open_media(folder / "my_rgb")).back().colour == 3);
    const auto depth = all_of(*open_depth(folder / "my_depth"));
    REQUIRE(depth.size() == 3);
    CHECK(depth.back().depth == 3);
    CHECK(depth.back().colour == -1);
}

TEST_CASE("a seek in a folder gives the picture that is shown then", "[folder]") {
    const TemporaryFolder folder;
    for (int number = 0; number < 30; ++number)
        write_depth(folder / (std::to_string(number) + ".png"), number);
    const auto media = open_depth(folder.path());
    for (const int number : {17, 3, 29, 0, 12}) {
        media->seek((number + 0.4) / 30.0);
        CHECK(media->next()->depth.at(2, 2) == 100.0F * static_cast<float>(number));
    }
    media->seek(99.0);
    CHECK(media->next()->depth.at(2, 2) == 2900.0F);
    CHECK_FALSE(media->next());
    media->seek(-1.0);
    CHECK(media->next()->depth.at(2, 2) == 0.0F);
}

TEST_CASE("a picture that cannot be read is told, and the one before it stays", "[folder]") {
    const TemporaryFolder folder;
    for (const int number : {1, 2, 4})
        write_depth(folder / (std::to_string(number) + ".png"), number);
    write_text(folder / "3.png", "broken");
    const auto media = open_depth(folder.path());
    const auto shown = all_of(*media);
    REQUIRE(shown.size() == 4);
    CHECK(shown[2].depth == 2);
    CHECK(shown[3].depth == 4);
    CHECK(contains(media->description().trouble, "3.png"));
}

TEST_CASE("pictures of other sizes and bits on the way become as the first", "[folder]") {
    const TemporaryFolder folder;
    write_depth(folder / "1.png", 200);
    write_picture(folder / "2.png", 8, 6, 8, 1, [](int, int, int) { return 51; });
    const auto media = open_depth(folder.path());
    (void)media->next();
    const auto second = media->next();
    REQUIRE(second);
    CHECK(second->depth.columns == 16);
    CHECK(second->depth.highest_level == 65535.0);
    CHECK(second->depth.at(3, 3) == 51.0F * 257.0F);
}

TEST_CASE("a folder without pictures, or with one kind only, says what to do", "[folder]") {
    const TemporaryFolder folder;
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "folder without pictures"));
    CHECK(contains(refusal([&] { (void)open_depth(folder.path()); }), "folder without pictures"));
    write_colour(folder / "rgb/1.png", 1);
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "depth"));
}
