// Lists of pictures with times, as TUM's benchmark has them.
#include "core/video/sources/layouts/picture_lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// Colour 1 to 4 every 33 ms, depth 1 to 4 a little later, as TUM's folders have them.
void write_tum(const fs::path& folder) {
    for (int number = 1; number <= 4; ++number) {
        write_colour(folder / "rgb" / (std::to_string(number) + ".png"), number);
        write_depth(folder / "depth" / (std::to_string(number) + ".png"), number);
    }
    write_text(folder / "rgb.txt",
               "# color images\n# file: 'x.bag'\n"
               "1305031102.175304 rgb/1.png\n1305031102.211214 rgb/2.png\n"
               "1305031102.243211 rgb/3.png\n1305031102.275326 rgb/4.png\n");
    write_text(folder / "depth.txt",
               "# depth maps\n"
               "1305031102.160407 depth/1.png\n1305031102.194330 depth/2.png\n"
               "1305031102.226738 depth/3.png\n1305031102.262886 depth/4.png\n");
}

SourceFacts depth_facts(const fs::path& place) {
    return open_picture_source(place, PictureRole::depth)->facts();
}

}  // namespace

TEST_CASE("TUM's lists pair each depth picture with the nearest of colour, at the times given",
          "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    const bool by_lists = GENERATE(false, true);
    const auto media =
        by_lists ? open_media(folder / "rgb.txt", folder / "depth.txt") : open_media(folder.path());
    const auto shown = all_of(*media);
    REQUIRE(shown.size() == 4);
    // Depth 2 is 19.0 ms after colour 1 and 16.9 ms before colour 2.
    const std::vector<Shown> wanted{
        {1, 1, 0.0}, {2, 2, 0.033923}, {3, 2, 0.066331}, {4, 4, 0.102479}};
    for (std::size_t k = 0; k < shown.size(); ++k) {
        CAPTURE(k);
        CHECK(shown[k].depth == wanted[k].depth);
        CHECK(shown[k].colour == wanted[k].colour);
        CHECK(std::abs(shown[k].time_s - wanted[k].time_s) < 1e-6);
    }
    CHECK(media->description().notice.empty());
}

TEST_CASE("a list of associated pictures goes by its depth times, whichever kind is first",
          "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    const bool depth_first = GENERATE(false, true);
    write_text(folder / "associations.txt",
               depth_first ? "10.0 depth/1.png 10.01 rgb/3.png\n10.5 depth/2.png 10.49 rgb/4.png\n"
                           : "10.01 rgb/3.png 10.0 depth/1.png\r\n10.49 rgb/4.png 10.5 "
                             "depth/2.png\r\n");
    const fs::path place = GENERATE(fs::path("."), fs::path("associations.txt"));
    const auto shown = all_of(*open_media(folder.path() / place));
    REQUIRE(shown.size() == 2);
    CHECK(shown[0].depth == 1);
    CHECK(shown[0].colour == 3);
    CHECK(shown[1].depth == 2);
    CHECK(shown[1].colour == 4);
    CHECK(std::abs(shown[1].time_s - 0.5) < 1e-9);
}

TEST_CASE("a list finds its partner by its name, and one of depth stands alone", "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    CHECK(all_of(*open_media(folder / "rgb.txt")).size() == 4);
    const auto alone = all_of(*open_depth(folder / "depth.txt"));
    REQUIRE(alone.size() == 4);
    CHECK(alone.back().depth == 4);
    CHECK(alone.back().colour == -1);
    CHECK(all_of(*open_depth(folder.path())).size() == 4);
    CHECK(describe_media(folder / "rgb.txt").colour_columns == 20);
}

TEST_CASE("TUM's lists say metres of 1/5000, 0 for no data, and which camera it was", "[lists]") {
    const TemporaryFolder folder;
    const fs::path sequence = folder / "rgbd_dataset_freiburg3_long_office";
    write_tum(sequence);
    CHECK_FALSE(stated_by(depth_facts(sequence)).intrinsics);  // of pictures of another size
    for (int number = 1; number <= 4; ++number)
        write_depth(sequence / "depth" / (std::to_string(number) + ".png"), number, 640, 480);
    const SourceFacts facts = depth_facts(sequence);
    CHECK(stated_by(facts).unit == DepthUnit::m);
    CHECK(stated_by(facts).scale == 0.0002);
    CHECK(stated_by(facts).no_data == std::vector<double>{0.0});
    CHECK(stated_by(facts).intrinsics == Intrinsics{535.4, 539.2, 320.1, 247.6});
    CHECK(origins_of(facts.findings) == "TUM lists");
    CHECK_FALSE(stated_by(facts).near);
}

TEST_CASE("lists whose depth all is too near for TUM's camera may be in millimetres", "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    const int nearest = GENERATE(1600, 5000);
    for (int number = 1; number <= 4; ++number)
        write_picture(folder / "depth" / (std::to_string(number) + ".png"), 64, 48, 16, 1,
                      [=](int i, int j, int) { return nearest + 30 * i + 20 * j; });
    const MediaDescription media = open_depth(folder.path(), {.find_out = true})->description();
    const auto& answers = media.conclusion.alternatives;
    const auto offers = [&](double millimetres) {
        return std::any_of(answers.begin(), answers.end(), [=](const DepthAlternative& answer) {
            return state_same_values(answer.statement,
                                     {.unit = DepthUnit::mm, .scale = millimetres});
        });
    };
    CHECK(offers(1.0) == (nearest == 1600));
    CHECK(offers(0.2) == (nearest == 1600));
    CHECK(answers.empty() == (nearest == 5000));
}

