// One scene of known depth in the forms that people bring it in: each gives the same surface, as
// near as it can hold it, and says what was guessed.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

// Half as long and wide as scene_depth(): of each level there are four pixels or more all the same.
constexpr int kColumns = kSceneColumns / 2;
constexpr int kRows = kSceneRows / 2;
constexpr double kNearest_mm = 1000.0;
constexpr double kLast = kSceneLevels - 1.0;

enum class Part { floor, ball, step };

Part part_at(double x, double y) {
    if (std::hypot(x - 75.0, y - 62.5) < 27.5) return Part::ball;
    return x > 117.5 && x < 147.5 && y > 25.0 && y < 100.0 ? Part::step : Part::floor;
}

/// A floor that comes nearer downwards and to the left, a ball in front of it, a step on it.
double distance_at(double x, double y) {
    const double floor = 0.9 - 0.45 * y / kRows + 0.1 * x / kColumns;
    const double off = std::hypot(x - 75.0, y - 62.5) / 27.5;
    if (part_at(x, y) == Part::ball) return 0.32 - 0.25 * std::sqrt(1.0 - off * off);
    return part_at(x, y) == Part::step ? floor - 0.25 : floor;
}

cv::Mat made_farness() {
    std::vector<int> pixels(std::size_t{kColumns} * kRows);
    std::iota(pixels.begin(), pixels.end(), 0);
    std::vector<double> distances;
    for (const int pixel : pixels)
        distances.push_back(distance_at(pixel % kColumns, pixel / kColumns));
    const auto distance = [&](int pixel) { return distances[static_cast<std::size_t>(pixel)]; };
    std::stable_sort(pixels.begin(), pixels.end(),
                     [&](int a, int b) { return distance(a) < distance(b); });
    cv::Mat farness(kRows, kColumns, CV_32F);
    for (std::size_t k = 0; k < pixels.size(); ++k)
        farness.at<float>(pixels[k] / kColumns, pixels[k] % kColumns) =
            static_cast<float>(k * kSceneLevels / pixels.size());
    return farness;
}

/// How much farther than the nearest each pixel is: 0 to 4095 mm, each as often as any other.
const cv::Mat& farness() {
    static const cv::Mat farness = made_farness();
    return farness;
}

cv::Mat made_photo() {
    const cv::Mat light = rough(kColumns, kRows, 3);
    cv::Mat picture(kRows, kColumns, CV_8UC3);
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            const Part part = part_at(i, j);
            const cv::Vec3d colour = part == Part::floor  ? cv::Vec3d(0.5, 0.7, 1.1)
                                     : part == Part::ball ? cv::Vec3d(1.3, 0.6, 0.4)
                                                          : cv::Vec3d(0.4, 1.2, 0.6);
            for (int c = 0; c < 3; ++c)
                picture.at<cv::Vec3b>(j, i)[c] =
                    cv::saturate_cast<std::uint8_t>(light.at<std::uint8_t>(j, i) * colour[c]);
        }
    }
    return picture;
}

const cv::Mat& photo() {
    static const cv::Mat picture = made_photo();
    return picture;
}

/// What each pixel's farness becomes.
cv::Mat each(int type, const std::function<double(double)>& level) {
    cv::Mat picture = farness().clone();
    picture.forEach<float>(
        [&](float& far, const int*) { far = static_cast<float>(level(static_cast<double>(far))); });
    cv::Mat typed;
    picture.convertTo(typed, type);
    return typed;
}

double distance_mm(double far) {
    return kNearest_mm + far;
}

/// Levels of so many bits, all of them in use.
cv::Mat levels(int bits, bool near_is_bright) {
    const double highest = std::ldexp(1.0, bits) - 1.0;
    return each(bits == 8 ? CV_8U : CV_16U,
                [=](double far) { return highest / kLast * (near_is_bright ? kLast - far : far); });
}

cv::Mat millimetres() {
    return each(CV_16U, distance_mm);
}

cv::Mat metres() {
    return each(CV_32F, [](double far) { return 0.001 * distance_mm(far); });
}

/// Of two cameras.
cv::Mat disparities() {
    return each(CV_32F, [](double far) { return 100000.0 / distance_mm(far); });
}

/// Red is near, and no other depth is red.
cv::Mat hues() {
    const cv::Mat far = each(CV_32F, [](double level) { return level / kLast * 1529.0 / 1530.0; });
    return painted(far, as_hue);
}

