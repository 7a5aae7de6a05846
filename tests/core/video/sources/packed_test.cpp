// Colour and depth in halves of one picture are opened as two sources that belong together.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>

#include "core/video/sources/packed.hpp"
#include "core/video/sources/paired_media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

PackedForm form_of(DepthPacking packing) {
    PackedForm form;
    form.packing = packing;
    return form;
}

cv::Mat packed_as(DepthPacking packing, const cv::Mat& colour, const cv::Mat& depth) {
    switch (packing) {
        case DepthPacking::right_left:
            return beside(depth, colour);
        case DepthPacking::top_bottom:
            return above(colour, depth);
        case DepthPacking::bottom_top:
            return above(depth, colour);
        default:
            return beside(colour, depth);
    }
}

double worst_difference(const cv::Mat& a, const cv::Mat& b) {
    return cv::norm(a, b, cv::NORM_INF);
}

/// A still of the picture as a video of two frames.
std::filesystem::path clip_of(const TemporaryFolder& folder, const cv::Mat& picture,
                              const std::string& name, const std::string& encoding) {
    cv::imwrite((folder / "still.png").string(), picture);
    ffmpeg("-loop 1 -i '" + (folder / "still.png").string() + "' -frames:v 2 " + encoding + " '" +
           (folder / name).string() + "'");
    return folder / name;
}

}  // namespace

TEST_CASE("each half of a packed picture is a picture of its own, colour and depth", "[packed]") {
    const TemporaryFolder folder;
    const DepthPacking packing = GENERATE(DepthPacking::left_right, DepthPacking::right_left,
                                          DepthPacking::top_bottom, DepthPacking::bottom_top);
    CAPTURE(name_of(packing));
    const cv::Mat colour = scene_photo();
    const cv::Mat depth = painted(scene_depth(), as_grey);
    cv::imwrite((folder / "both.png").string(), packed_as(packing, colour, depth));
    const Sources sources = open_packed(folder / "both.png", form_of(packing));
    CHECK(sources.colour->facts().columns == kSceneColumns);
    CHECK(sources.depth->facts().columns == kSceneColumns);
    CHECK(sources.depth->facts().rows == kSceneRows);
    CHECK(sources.depth->facts().still);
    CHECK(worst_difference(sources.colour->next()->picture, colour) == 0.0);
    CHECK(worst_difference(sources.depth->next()->picture, depth) == 0.0);
    CHECK_FALSE(sources.depth->next());
}

TEST_CASE("the line in the middle of a packed picture of an odd size belongs to no half",
          "[packed]") {
    const TemporaryFolder folder;
    const auto [columns, rows] = GENERATE(table<int, int>({{5, 2}, {9, 7}, {4, 3}}));
    CAPTURE(columns, rows);
    write_picture(folder / "odd.png", columns, rows, 8, 3,
                  [](int i, int j, int) { return 10 * i + j; });
    const Sources sources = open_packed(folder / "odd.png", form_of(DepthPacking::left_right));
    const cv::Mat left = sources.colour->next()->picture;
    const cv::Mat right = sources.depth->next()->picture;
    REQUIRE(left.size() == cv::Size(columns / 2, rows));
    REQUIRE(right.size() == left.size());
    CHECK(left.at<cv::Vec3b>(1, 0)[0] == 1);
    CHECK(right.at<cv::Vec3b>(1, right.cols - 1)[0] == 10 * (columns - 1) + 1);
}

TEST_CASE("halves too small to touch are refused", "[packed]") {
    const TemporaryFolder folder;
    const auto [columns, rows] = GENERATE(table<int, int>({{2, 8}, {3, 8}, {8, 1}}));
    write_picture(folder / "thin.png", columns, rows, 8, 3, [](int, int, int) { return 9; });
    const std::string said =
        refusal([&] { (void)open_packed(folder / "thin.png", form_of(DepthPacking::left_right)); });
    CHECK(contains(said, "thin.png"));
    CHECK(contains(said, "2 x 2"));
}

