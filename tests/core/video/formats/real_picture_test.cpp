// Pictures of real numbers and of numbers with a sign: PFM and TIFF files; and PNG files.
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

int different(const cv::Mat& a, const cv::Mat& b) {
    REQUIRE(a.size() == b.size());
    REQUIRE(a.type() == b.type());
    return cv::countNonZero(a != b);
}

/// The scene's levels, or its depths, as numbers of another type.
template <typename Number>
std::string scene_as(bool levels, bool little) {
    std::string bytes;
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i) {
            const int level = scene_level(i, j);
            append_bytes(
                bytes,
                levels ? static_cast<Number>(level) : static_cast<Number>(scene_depth(level)),
                little);
        }
    return bytes;
}

StillPicture written_and_read(const TemporaryFolder& folder, const std::string& name,
                              const std::string& bytes) {
    write_text(folder / name, bytes);
    return read_still(folder / name, PictureRole::depth);
}

}  // namespace

TEST_CASE("every level of a PFM file is kept, in either byte order and whatever its scale",
          "[pfm]") {
    const TemporaryFolder folder;
    const auto [scale, little] = GENERATE(table<std::string, bool>(
        {{"-1.0", true}, {"1", false}, {"-0.003922", true}, {"255.0", false}}));
    CAPTURE(scale);
    const StillPicture still = written_and_read(folder, "a.pfm", pfm(scene(), scale, little));
    CHECK(still.bits == kRealBits);
    CHECK(still.codec == "PFM");
    CHECK(different(still.picture, scene()) == 0);
}

TEST_CASE("infinite disparities of a PFM file stay what they are: no data", "[pfm]") {
    const TemporaryFolder folder;
    cv::Mat some = scene();
    some.at<float>(7, 9) = std::numeric_limits<float>::infinity();
    const StillPicture still = written_and_read(folder, "a.pfm", pfm(some, "-1", true));
    CHECK(std::isinf(still.picture.at<float>(7, 9)));
}

TEST_CASE("a PFM file of three channels has colours, one of one channel has none", "[pfm]") {
    const TemporaryFolder folder;
    const cv::Mat colours(5, 4, CV_32FC3, cv::Scalar(0, 0.5, 1));
    write_text(folder / "colours.pfm", pfm(colours, "-1", true));
    write_text(folder / "depth.pfm", pfm(scene(), "-1", true));
    const cv::Mat shown = read_still(folder / "colours.pfm", PictureRole::colour).picture;
    CHECK(shown.at<cv::Vec3b>(4, 3) == cv::Vec3b(0, 188, 255));
    CHECK(contains(refusal([&] { (void)read_still(folder / "depth.pfm", PictureRole::colour); }),
                   "no colours"));
}

TEST_CASE("every level of a TIFF file is kept, whatever its numbers are", "[tiff]") {
    const TemporaryFolder folder;
    const bool little = GENERATE(true, false);
    const auto file = [&](int bits, int format, const std::string& data) {
        CAPTURE(bits, format, little);
        return written_and_read(folder, "a.tiff",
                                tiff(kSceneColumns, kSceneRows, bits, format, little, data));
    };
    const StillPicture real = file(32, 3, scene_as<float>(false, little));
    CHECK(real.bits == kRealBits);
    CHECK(real.codec == "TIFF");
    CHECK(different(real.picture, scene()) == 0);
    const StillPicture precise = file(64, 3, scene_as<double>(false, little));
    CHECK(precise.bits == kRealBits);
    CHECK(different(precise.picture, scene()) == 0);
    CHECK(different(file(32, 2, scene_as<std::int32_t>(true, little)).picture, scene_levels()) ==
          0);
    CHECK(different(file(16, 2, scene_as<std::int16_t>(true, little)).picture, scene_levels()) ==
          0);
    const StillPicture whole = file(16, 1, scene_as<std::uint16_t>(true, little));
    CHECK(whole.bits == 16);
    CHECK(whole.picture.depth() == CV_16U);
}

TEST_CASE("a TIFF file of numbers that are not read says which are", "[tiff]") {
    const TemporaryFolder folder;
    const std::string data = scene_as<std::uint32_t>(true, true);
    write_text(folder / "a.tiff", tiff(kSceneColumns, kSceneRows, 32, 1, true, data));
    CHECK(contains(refusal([&] { (void)read_still(folder / "a.tiff", PictureRole::depth); }),
                   "export it again (with 8 or 16 bits, or 32-bit reals)"));
}

TEST_CASE("a folder of real pictures is a video of real levels", "[pfm]") {
    const TemporaryFolder folder;
    write_text(folder / "depth_1.pfm", pfm(scene(), "-1", true));
    write_text(folder / "depth_2.pfm", pfm(scene() * 2, "-1", true));
    const auto source = open_picture_source(folder.path(), PictureRole::depth);
    CHECK(source->facts().bits == kRealBits);
    CHECK(source->facts().frames == 2);
    CHECK(different(source->next()->picture, scene()) == 0);
    CHECK(different(source->next()->picture, scene() * 2) == 0);
}

TEST_CASE("a bump map may be of real numbers, and is flat where there are none", "[pfm]") {
    const TemporaryFolder folder;
    cv::Mat heights(4, 4, CV_32FC1, cv::Scalar::all(3));
    heights.at<float>(0, 0) = 5;
    heights.at<float>(0, 1) = std::numeric_limits<float>::quiet_NaN();
    heights.at<float>(0, 2) = std::numeric_limits<float>::infinity();
    write_text(folder / "bump.pfm", pfm(heights, "-1", true));
    const BumpMap bump = read_bump_map(folder / "bump.pfm");
    CHECK(bump.heights[0] == 1.0F);
    for (std::size_t k = 1; k < 16; ++k) CHECK(bump.heights[k] == 0.0F);
}

TEST_CASE("PNG pictures of every kind are read as OpenCV reads them", "[png]") {
    const TemporaryFolder folder;
    const int type = GENERATE(CV_8UC1, CV_16UC1, CV_8UC3, CV_16UC3, CV_8UC4, CV_16UC4);
    CAPTURE(type);
    cv::Mat picture(37, 53, type);
    cv::randu(picture, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
    const std::string file = (folder / "a.png").string();
    REQUIRE(cv::imwrite(file, picture));
    const auto all_different = [](const cv::Mat& a, const cv::Mat& b) {
        return different(a.reshape(1), b.reshape(1));
    };
    const cv::Mat depth = read_still(file, PictureRole::depth).picture;
    CHECK(all_different(depth, cv::imread(file, cv::IMREAD_UNCHANGED)) == 0);
    const cv::Mat colour = read_still(file, PictureRole::colour).picture;
    CHECK(all_different(colour, cv::imread(file, cv::IMREAD_COLOR)) == 0);
    CHECK(read_plain_png(file, PictureRole::depth).empty() == (CV_MAT_CN(type) == 4));
}

TEST_CASE("a PNG picture that ends too early is refused", "[png]") {
    const TemporaryFolder folder;
    cv::Mat picture(64, 64, CV_16UC1);
    cv::randu(picture, 0, 65536);
    std::vector<std::uint8_t> bytes;
    REQUIRE(cv::imencode(".png", picture, bytes));
    write_text(folder / "a.png", std::string(bytes.begin(), bytes.begin() + 3000));
    CHECK(read_plain_png(folder / "a.png", PictureRole::depth).empty());
    CHECK_THROWS_AS(read_still(folder / "a.png", PictureRole::depth), InputError);
}
