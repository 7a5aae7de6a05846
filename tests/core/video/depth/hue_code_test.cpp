// Depth that is coded as hue, or as a ramp of colours, becomes depth again.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/video/depth/hue_code.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

struct Loss {
    double median{0.0}, worst{0.0};
    int compared{0};
    int wrong{0};     ///< by more than 0.03
    int invented{0};  ///< data where there was none
    int lost{0};
};

Loss loss_of(const cv::Mat& hues, const cv::Mat& truth) {
    Loss loss;
    std::vector<double> errors;
    for (int j = 0; j < truth.rows; ++j) {
        for (int i = 0; i < truth.cols; ++i) {
            const auto is = static_cast<double>(hues.at<float>(j, i));
            const auto was = static_cast<double>(truth.at<float>(j, i));
            loss.invented += static_cast<int>(std::isfinite(is) && !std::isfinite(was));
            loss.lost += static_cast<int>(!std::isfinite(is) && std::isfinite(was));
            if (std::isfinite(is) && std::isfinite(was)) errors.push_back(std::abs(is - was));
        }
    }
    std::sort(errors.begin(), errors.end());
    loss.compared = static_cast<int>(errors.size());
    if (errors.empty()) return loss;
    loss.median = errors[errors.size() / 2];
    loss.worst = errors.back();
    loss.wrong = static_cast<int>(
        std::count_if(errors.begin(), errors.end(), [](double error) { return error > 0.03; }));
    return loss;
}

/// The scene in hues as a file, read as colours.
cv::Mat coded_and_read(const TemporaryFolder& folder, const std::string& name,
                       const std::string& encoding) {
    const auto still = folder / "scene.png";
    cv::imwrite(still.string(), painted(scene_depth(), as_hue));
    const auto file = folder / name;
    if (file != still)
        ffmpeg("-loop 1 -i '" + still.string() + "' -frames:v 2 " + encoding + " '" +
               file.string() + "'");
    return open_picture_source(file, PictureRole::colour)->next()->picture;
}

int whole_range_jumps(const cv::Mat& hues) {
    int jumps = 0;
    for (int j = 1; j < hues.rows; ++j) {
        for (int i = 1; i < hues.cols; ++i) {
            const float here = hues.at<float>(j, i);
            jumps += static_cast<int>(std::abs(here - hues.at<float>(j, i - 1)) > 0.8F);
            jumps += static_cast<int>(std::abs(here - hues.at<float>(j - 1, i)) > 0.8F);
        }
    }
    return jumps;
}

int with_data(const cv::Mat& hues) {
    return cv::countNonZero(hues == hues);
}

/// One picture, as often as it is asked for.
std::unique_ptr<PictureSource> source_of(const TemporaryFolder& folder, const cv::Mat& picture) {
    cv::imwrite((folder / "picture.png").string(), picture);
    return open_picture_source(folder / "picture.png", PictureRole::colour);
}

}  // namespace

TEST_CASE("a lossless file of hues gives the depth to within its 1529 levels", "[hue]") {
    const TemporaryFolder folder;
    const std::string name = GENERATE("scene.png", "scene.mkv");
    CAPTURE(name);
    const cv::Mat picture = coded_and_read(folder, name, "-c:v ffv1 -pix_fmt bgr0");
    const Loss loss = loss_of(hues_of(picture, HueCode{}), scene_depth());
    CHECK(loss.worst < 1.0 / 1529.0);
    CHECK(loss.invented == 0);
    CHECK(loss.lost == 0);
}