/// Metres in the bytes of the channels; for the others millimetres, what simulators write, heights.
cv::Mat in_bytes_of(DepthCode code) {
    const auto number = [code](double far) {
        if (code == DepthCode::rg16) return distance_mm(far);
        if (code == DepthCode::rgb24) return std::round(distance_mm(far) * 16.777215);
        return code == DepthCode::terrain ? 100.0 + 0.1 * (kLast - far) : 0.001 * distance_mm(far);
    };
    return in_bytes(each(CV_32F, number), code);
}

/// Three equal channels of its own bits.
cv::Mat grey(const cv::Mat& picture) {
    cv::Mat three;
    cv::cvtColor(picture, three, cv::COLOR_GRAY2BGR);
    return three;
}

cv::Mat photo16() {
    cv::Mat deep;
    photo().convertTo(deep, CV_16U, 257.0);
    return deep;
}

cv::Mat turned_back(const cv::Mat& picture) {
    cv::Mat turned;
    cv::rotate(picture, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    return turned;
}

cv::Mat narrow(const cv::Mat& picture) {
    cv::Mat half;
    cv::resize(picture, half, {kColumns / 2, kRows}, 0.0, 0.0, cv::INTER_AREA);
    return half;
}

Write turned_video(const cv::Mat& content, const std::string& format, const std::string& encoding) {
    return [=](const fs::path& file) {
        const fs::path plain = file.parent_path() / ("plain" + file.extension().string());
        video(turned_back(content), format, encoding)(plain);
        turn(plain, file, 90);
        fs::remove(plain);
    };
}

Write late_video(const cv::Mat& content, const std::string& format, const std::string& encoding) {
    return [=](const fs::path& file) {
        const fs::path plain = file.parent_path() / ("plain" + file.extension().string());
        video(content, format, encoding)(plain);
        ffmpeg("-itsoffset 0.4 -i '" + plain.string() + "' -c copy '" + file.string() + "'");
        fs::remove(plain);
    };
}

const std::string kHevc = "-c:v libx265 -x265-params lossless=1:log-level=none -pix_fmt ";
const std::string kCrf4 = "-c:v libx264 -crf 4 -pix_fmt yuv420p";

struct Form {
    std::string name;
    std::string file;  ///< "_depth" in it: a photo of the same name lies beside it
    Write write;
    double loss;            ///< at most, of the range
    int levels;             ///< that are kept, at least
    std::string assumed;    ///< what was guessed
    DepthStatement told{};  ///< by the command line; empty: everything is guessed
    double share{1.0};      ///< of the pixels, whose error is within the loss
    bool has_photo{false};
};

// Halves of a step of each form, as shares of the range, and some room for floats.
constexpr double kExact = 2e-4;
constexpr double k10Bits = 0.5 / 1023 + 1e-5;
constexpr double k8Bits = 0.5 / 255 + 1e-5;
constexpr double kHue = 1.0 / 1529;
constexpr double kLimited10 = 1.0 / 876;
constexpr double kCompressed = 4.0 / 255;

// What is not sure of pictures that nobody says anything of.
const std::string kAll = "no_data";
const std::string kDark8 = "near no_data";  // against the custom of 8 bits
const std::string kHalves = " packing code";

std::vector<Form> forms() {
    const DepthStatement dark{.near = NearLevels::dark};
    const DepthStatement disparity{.unit = DepthUnit::disparity};
    const cv::Mat disparity16 =
        each(CV_16U, [](double far) { return 65535.0 * kNearest_mm / distance_mm(far); });
    const cv::Mat fifths = each(CV_16U, [](double far) { return 5.0 * distance_mm(far); });
    const cv::Mat mm = millimetres();
    const cv::Mat m = metres();
    return {
        {"PNG 16 bit, mm", "a_depth.png", picture(mm), kExact, 4096, kAll, {}, 1.0, true},
        {"PNG 16 bit, mm, alone", "a.png", picture(mm), kExact, 4096, kAll},
        {"PNG 16 bit, m of 0.0002",
         "a.png",
         picture(fifths),
         kExact,
         4096,
         "no_data",
         {.unit = DepthUnit::m, .scale = 0.0002}},
        {"PNG 16 bit, levels, near bright", "a.png", picture(levels(16, true)), kExact, 4096, kAll},
        {"PNG 16 bit, levels, near dark", "a.png", picture(levels(16, false)), kExact, 4096, kAll},
        {"PNG 16 bit, levels, near dark, told", "a.png", picture(levels(16, false)), kExact, 4096,
         kAll, dark},
        {"PNG 16 bit, disparity, by its name", "a_disp.png", picture(disparity16), kExact, 4096,
         "no_data"},
        {"PNG 16 bit, disparity, told", "a.png", picture(disparity16), kExact, 4096, "no_data",
         disparity},
        {"PNG 8 bit, near bright", "a.png", picture(levels(8, true)), k8Bits, 256, kAll},
        {"PNG 8 bit, near dark",
         "a_depth.png",
         picture(levels(8, false)),
         k8Bits,
         256,
         kDark8,
         {},
         1.0,
         true},
        {"PNG, hue", "a.png", picture(hues()), kHue, 1529, ""},
        {"PNG, rg16, mm", "a.png", picture(in_bytes_of(DepthCode::rg16)), kExact, 4096, kAll},
        {"PNG, rgb24",
         "a_depth.png",
         picture(in_bytes_of(DepthCode::rgb24)),
         kExact,
         4096,
         "",
         {},
         1.0,
         true},
        {"PNG, rgb24, told",
         "a.png",
         picture(in_bytes_of(DepthCode::rgb24)),
         kExact,
         4096,
         "",
         {.code = DepthCode::rgb24}},
        {"PNG, float32, m", "a.png", picture(in_bytes_of(DepthCode::float32)), kExact, 4096, kAll},
        {"PNG, terrain", "a.png", picture(in_bytes_of(DepthCode::terrain)), kExact, 4096, ""},
        {"TIFF 16 bit, mm", "a.tiff", picture(mm), kExact, 4096, kAll},
        {"TIFF float, m", "a.tif", text(tiff(kColumns, kRows, 32, 3, true, bytes_of(m))), kExact,
         4096, kAll},
        {"PFM, disparity", "a.pfm", text(pfm(disparities(), "-1", true)), kExact, 4096, kAll},
        {"PFM big-endian, m",
         "a.pfm",
         text(pfm(m, "1", false)),
         kExact,
         4096,
         "no_data",
         {.unit = DepthUnit::m}},
        {"EXR Z, m", "a.exr", exr("Z", m), kExact, 4096, "no_data"},
        {"EXR Y, levels 0 to 1, near bright", "a.exr",
         exr("Y", each(CV_32F, [](double far) { return 1.0 - far / kLast; })), kExact, 4096, kAll},
        {"npy float, m", "a.npy", text(npy("<f4", "(120, 160)", bytes_of(m))), kExact, 4096, kAll},
        {"npy 16 bit, mm", "a.npy", text(npy("<u2", "(120, 160)", bytes_of(mm))), kExact, 4096,
         kAll},
        {"npz float, mm", "a.npz",
         zip_of("depth.npy", npy("<f4", "(120, 160)", bytes_of(each(CV_32F, distance_mm)))), kExact,
         4096, kAll},
        {"FFV1 16 bit, mm",
         "a_depth.mkv",
         video(mm, "gray16le", kFfv1_16),
         kExact,
         4096,
         kAll,
         {},
         1.0,
         true},
        {"FFV1 16 bit, mm, turned", "a.mov", turned_video(mm, "gray16le", kFfv1_16), kExact, 4096,
         kAll},
        {"FFV1 16 bit, mm, begins 0.4 s later",
         "a_depth.mkv",
         late_video(mm, "gray16le", kFfv1_16),
         kExact,
         4096,
         kAll,
         {},
         1.0,
         true},
        // Between silhouettes, where pixels are between those of the file.
        {"FFV1 16 bit, mm, pixels 2:1",
         "a.mkv",
         video(narrow(mm), "gray16le", "-vf setsar=2/1 " + kFfv1_16),
         2e-3,
         3900,
         kAll,
         {},
         0.95},
        {"FFV1 12 bit, near bright", "a.mkv",
         video(levels(12, true), "gray12le", "-c:v ffv1 -pix_fmt gray12le"), kExact, 4096, kAll},
        {"FFV1 10 bit, near dark", "a.mkv",
         video(levels(10, false), "gray10le", "-c:v ffv1 -pix_fmt gray10le"), k10Bits, 1024, kAll},
        {"HEVC 12 bit, near dark", "a.mkv",
         video(levels(12, false), "gray12le", kHevc + "gray12le"), kExact, 4096, kAll},
        {"HEVC 10 bit, near bright", "a.mp4",
         video(levels(10, true), "gray10le", kHevc + "gray10le"), k10Bits, 1024, kAll},
        {"H.264 8 bit CRF 4, near bright",
         "a_depth.mp4",
         video(levels(8, true), "gray", kCrf4),
         kCompressed,
         200,
         kAll,
         {},
         1.0,
         true},
        {"H.264 8 bit CRF 4, near dark, turned", "a.mp4",
         turned_video(levels(8, false), "gray", kCrf4), kCompressed, 200, kDark8},
        {"H.264 4:4:4 lossless, hue", "a.mkv",
         video(hues(), "bgr24", "-c:v libx264rgb -qp 0 -pix_fmt bgr24"), kHue, 1529, ""},
        {"H.264 RGB lossless, rg16, mm", "a.mkv",
         video(in_bytes_of(DepthCode::rg16), "bgr24", "-c:v libx264rgb -qp 0 -pix_fmt bgr24"),
         kExact, 4096, kAll},
        {"FFV1, rgb24", "a.mkv",
         video(in_bytes_of(DepthCode::rgb24), "bgr24", "-c:v ffv1 -pix_fmt bgr0"), kExact, 4096,
         ""},
        {"FFV1, float32, m", "a.mkv",
         video(in_bytes_of(DepthCode::float32), "bgra", "-c:v ffv1 -pix_fmt bgra"), kExact, 4096,
         kAll},
        {"FFV1, terrain, told",
         "a.mkv",
         video(in_bytes_of(DepthCode::terrain), "bgr24", "-c:v ffv1 -pix_fmt bgr0"),
         kExact,
         4096,
         "",
         {.code = DepthCode::terrain}},
        {"tracks, FFV1 16 bit, mm",
         "a.mkv",
         tracks(photo(), mm, "gray16le", ""),
         kExact,
         4096,
         kAll,
         {},
         1.0,
         true},
        {"tracks, FFV1 12 bit, near dark",
         "a.mkv",
         tracks(photo(), levels(12, false), "gray12le", "Depth"),
         kExact,
         4096,
         kAll,
         {},
         1.0,
         true},
        {"tracks, FFV1 8 bit, near bright",
         "a.mkv",
         tracks(photo(), levels(8, true), "gray", ""),
         k8Bits,
         256,
         kAll,
         {},
         1.0,
         true},
        {"tracks, FFV1, hue",
         "a.mkv",
         tracks(photo(), hues(), "bgr24", "Depth"),
         kHue,
         1529,
         "",
         {},
         1.0,
         true},
        {"left-right, PNG 16 bit, near bright",
         "a.png",
         picture(beside(photo16(), grey(levels(16, true)))),
         kExact,
         4096,
         kAll + kHalves,
         {},
         1.0,
         true},
        {"left-right, PNG 16 bit, mm",
         "a.png",
         picture(beside(photo16(), grey(mm))),
         kExact,
         4096,
         kAll,
         {.packing = DepthPacking::left_right},
         1.0,
         true},
        {"right-left, PNG 8 bit, near dark",
         "a.png",
         picture(beside(grey(levels(8, false)), photo())),
         k8Bits,
         256,
         kDark8 + kHalves,
         {},
         1.0,
         true},
        {"top-bottom, PNG, hue",
         "a.png",
         picture(above(photo(), hues())),
         kHue,
         1529,
         "packing",
         {},
         1.0,
         true},
        {"left-right, PNG, rg16, mm",
         "a.png",
         picture(beside(photo(), in_bytes_of(DepthCode::rg16))),
         kExact,
         4096,
         kAll,
         {.packing = DepthPacking::left_right},
         1.0,
         true},
        {"top-bottom, TIFF 16 bit, disparity", "a.tiff",
         picture(above(photo16(), grey(disparity16))), kExact, 4096, "no_data packing code",
         disparity, 1.0, true},
        {"left-right, FFV1 16 bit, near bright",
         "a.mkv",
         video(beside(photo16(), grey(levels(16, true))), "bgr48le", "-c:v ffv1 -pix_fmt gbrp16le"),
         kExact,
         4096,
         kAll + kHalves,
         {},
         1.0,
         true},
        {"top-bottom, HEVC 10 bit TV range, near bright",
         "a.mkv",
         video(above(photo16(), grey(levels(16, true))), "bgr48le",
               "-vf zscale=matrix=709:range=limited " + kHevc + "yuv420p10le"),
         kLimited10,
         800,
         kAll + kHalves,
         {},
         1.0,
         true},
        {"left-right, H.264 CRF 4, near bright",
         "a.mp4",
         video(beside(photo(), grey(levels(8, true))), "bgr24", kCrf4),
         kCompressed,
         200,
         kAll + kHalves,
         {},
         1.0,
         true},
        {"right-left, H.264 4:4:4 CRF 4, hue",
         "a.mp4",
         video(beside(hues(), photo()), "bgr24", "-c:v libx264 -crf 4 -pix_fmt yuv444p"),
         kCompressed,
         1000,
         "packing",
         {},
         0.98,
         true},
    };
}

/// What came out of one form.
struct Found {
    double error{1.0};  ///< of the best pixels of the share that counts, of the range
    int levels{0};
    int missing{0};  ///< pixels without data
    std::string assumed{};
    bool shows_photo{false};
    DepthStatement meaning{};
};

/// Depth alone is shown in colours of its own.
bool shows_photo(const ColourImage& colour) {
    if (colour.columns != kColumns || colour.rows != kRows) return false;
    const cv::Mat& expected = photo();
    double apart = 0.0;
    for (std::size_t k = 0; k < colour.rgb.size(); ++k)
        apart += std::abs(colour.rgb[k] - expected.data[k / 3 * 3 + 2 - k % 3]);
    return apart < 8.0 * static_cast<double>(colour.rgb.size());
}

/// Writes the form; what a person then opens.
fs::path written(const Form& form, const fs::path& folder) {
    const fs::path file = folder / form.file;
    form.write(file);
    const auto at = form.file.find("_depth");
    if (at == std::string::npos) return file;
    const fs::path colour = folder / (form.file.substr(0, at) + "_color.png");
    picture(photo())(colour);
    return colour;
}

/// The depth against the scene.
void compare(const DepthImage& depth, double share, Found& found) {
    REQUIRE(depth.columns == kColumns);
    REQUIRE(depth.rows == kRows);
    const cv::Mat& far = farness();
    std::vector<double> errors;
    std::vector<float> used;
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            const float level = depth.at(i, j);
            if (!std::isfinite(level)) continue;
            const double nearness = 1.0 - static_cast<double>(far.at<float>(j, i)) / kLast;
            errors.push_back(std::abs(static_cast<double>(level) / depth.highest_level - nearness));
            used.push_back(level);
        }
    }
    REQUIRE_FALSE(errors.empty());
    const auto last = static_cast<double>(errors.size() - 1);
    const auto asked = errors.begin() + static_cast<std::ptrdiff_t>(share * last);
    std::nth_element(errors.begin(), asked, errors.end());
    found.error = *asked;
    std::sort(used.begin(), used.end());
    found.levels = static_cast<int>(std::unique(used.begin(), used.end()) - used.begin());
    found.missing = static_cast<int>(depth.levels.size() - errors.size());
}

