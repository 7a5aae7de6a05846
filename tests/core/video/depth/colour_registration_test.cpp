// Two cameras side by side see a board before a wall, through lenses as in real devices.
#include "core/video/depth/colour_registration.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/video/depth/camera.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

const cv::Size kDepthSize(640, 576);
const cv::Size kColourSize(1280, 720);

constexpr double kWall_mm = 2500.0;
constexpr double kBoard_mm = 800.0;
constexpr double kHalfBoard_mm = 150.0;

/// The parameters of a device that was sold, turned a little more than usual.
std::string calibration() {
    return R"({"CalibrationInformation": {"Cameras": [
        {"Location": "CALIBRATION_CameraLocationD0", "SensorWidth": 1024, "SensorHeight": 1024,
         "MetricRadius": 1.74,
         "Rt": {"Rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "Translation": [0, 0, 0]},
         "Intrinsics": {"ModelParameters": [0.50127333402633667, 0.50319623947143555,
             0.49252399802207947, 0.49259248375892639, 6.0841460227966309, 4.3754911422729492,
             0.23618598282337189, 6.4087333679199219, 6.4182958602905273, 1.2202920913696289, 0, 0,
             6.5029336838051677e-05, -5.5295702622970566e-05]}},
        {"Location": "CALIBRATION_CameraLocationPV0", "SensorWidth": 4096, "SensorHeight": 3072,
         "MetricRadius": 0,
         "Rt": {"Rotation": [1, 0, 0, 0, 0.99500416527802582, 0.099833416646828155,
                             0, -0.099833416646828155, 0.99500416527802582],
                "Translation": [-0.032, -0.002, 0.004]},
         "Intrinsics": {"ModelParameters": [0.498662531375885, 0.50206762552261353,
             0.47818887233734131, 0.63736248016357422, 0.58438080549240112, -2.4942491054534912,
             1.3602830171585083, 0.46475523710250854, -2.3362464904785156, 1.3011596202850342, 0, 0,
             -0.00017650700465310365, 0.0006530816899612546]}}]}})";
}

CameraPair cameras() {
    return azure_kinect_cameras(calibration(), kDepthSize).value();
}

bool on_board(cv::Vec3d place_mm) {
    return std::fabs(place_mm[0]) < kHalfBoard_mm && std::fabs(place_mm[1]) < kHalfBoard_mm;
}

/// Where a line from a point on meets the board or the wall, in the depth camera's axes.
cv::Vec3d met(cv::Vec3d from_mm, cv::Vec3d along) {
    const auto at = [&](double depth_mm) {
        return from_mm + along * ((depth_mm - from_mm[2]) / along[2]);
    };
    const bool before_board = from_mm[2] < kBoard_mm - 1.0;
    return before_board && on_board(at(kBoard_mm)) ? at(kBoard_mm) : at(kWall_mm);
}

/// Blue to the right and green down on both; the board is also red.
cv::Vec3b paint(cv::Vec3d place_mm) {
    const auto shade = [](double along_mm, double period_mm) {
        return cv::saturate_cast<unsigned char>(128.0 + 100.0 * std::sin(along_mm / period_mm));
    };
    const double period_mm = place_mm[2] < kWall_mm - 1.0 ? 80.0 : 300.0;
    return {shade(place_mm[0], period_mm), shade(place_mm[1], period_mm),
            static_cast<unsigned char>(place_mm[2] < kWall_mm - 1.0 ? 200 : 0)};
}

cv::Vec3d colour_camera_mm(const CameraPair& pair) {
    return -(pair.to_colour.rotation.t() * pair.to_colour.shift_mm);
}

cv::Mat made_colour(const CameraPair& pair, cv::Size size) {
    const CameraModel camera = camera_for(size, pair.colour, pair.colour_size);
    const cv::Vec3d there = colour_camera_mm(pair);
    cv::Mat picture(size, CV_8UC3);
    for (int j = 0; j < picture.rows; ++j) {
        for (int i = 0; i < picture.cols; ++i) {
            const cv::Point2d ray = camera.ray_of({1.0 * i, 1.0 * j});
            const cv::Vec3d along = pair.to_colour.rotation.t() * cv::Vec3d(ray.x, ray.y, 1.0);
            picture.at<cv::Vec3b>(j, i) = paint(met(there, along));
        }
    }
    return picture;
}