TEST_CASE("a compressed file of hues keeps the depth, and mixed hues at silhouettes are no data",
          "[hue]") {
    const TemporaryFolder folder;
    const auto [format, most_wrong, most_lost] =
        GENERATE(table<const char*, int, int>({{"yuv444p", 60, 20}, {"yuv420p", 120, 900}}));
    CAPTURE(format);
    const cv::Mat picture =
        coded_and_read(folder, "scene.mp4", std::string("-c:v libx264 -crf 18 -pix_fmt ") + format);
    const Loss loss = loss_of(hues_of(picture, HueCode{}), scene_depth());
    CAPTURE(loss.median, loss.worst, loss.wrong, loss.lost, loss.compared);
    CHECK(loss.median < 0.0015);
    CHECK(loss.worst < 0.2);
    CHECK(loss.wrong <= most_wrong);
    CHECK(loss.lost <= most_lost);
    CHECK(loss.invented == 0);
}

TEST_CASE("near red that noise has put beyond the seam is near again", "[hue]") {
    cv::RNG random(3);
    cv::Mat truth(60, 80, CV_32F);
    cv::Mat noisy(60, 80, CV_32F);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 80; ++i) {
            const double hue = 0.25 * j / 59.0;  // a floor that begins at the nearest
            truth.at<float>(j, i) = static_cast<float>(hue);
            noisy.at<float>(j, i) =
                static_cast<float>(std::fmod(hue + random.gaussian(0.01) + 1.0, 1.0));
        }
    }
    REQUIRE(whole_range_jumps(noisy) > 100);
    assign_red_side(noisy);
    CHECK(whole_range_jumps(noisy) == 0);
    CHECK(loss_of(noisy, truth).worst < 0.06);
}

TEST_CASE("far red stays far, and comes back from the near side", "[hue]") {
    cv::RNG random(4);
    cv::Mat hues(60, 80, CV_32F);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 80; ++i) {
            const double hue = 0.75 + 0.25 * j / 59.0;
            hues.at<float>(j, i) =
                static_cast<float>(std::fmod(hue + random.gaussian(0.01) + 1.0, 1.0));
        }
    }
    REQUIRE(whole_range_jumps(hues) > 20);
    assign_red_side(hues);
    CHECK(whole_range_jumps(hues) == 0);
    CHECK(cv::countNonZero(hues < 0.5) == 0);
    CHECK(cv::countNonZero(hues >= 1.0) == 0);
}

TEST_CASE("red with nothing beside it that tells its side stays as it is", "[hue]") {
    const auto hue = static_cast<float>(GENERATE(0.0, 0.01, 0.99));
    cv::Mat hues(20, 30, CV_32F, cv::Scalar(hue));
    assign_red_side(hues);
    CHECK(cv::countNonZero(hues == hue) == 600);
}

TEST_CASE("black, grey and pictures without colours hold no hues, and one pixel may hold one",
          "[hue]") {
    CHECK(with_data(hues_of(cv::Mat(9, 7, CV_8UC3, cv::Scalar(0, 0, 0)), {})) == 0);
    CHECK(with_data(hues_of(cv::Mat(9, 7, CV_8UC3, cv::Scalar(200, 200, 200)), {})) == 0);
    CHECK(with_data(hues_of(cv::Mat(9, 7, CV_8UC1, cv::Scalar(200)), {})) == 0);
    CHECK(with_data(hues_of(cv::Mat(9, 7, CV_16UC3, cv::Scalar(0, 65535, 0)), {})) == 63);
    CHECK(with_data(hues_of(cv::Mat(9, 7, CV_8UC4, cv::Scalar(0, 255, 0, 0)), {})) == 63);
    CHECK(with_data(hues_of(cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 255)), {})) == 1);
    CHECK(with_data(hues_of(cv::Mat(1, 50, CV_8UC3, cv::Scalar(0, 255, 255)), {})) == 50);
    CHECK(hues_of(cv::Mat(), {}).empty());
}

TEST_CASE("what is too pale or too dark for a code is no data", "[hue]") {
    const cv::Mat pale(4, 4, CV_8UC3, cv::Scalar(140, 255, 140));
    CHECK(with_data(hues_of(pale, {})) == 0);
    HueCode lenient;
    lenient.least_saturation = 0.3;
    CHECK(with_data(hues_of(pale, lenient)) == 16);
    CHECK(with_data(hues_of(cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 120, 0)), {})) == 0);
}