Found found_in(const fs::path& given, const DepthStatement& told, double share) {
    const auto media = open_media(given, {}, {.find_out = true, .command_line = told});
    const auto frame = media->next();
    REQUIRE(frame);
    Found found;
    compare(frame->depth, share, found);
    const DepthMeaning meaning = media->description().meaning.value();
    for (const std::string& name : assumed_facts(meaning))
        found.assumed += (found.assumed.empty() ? "" : " ") + name;
    found.shows_photo = shows_photo(frame->colour);
    found.meaning = meaning.statement();
    return found;
}

}  // namespace

TEST_CASE("one scene is the same surface in every form, as near as the form can hold it",
          "[forms]") {
    const std::vector<Form> all = forms();
    CHECK(all.size() >= 24);
    for (const Form& form : all) {
        const TemporaryFolder folder;
        CAPTURE(form.name);
        const fs::path given = written(form, folder.path());
        Found found;
        const auto check = [&](const DepthStatement& told, const std::string& assumed) {
            CHECK(refusal([&] { found = found_in(given, told, form.share); }) == "");
            CHECK(found.error <= form.loss);
            CHECK(found.levels >= form.levels);
            CHECK(found.missing == 0);
            CHECK(found.assumed == assumed);
            CHECK(found.shows_photo == form.has_photo);
        };
        check(form.told, form.assumed);
        check(found.meaning, "");  // and where somebody says all of it
    }
}