TEST_CASE("halves that were squeezed are shown in the size of the whole", "[packed]") {
    const TemporaryFolder folder;
    write_picture(folder / "both.png", 40, 20, 8, 3,
                  [](int i, int, int) { return i < 20 ? 50 : 90; });
    const auto [packing, columns, rows] = GENERATE(table<DepthPacking, int, int>(
        {{DepthPacking::left_right, 40, 20}, {DepthPacking::top_bottom, 40, 20}}));
    PackedForm form = form_of(packing);
    form.half_size = true;
    const Sources sources = open_packed(folder / "both.png", form);
    CHECK(sources.colour->facts().columns == columns);
    CHECK(sources.colour->facts().rows == rows);
    CHECK(sources.depth->facts().columns == columns);
    CHECK(sources.depth->facts().rows == rows);
    CHECK(sources.depth->next()->picture.size() == cv::Size(columns, rows));
}

TEST_CASE("a packed file keeps every level of its depth", "[packed]") {
    const TemporaryFolder folder;
    const cv::Mat both = beside(scene_photo(), painted(scene_depth(), as_grey));
    const cv::Mat truth = painted(scene_depth(), as_grey);
    const auto [name, encoding, worst] = GENERATE(table<const char*, const char*, double>(
        {{"ffv1.mkv", "-c:v ffv1 -pix_fmt bgr0", 0.0},
         {"yuv.mkv", "-c:v ffv1 -pix_fmt yuv420p", 1.1},
         {"h264.mp4", "-c:v libx264 -qp 0 -pix_fmt yuv420p", 1.1}}));
    CAPTURE(name);
    const Sources sources =
        open_packed(clip_of(folder, both, name, encoding), form_of(DepthPacking::left_right));
    const DepthImage depth = DepthScale::as_recorded(sources.depth->facts().bits)
                                 .image_of(sources.depth->next()->picture);
    REQUIRE(depth.levels.size() == truth.total());
    double found = 0.0;
    for (std::size_t k = 0; k < depth.levels.size(); ++k) {
        const cv::Vec3b& was = truth.at<cv::Vec3b>(static_cast<int>(k));
        found = std::max(found, std::abs(static_cast<double>(depth.levels[k]) - was[0]));
    }
    CHECK(found <= worst);
}

TEST_CASE("a packed picture of 16 bits keeps all of them", "[packed]") {
    const TemporaryFolder folder;
    write_picture(folder / "both.png", 64, 64, 16, 3,
                  [](int i, int j, int) { return 1000 * i + j; });
    const Sources sources = open_packed(folder / "both.png", form_of(DepthPacking::right_left));
    const cv::Mat depth = sources.depth->next()->picture;
    REQUIRE(depth.depth() == CV_16U);
    CHECK(depth.at<cv::Vec3w>(5, 31)[0] == 31005);
    CHECK(sources.depth->facts().bits == 16);
    CHECK(sources.colour->next()->picture.depth() == CV_8U);
}

TEST_CASE("depth coded by hue is decoded from its half, with what the recorder knew", "[packed]") {
    const TemporaryFolder folder;
    cv::imwrite((folder / "both.png").string(),
                above(scene_photo(), painted(scene_depth(), as_hue)));
    PackedForm form = form_of(DepthPacking::top_bottom);
    form.hue = HueCode{{{1.0, 3.0}}};
    form.finding = {{.intrinsics = Intrinsics{200.0, 100.0, 79.5, 119.5}},
                    Evidence::metadata,
                    kSurenessOfMetadata,
                    "a test"};
    form.intrinsics_size = {kSceneColumns / 2, kSceneRows};
    form.coded = {{}, Evidence::metadata, kSurenessOfMetadata, "a test"};
    const Sources sources = open_packed(folder / "both.png", form);
    const SourceFacts& facts = sources.depth->facts();
    CHECK(facts.bits == kRealBits);
    CHECK(stated_by(facts).range == DepthRange{1.0, 3.0});
    CHECK(stated_by(facts).packing == DepthPacking::top_bottom);
    CHECK(stated_by(facts).code == DepthCode::hue);
    CHECK(stated_by(facts).intrinsics == Intrinsics{400.0, 100.0, 159.5, 119.5});
    CHECK(origins_of(facts.findings) == "a test");
    const cv::Mat metres = sources.depth->next()->picture;
    CHECK(std::isnan(metres.at<float>(3, 3)));
    CHECK_THAT(static_cast<double>(metres.at<float>(150, 260)), WithinAbs(1.0 + 2.0 * 0.9, 2e-3));
    CHECK(worst_difference(sources.colour->next()->picture, scene_photo()) == 0.0);
}