TEST_CASE("numbers without a point are frames, thirty a second", "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    write_text(folder / "associations.txt",
               "1 depth/1.png 1 rgb/1.png\n2 depth/2.png 2 rgb/2.png\n4 depth/4.png 4 rgb/4.png\n");
    const auto shown = all_of(*open_media(folder.path()));
    REQUIRE(shown.size() == 3);
    CHECK(std::abs(shown[2].time_s - 2.0 / 30.0) < 1e-9);
}

TEST_CASE("lines without a picture, missing pictures and repeated times are passed over and told",
          "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    write_text(folder / "depth.txt",
               "\xef\xbb\xbf"
               "0.3 depth/3.png\n"
               "0.1\n"
               "depth/1.png\n"
               "nan depth/1.png\n"
               "inf depth/1.png\n"
               "1e300 depth/1.png\n"
               "0.4 depth/lost.png\n"
               "0.5 ../nowhere/lost.png\n"
               "0.3 depth/4.png\n"
               "\n"
               "0.2, depth/2.png\n");
    const auto media = open_depth(folder.path());
    const auto shown = all_of(*media);
    REQUIRE(shown.size() == 2);  // in order of time
    CHECK(shown[0].depth == 2);
    CHECK(shown[1].depth == 3);
    CHECK(std::abs(shown[1].time_s - 0.1) < 1e-9);
    const std::string told = media->description().notice;
    CHECK(contains(told, "5 lines"));
    CHECK(contains(told, "2 missing pictures (the first: 'depth/lost.png')"));
    CHECK(contains(told, "1 pictures with the time"));
    CHECK(told.find('\n') == std::string::npos);
}

TEST_CASE("a list may name pictures anywhere, with spaces and quotes in their names", "[lists]") {
    const TemporaryFolder folder;
    write_depth(folder / "elsewhere/it's the \"first\" 1.png", 1);
    fs::create_directories(folder / "lists");
    write_text(folder / "lists/depth.txt",
               "0.5 ../elsewhere/it's the \"first\" 1.png\n0.7 " +
                   (folder / "elsewhere/it's the \"first\" 1.png").string() + "\n");
    CHECK(all_of(*open_depth(folder / "lists/depth.txt")).size() == 2);
}

TEST_CASE("a list of nothing that is there says so in one line", "[lists]") {
    const TemporaryFolder folder;
    write_text(folder / "depth.txt", "0.1 depth/1.png\n0.2 depth/2.png\n");
    const std::string said = refusal([&] { (void)open_depth(folder / "depth.txt"); });
    CHECK(contains(said, "names no picture that is there"));
    CHECK(contains(said, "'depth/1.png'"));
    CHECK(refusal([&] { (void)open_depth(folder.path()); }) == said);
}

TEST_CASE("times that are years apart are no times of a video", "[lists]") {
    const TemporaryFolder folder;
    write_tum(folder.path());
    write_text(folder / "depth.txt", "0.5 depth/1.png\n1305031102.5 depth/2.png\n");
    CHECK(contains(refusal([&] { (void)open_depth(folder.path()); }), "s apart"));
}

TEST_CASE("other text, and bytes that are none, are no lists", "[lists]") {
    const TemporaryFolder folder;
    write_text(folder / "groundtruth.txt", "# t x y z\n0.1 0.2 0.3 0.4\n0.2 0.3 0.4 0.5\n");
    write_text(folder / "depth.txt", "some notes on 3 pictures: depth 1.png\n");
    CHECK(contains(refusal([&] { (void)open_depth(folder / "groundtruth.txt"); }), "text"));
    CHECK(contains(refusal([&] { (void)open_depth(folder / "depth.txt"); }), "text"));
    std::string bytes(5000, '\0');
    for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<char>(k * k % 251);
    write_text(folder / "garbage.txt", "0.1 depth/1.png\n" + bytes);
    CHECK_FALSE(is_picture_list(folder / "garbage.txt"));
    CHECK_FALSE(is_picture_list(folder / "missing.txt"));
    CHECK_FALSE(is_picture_list(folder.path()));
}

TEST_CASE("a list of a hundred thousand lines is read", "[lists]") {
    constexpr int kLines = 100'000;
    const TemporaryFolder folder;
    write_tum(folder.path());
    std::string text;
    for (int line = 0; line < kLines; ++line) {
        text += std::to_string(line) + ".5 ";
        text += line % (kLines / 2) == 0 ? "depth/1.png\n" : "depth/lost.png\n";
    }
    write_text(folder / "depth.txt", text);
    const auto media = open_depth(folder.path());
    CHECK(media->description().frames == 2);
    CHECK(contains(media->description().notice, std::to_string(kLines - 2) + " missing"));
}