cv::Mat made_depth(const CameraPair& pair) {
    cv::Mat depth_mm(kDepthSize, CV_32FC1);
    for (int j = 0; j < depth_mm.rows; ++j) {
        for (int i = 0; i < depth_mm.cols; ++i) {
            const cv::Point2d ray = pair.depth.ray_of({1.0 * i, 1.0 * j});
            depth_mm.at<float>(j, i) = static_cast<float>(met({}, {ray.x, ray.y, 1.0})[2]);
        }
    }
    return depth_mm;
}

/// Of `cameras()`, made once for all cases.
const cv::Mat& colour_seen() {
    static const cv::Mat picture = made_colour(cameras(), kColourSize);
    return picture;
}

const cv::Mat& depth_seen() {
    static const cv::Mat depth_mm = made_depth(cameras());
    return depth_mm;
}

/// How well the colours of a picture over the depth fit the scene that the depth camera sees: at
/// each third pixel of each third row.
struct Fitness {
    int compared{0};
    double most_off{0.0};  ///< of a level, where both cameras look at one thing, off its border
    int hidden{0};         ///< pixels of the wall that the board hides from the colour camera
    int ghosts{0};         ///< of them, those in the board's colour
};

Fitness fitness_of(const cv::Mat& registered, const CameraPair& pair, cv::Size size = kColourSize) {
    const CameraModel camera = camera_for(size, pair.colour, pair.colour_size);
    const cv::Vec3d there = colour_camera_mm(pair);
    const int finer = registered.cols / kDepthSize.width;
    Fitness fitness;
    for (int j = 2; j + 2 < kDepthSize.height; j += 3) {
        for (int i = 2; i + 2 < kDepthSize.width; i += 3) {
            const auto place = [&](double x, double y) {
                const cv::Point2d ray = pair.depth.ray_of({x, y});
                return met({}, {ray.x, ray.y, 1.0});
            };
            // The middle of the finer pixel that is nearest to the depth pixel's.
            const double off = 0.5 / finer - 0.5 + std::floor(0.5 * finer) / finer;
            const cv::Vec3d seen = place(i + off, j + off);
            const cv::Vec3b colour =
                registered.at<cv::Vec3b>(finer * j + static_cast<int>(0.5 * finer),
                                         finer * i + static_cast<int>(0.5 * finer));
            const cv::Vec3d from_colour = pair.to_colour.rotation * seen + pair.to_colour.shift_mm;
            const cv::Point2d pixel =
                camera.pixel_of({from_colour[0] / from_colour[2], from_colour[1] / from_colour[2]});
            if (!cv::Rect2d(2, 2, size.width - 4, size.height - 4).contains(pixel)) continue;
            const bool is_hidden = cv::norm(met(there, seen - there) - seen) > 1.0;
            const bool is_red = colour[2] > 100;
            fitness.hidden += is_hidden ? 1 : 0;
            fitness.ghosts += is_hidden && is_red ? 1 : 0;
            const auto is_border = [&](double x, double y) {
                const cv::Vec3d beside = place(i + x, j + y);
                return beside[2] != seen[2] || cv::norm(met(there, beside - there) - beside) > 1.0;
            };
            if (is_hidden || is_border(-2, 0) || is_border(2, 0) || is_border(0, -2) ||
                is_border(0, 2) || is_border(-4, 0) || is_border(4, 0))
                continue;
            ++fitness.compared;
            fitness.most_off =
                std::max(fitness.most_off,
                         cv::norm(cv::Vec3d(colour) - cv::Vec3d(paint(seen)), cv::NORM_INF));
        }
    }
    return fitness;
}

}  // namespace

TEST_CASE("a lens bends rays to pixels and back", "[registration]") {
    const CameraPair pair = cameras();
    for (int j = 0; j < kDepthSize.height; j += 16) {
        for (int i = 0; i < kDepthSize.width; i += 16) {
            const cv::Point2d pixel(i, j);
            REQUIRE(cv::norm(pair.depth.pixel_of(pair.depth.ray_of(pixel)) - pixel) < 0.001);
        }
    }
    const CameraModel wide = azure_kinect_depth_camera(calibration(), {1024, 1024}).value();
    CHECK(cv::norm(wide.pixel_of(wide.ray_of({512.0, 100.0})) - cv::Point2d(512.0, 100.0)) < 0.001);
    CHECK(std::isnan(wide.ray_of({0.0, 0.0}).x));  // beyond its radius nothing is seen
    CHECK(std::isnan(wide.pixel_of({1.8, 0.0}).x));
    const FloatLens fast(wide.lens());
    for (const cv::Point2d ray : {cv::Point2d(0.3, -0.2), cv::Point2d(-1.2, 1.1)}) {
        const auto seen = fast.distorted(static_cast<float>(ray.x), static_cast<float>(ray.y));
        const Intrinsics& i = wide.intrinsics();
        const cv::Point2d pixel(i.cx + i.fx * double{seen.x}, i.cy + i.fy * double{seen.y});
        CHECK(cv::norm(pixel - wide.pixel_of(ray)) < 0.001);
    }
    CHECK_FALSE(fast.distorted(1.8F, 0.0F).known);
    CHECK(wide.pixel_of({0.0, 0.0}).x == wide.intrinsics().cx);
}