TEST_CASE("hue between clips becomes metres, and says so", "[hue]") {
    const TemporaryFolder folder;
    const Finding metadata{{}, Evidence::metadata, kSurenessOfMetadata, "a test"};
    const auto depth = hue_decoded(source_of(folder, cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 255, 0))),
                                   HueCode{{{0.5, 2.0}}}, metadata);
    CHECK(depth->facts().bits == kRealBits);
    CHECK(depth->facts().channels == 1);
    CHECK(stated_by(depth->facts()).unit == DepthUnit::m);
    CHECK(stated_by(depth->facts()).near == NearLevels::dark);
    CHECK(stated_by(depth->facts()).range == DepthRange{0.5, 2.0});
    CHECK(stated_by(depth->facts()).code == DepthCode::hue);
    CHECK(origins_of(depth->facts().findings) == "a test");
    const auto taken = depth->next();
    REQUIRE(taken);
    REQUIRE(taken->picture.type() == CV_32FC1);
    CHECK_THAT(static_cast<double>(taken->picture.at<float>(4, 4)), WithinAbs(1.0, 1e-5));
    CHECK_FALSE(depth->next());
    depth->seek(0.0);
    CHECK(depth->next());
}

TEST_CASE("hue without a range is relative, red near", "[hue]") {
    const TemporaryFolder folder;
    const auto depth = hue_decoded(source_of(folder, painted(scene_depth(), as_hue)), {},
                                   finding_on_code(DepthCode::hue, false));
    CHECK(stated_by(depth->facts()).unit == DepthUnit::levels);
    CHECK(stated_by(depth->facts()).near == NearLevels::dark);
    CHECK(loss_of(depth->next()->picture, scene_depth()).worst < 1.0 / 1529.0);
}

TEST_CASE("Record3D's hue is a distance up to 3 m, and its red is no data", "[hue]") {
    const TemporaryFolder folder;
    cv::Mat picture(8, 8, CV_8UC3, cv::Scalar(0, 255, 0));
    picture.col(0).setTo(cv::Scalar(0, 0, 255));
    picture.col(7).setTo(cv::Scalar(12, 0, 255));
    const auto depth = hue_decoded(source_of(folder, picture), record3d_code({}), {});
    const cv::Mat metres = depth->next()->picture;
    CHECK(with_data(metres) == 48);
    CHECK_THAT(static_cast<double>(metres.at<float>(3, 3)), WithinAbs(1.0, 1e-5));
}

TEST_CASE("a ramp from white through cyan and blue to black is linear depth", "[hue]") {
    const TemporaryFolder folder;
    const cv::Mat truth = scene_depth();
    const cv::Mat ramp = painted(truth, as_ramp);
    CHECK(share_on_ramp(ramp) == 1.0);
    CHECK(share_on_ramp(painted(truth, as_hue)) < 0.6);
    CHECK(share_on_ramp(painted(truth, as_grey)) == 0.0);
    CHECK(share_on_ramp(scene_photo()) < 0.3);
    CHECK(share_on_ramp(cv::Mat()) == 0.0);
    const auto depth = ramp_decoded(source_of(folder, ramp));
    CHECK(depth->facts().bits == 8);
    REQUIRE(depth->facts().findings.size() == 1);
    CHECK(depth->facts().findings[0].statement.near == NearLevels::bright);
    CHECK(depth->facts().findings[0].evidence == Evidence::appearance);  // blue skies are so, too
    const cv::Mat levels = depth->next()->picture;
    for (int j = 0; j < truth.rows; j += 7) {
        for (int i = 0; i < truth.cols; i += 7) {
            const auto far = static_cast<double>(truth.at<float>(j, i));
            const double level = std::isfinite(far) ? 255.0 * (1.0 - far) : 0.0;
            CHECK_THAT(static_cast<double>(levels.at<float>(j, i)), WithinAbs(level, 0.5));
        }
    }
}