TEST_CASE("the halves of a packed video go together in time, also after a seek", "[packed]") {
    const TemporaryFolder folder;
    // Frame n has level 5 n in both halves.
    make_flat_clip(folder / "both.mkv", 24, 12, kLossless);
    Sources sources = open_packed(folder / "both.mkv", form_of(DepthPacking::left_right));
    PairedMedia media(std::move(sources.depth), std::move(sources.colour),
                      DepthScale::as_recorded(8));
    media.seek(1.0);
    int frames = 0;
    while (const auto frame = media.next()) {
        CHECK(frame->depth.levels.front() == static_cast<float>(5 * (12 + frames)));
        CHECK(frame->colour.rgb.front() == 5 * (12 + frames));
        ++frames;
    }
    CHECK(frames == 12);
    CHECK(media.description().frames == 24);
    CHECK(media.description().frames_exact);
}

TEST_CASE("a folder of packed pictures is a packed video", "[packed]") {
    const TemporaryFolder folder;
    const std::string stem = GENERATE("frame_", "shot_rgbd_");
    for (int k = 0; k < 3; ++k)
        write_picture(folder / (stem + std::to_string(k) + ".png"), 16, 8, 8, 3,
                      [k](int i, int, int) { return i < 8 ? 40 + k : 80 + k; });
    const Sources sources = open_packed(folder.path(), form_of(DepthPacking::left_right));
    CHECK(sources.depth->facts().frames == 3);
    for (int k = 0; k < 3; ++k) {
        CHECK(sources.colour->next()->picture.at<cv::Vec3b>(0, 0)[0] == 40 + k);
        CHECK(sources.depth->next()->picture.at<cv::Vec3b>(0, 0)[0] == 80 + k);
    }
}

TEST_CASE("names say how halves lie, and some that one of them is depth", "[packed]") {
    const auto [name, packing, half_size, names_depth] =
        GENERATE(table<const char*, DepthPacking, bool, bool>(
            {{"clip_RGBD.mp4", DepthPacking::left_right, false, true},
             {"clip_HRGBD.mp4", DepthPacking::left_right, true, true},
             {"clip_rgbd_half.png", DepthPacking::left_right, true, true},
             {"shot_rgbd_0012.png", DepthPacking::left_right, false, true},
             {"clip_RGBD_TB.mkv", DepthPacking::top_bottom, false, true},
             {"film_LR.mp4", DepthPacking::left_right, false, false},
             {"film_LRF_Full_SBS.mp4", DepthPacking::left_right, false, false},
             {"film.half-sbs.mp4", DepthPacking::left_right, true, false},
             {"film_HSBS.mp4", DepthPacking::left_right, true, false},
             {"film_RLF_cross.mp4", DepthPacking::right_left, false, false},
             {"film_TB.mp4", DepthPacking::top_bottom, false, false},
             {"film_TBF_fulltb.mp4", DepthPacking::top_bottom, false, false},
             {"film_HOU.mp4", DepthPacking::top_bottom, true, false}}));
    CAPTURE(name);
    const auto said = packing_by_name(name);
    REQUIRE(said);
    CHECK(*said == NamedPacking{packing, half_size, names_depth});
}

TEST_CASE("names without such a word at their end say nothing of halves", "[packed]") {
    const std::string name = GENERATE("clip.mp4", "rgbd_dataset_desk.mp4", "half.png", "0001.png",
                                      "", "_.png", "tb_test.mp4", "colour.mp4", "clip_full.mkv");
    CAPTURE(name);
    CHECK_FALSE(packing_by_name(name));
}