TEST_CASE("a lens that no glass has sees nothing, and that is found out soon", "[registration]") {
    const Lens mad{{1e5, -1e5, 1e5, -1e4, 0.0, 0.0}, 9.0, -9.0};
    const CameraModel camera(Intrinsics{500.0, 500.0, 320.0, 240.0}, mad);
    CHECK(std::isnan(camera.ray_of({600.0, 400.0}).x));
}

TEST_CASE("a camera's other pictures are cut out of the same sensor", "[registration]") {
    const CameraModel whole(Intrinsics{2000.0, 2010.0, 2047.5, 1535.5});
    const auto as = [&](cv::Size size) {
        return camera_for(size, whole, {4096, 3072}).intrinsics();
    };
    CHECK(as({4096, 3072}) == whole.intrinsics());
    CHECK(as({2048, 1536}) == Intrinsics{1000.0, 1005.0, 1023.5, 767.5});
    CHECK(as({3840, 2160}) == Intrinsics{1875.0, 1884.375, 1919.5, 1079.5});
}

TEST_CASE("each pixel of the depth is in the colour that the other camera sees there",
          "[registration]") {
    const CameraPair pair = cameras();
    const cv::Size size = GENERATE(some_of<cv::Size>({{1280, 720}, {1600, 900}}, 1));
    CAPTURE(size.width);
    ColourRegistration registration(kDepthSize, pair, kWall_mm);
    const cv::Mat colour = size == kColourSize ? colour_seen() : made_colour(pair, size);
    const cv::Mat registered = registration.seen_from_depth(depth_seen(), colour);
    CHECK(registered.cols * kDepthSize.height == registered.rows * kDepthSize.width);
    CHECK(registered.cols == (size.width > 1500 ? 2 : 1) * kDepthSize.width);
    const Fitness fitness = fitness_of(registered, pair, size);
    CAPTURE(fitness.compared, fitness.hidden);
    REQUIRE(fitness.compared > 22'000);
    CHECK(fitness.most_off <= 4.0);
    REQUIRE(fitness.hidden > 110);
    CHECK(fitness.ghosts < fitness.hidden / 20);
    cv::Mat stretched;  // as of one camera
    cv::resize(colour, stretched, registered.size());
    CHECK(fitness_of(stretched, pair, size).most_off > 50.0);
    const cv::Mat again = registration.seen_from_depth(depth_seen(), colour);
    CHECK(cv::norm(again, registered, cv::NORM_INF) == 0.0);
}

TEST_CASE("where there is no depth the colour is that of what is behind", "[registration]") {
    const CameraPair pair = cameras();
    ColourRegistration registration(kDepthSize, pair, kWall_mm);
    cv::Mat depth_mm = depth_seen().clone();
    const cv::Rect hole(20, 250, 30, 40);  // in the wall
    depth_mm(hole).setTo(std::nanf(""));
    const cv::Mat registered = registration.seen_from_depth(depth_mm, colour_seen());
    const Fitness fitness = fitness_of(registered, pair);
    REQUIRE(fitness.compared > 22'000);
    CHECK(fitness.most_off <= 4.0);
    depth_mm.setTo(std::nanf(""));  // as far as the wall, then
    const cv::Mat all = registration.seen_from_depth(depth_mm, colour_seen());
    const cv::Rect wall(20, 470, 200, 100);
    CHECK(cv::norm(all(wall), registered(wall), cv::NORM_INF) <= 4.0);
}

TEST_CASE("a recording with a calibration is registered by it, and says so", "[registration]") {
    const TemporaryFolder folder;
    const CameraPair pair = cameras();
    cv::Mat depth;
    depth_seen().convertTo(depth, CV_16U);
    cv::imwrite((folder / "depth.png").string(), depth);
    cv::imwrite((folder / "colour.png").string(), colour_seen());
    write_text(folder / "calibration.json", calibration());
    ffmpeg("-loop 1 -framerate 10 -t 0.3 -i '" + (folder / "colour.png").string() +
           "' -loop 1 -framerate 10 -t 0.3 -i '" + (folder / "depth.png").string() +
           "' -map 0 -map 1 -c:v:0 ffv1 -pix_fmt:v:0 bgr0 -c:v:1 ffv1 -pix_fmt:v:1 gray16le "
           "-metadata:s:v:0 title=COLOR -metadata:s:v:1 title=DEPTH -metadata:s:v:1 "
           "K4A_DEPTH_MODE=NFOV_UNBINNED -attach '" +
           (folder / "calibration.json").string() +
           "' -metadata:s:t mimetype=application/octet-stream '" + (folder / "k.mkv").string() +
           "'");
    const auto media = open_media(folder / "k.mkv", {}, {.find_out = true});
    CHECK(media->description().registered_by == "Azure Kinect calibration");
    const auto frame = media->next();
    REQUIRE(frame);
    cv::Mat shown(frame->colour.rows, frame->colour.columns, CV_8UC3);
    for (int j = 0; j < shown.rows; ++j) {
        for (int i = 0; i < shown.cols; ++i) {
            const std::size_t at =
                3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(shown.cols) +
                     static_cast<std::size_t>(i));
            const auto& rgb = frame->colour.rgb;
            shown.at<cv::Vec3b>(j, i) = {rgb[at + 2], rgb[at + 1], rgb[at]};
        }
    }
    const Fitness fitness = fitness_of(shown, pair);
    REQUIRE(fitness.compared > 22'000);
    CHECK(fitness.most_off <= 6.0);
    CHECK(fitness.ghosts < fitness.hidden / 20);
}

TEST_CASE("colour is moved by depth pixels and stretched about its middle", "[registration]") {
    cv::Mat colour(48, 64, CV_8UC3, cv::Scalar::all(0));
    colour.at<cv::Vec3b>(20, 30) = {255, 255, 255};
    const cv::Size depth(32, 24);  // half as many pixels
    CHECK(apply_registration(colour, {}, depth).data == colour.data);
    const cv::Mat right = apply_registration(colour, {3.0, -2.0, 1.0}, depth);
    CHECK(right.at<cv::Vec3b>(16, 36)[0] == 255);
    CHECK(right.at<cv::Vec3b>(40, 2)[0] == kNoColour);  // six columns and four rows came in
    CHECK(cv::countNonZero(right.reshape(1) != 0) == 3 * (1 + 6 * 48 + 4 * (64 - 6)));
    const cv::Mat large = apply_registration(colour, {0.0, 0.0, 3.0}, depth);
    CHECK(large.size() == colour.size());
    CHECK(large.at<cv::Vec3b>(13, 27)[0] == 255);  // 23.5 + 3 * (20 - 23.5), 31.5 + 3 * (30 - 31.5)
    CHECK(apply_registration(cv::Mat(), {3.0, -2.0, 1.0}, depth).empty());
}

TEST_CASE("a registration that a person gives moves the colour of a pair", "[registration]") {
    const TemporaryFolder folder;
    write_picture(folder / "a_depth.png", 32, 24, 8, 1, [](int i, int, int) { return 8 * i; });
    write_picture(folder / "a_color.png", 64, 48, 8, 3,
                  [](int i, int j, int) { return i == 30 && j == 20 ? 255 : 0; });
    DepthRequest request{.find_out = true};
    const auto brightest = [&] {
        const auto media = open_media(folder / "a_color.png", folder / "a_depth.png", request);
        const ColourImage colour = media->next()->colour;
        const auto found = std::max_element(colour.rgb.begin(), colour.rgb.end());
        return (found - colour.rgb.begin()) / 3;
    };
    CHECK(brightest() == 20 * 64 + 30);
    request.command_line.registration = Registration{3.0, -2.0, 1.0};
    CHECK(brightest() == 16 * 64 + 36);
    request.command_line = {};
    write_text(folder / "a_depth.toml", "[depth]\nregistration = [-1, 1, 1]\n");
    CHECK(brightest() == 22 * 64 + 28);
}
