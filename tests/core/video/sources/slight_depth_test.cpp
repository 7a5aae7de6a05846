// Depth that says hardly anything, or nothing: never a crash, always a line or a surface.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// Opened as by `dibhr view FILE`: the first frame, or the line that says why not.
struct Opened {
    std::string line{};
    DepthImage depth{};
};

Opened opened(const std::function<std::unique_ptr<Media>()>& open) {
    Opened result;
    result.line = refusal([&] {
        if (const auto frame = open()->next()) result.depth = frame->depth;
    });
    return result;
}

/// One line, or levels from 0 to the highest, or no data.
void check_sensible(const Opened& result) {
    if (!result.line.empty()) {
        CAPTURE(result.line);
        CHECK(result.line.find('\n') == std::string::npos);
        CHECK(contains(result.line, ": "));  // what to do next
        return;
    }
    REQUIRE_FALSE(result.depth.levels.empty());
    CHECK(std::isfinite(result.depth.highest_level));
    CHECK(result.depth.highest_level > 0.0);
    const auto highest = static_cast<float>(result.depth.highest_level);
    const auto senseless = std::count_if(
        result.depth.levels.begin(), result.depth.levels.end(), [highest](float level) {
            return !std::isnan(level) && !(level >= 0.0F && level <= highest);
        });
    CHECK(senseless == 0);
}

cv::Mat flat(int type, double level, int columns = 64, int rows = 48) {
    return {rows, columns, type, cv::Scalar(level)};
}

cv::Mat with_one(cv::Mat picture, double level) {
    picture.at<std::uint16_t>(picture.rows / 2, picture.cols / 2) =
        static_cast<std::uint16_t>(level);
    return picture;
}

cv::Mat with_one_real(cv::Mat picture, float number) {
    picture.at<float>(picture.rows / 2, picture.cols / 2) = number;
    return picture;
}

std::string pfm_of(const cv::Mat& numbers) {
    return pfm(numbers, "-1", true);
}

}  // namespace

TEST_CASE("depth that says hardly anything is a plain line or a sensible surface", "[forms]") {
    struct Case {
        const char* name;
        const char* file;
        Write write;
    };
    const float none = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const float most = std::numeric_limits<float>::max();
    const auto real = [](double number) { return flat(CV_32F, number); };
    const std::vector<Case> cases{
        {"all 0", "a.png", picture(flat(CV_16U, 0.0))},
        {"all 65535", "a.png", picture(flat(CV_16U, 65535.0))},
        {"all equal", "a.png", picture(flat(CV_16U, 1500.0))},
        {"all equal, 8 bit", "a_depth.png", picture(flat(CV_8U, 77.0))},
        {"all 0, 8 bit", "a_depth.png", picture(flat(CV_8U, 0.0))},
        {"one pixel differs", "a.png", picture(with_one(flat(CV_16U, 1500.0), 1501.0))},
        {"one pixel has data", "a.png", picture(with_one(flat(CV_16U, 0.0), 1500.0))},
        {"one pixel has no data", "a.png", picture(with_one(flat(CV_16U, 1500.0), 0.0))},
        {"nothing but NaN", "a.pfm", text(pfm_of(real(none)))},
        {"nothing but infinity", "a.pfm", text(pfm_of(real(infinity)))},
        {"nothing but minus infinity", "a.pfm", text(pfm_of(real(-infinity)))},
        {"one number among NaN", "a.pfm", text(pfm_of(with_one_real(real(none), 2.0F)))},
        {"one infinity", "a.pfm", text(pfm_of(with_one_real(real(2.0), infinity)))},
        {"largest and smallest numbers", "a.pfm", text(pfm_of(with_one_real(real(most), -most)))},
        {"denormal numbers", "a.pfm", text(pfm_of(with_one_real(real(0.0), 1e-44F)))},
        {"numbers below 0", "a.pfm", text(pfm_of(with_one_real(real(-5.0), -7.0F)))},
        {"disparities of 0", "a_disp.pfm", text(pfm_of(real(0.0)))},
        {"disparities below 0", "a_disp.pfm", text(pfm_of(with_one_real(real(-5.0), -7.0F)))},
        {"disparities of which one is above 0", "a_disp.pfm",
         text(pfm_of(with_one_real(real(0.0), 3.0F)))},
        {"2 x 2", "a.png", picture(with_one(flat(CV_16U, 1500.0, 2, 2), 1600.0))},
        {"2 x 2, all 0", "a.png", picture(flat(CV_16U, 0.0, 2, 2))},
        {"2 x 1", "a.png", picture(flat(CV_16U, 1500.0, 2, 1))},
        {"1 x 1 of real numbers", "a.pfm", text(pfm_of(flat(CV_32F, 1.0, 1, 1)))},
        {"2 x 2 of real numbers", "a.npy",
         text(npy("<f4", "(2, 2)", bytes_of(flat(CV_32F, 1.0, 2, 2))))},
        {"a video of one frame, all 0", "a.mkv",
         video(flat(CV_16U, 0.0), "gray16le", "-frames:v 1 " + kFfv1_16)},
        {"a video of one frame, all equal", "a.mkv",
         video(flat(CV_16U, 900.0), "gray16le", "-frames:v 1 " + kFfv1_16)}};
    for (const Case& a : cases) {
        CAPTURE(a.name);
        const TemporaryFolder folder;
        const fs::path file = folder / a.file;
        a.write(file);
        const DepthRequest guessed{.find_out = true};
        check_sensible(opened([&] { return open_media(file, {}, guessed); }));
        check_sensible(opened([&] { return open_depth(file, guessed); }));
        for (const DepthUnit unit : kDepthUnits) {
            CAPTURE(name_of(unit));
            const DepthRequest told{.find_out = true, .command_line = {.unit = unit}};
            check_sensible(opened([&] { return open_depth(file, told); }));
        }
    }
}
