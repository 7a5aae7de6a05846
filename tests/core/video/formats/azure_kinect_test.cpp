// Recordings of an Azure Kinect: two tracks and the calibration attached to them.
#include <cmath>
#include <filesystem>
#include <string>

#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// As the device writes it: of a sensor of size 1, whose corner is 0, 0.
std::string calibration(const std::string& sensor = "1024",
                        const std::string& focal_length = "0.4921875") {
    return R"({"CalibrationInformation": {"Cameras": [
        {"Location": "CALIBRATION_CameraLocationPV0", "SensorWidth": 4096, "SensorHeight": 3072,
         "Intrinsics": {"ModelParameters": [0.5, 0.5, 0.45, 0.6, 0, 0]}},
        {"Location": "CALIBRATION_CameraLocationD0", "SensorWidth": )" +
           sensor + R"(, "SensorHeight": )" + sensor + R"(,
         "Intrinsics": {"ModelParameterCount": 14, "ModelParameters":
             [0.50390625, 0.498046875, )" +
           focal_length + R"(, 0.4931640625, 0.5, 0.25]}}]}})";
}

/// FFV1, because ffmpeg does not write the raw big-endian pictures of the device so that it could
/// read them again.
void record(const fs::path& file, const fs::path& calibration, const std::string& size) {
    ffmpeg("-f lavfi -i testsrc2=s=64x48:d=0.3:r=10 -f lavfi -i \"color=gray:s=" + size +
           ":d=0.3:r=10,format=gray16le,geq=lum='1000+N'\" -map 0 -map 1 -c:v:0 mjpeg -c:v:1 ffv1 "
           "-pix_fmt:v:1 gray16le -metadata:s:v:0 title=COLOR -metadata:s:v:1 title=DEPTH "
           "-metadata:s:v:1 K4A_DEPTH_MODE=ANY -attach '" +
           calibration.string() + "' -metadata:s:t mimetype=application/octet-stream '" +
           file.string() + "'");
}

}  // namespace

TEST_CASE(
    "the calibration is for the sensor, and the mode's part of it is cut out as Microsoft's "
    "SDK does",
    "[azure]") {
    // Sensor: f = 504, 505 and c = 516, 510 of 1024 pixels, from the corner.
    const auto camera = [](int columns, int rows) {
        return azure_kinect_depth_camera(calibration(), {columns, rows}).value().intrinsics();
    };
    CHECK(camera(1024, 1024) == Intrinsics{504.0, 505.0, 515.5, 509.5});
    CHECK(camera(640, 576) == Intrinsics{504.0, 505.0, 515.5 - 192.0, 509.5 - 180.0});
    CHECK(camera(512, 512) == Intrinsics{252.0, 252.5, 257.5, 254.5});
    CHECK(camera(320, 288) == Intrinsics{252.0, 252.5, 257.5 - 96.0, 254.5 - 90.0});
}

TEST_CASE("a calibration that is broken, or not for these pictures, says nothing", "[azure]") {
    CHECK_FALSE(azure_kinect_depth_camera(calibration(), {640, 480}));
    CHECK_FALSE(azure_kinect_depth_camera(calibration("512"), {640, 576}));
    for (const char* const no_length : {"0", "1e-300", "-0.5", "1e5"})
        CHECK_FALSE(azure_kinect_depth_camera(calibration("1024", no_length), {640, 576}));
    const std::string text = calibration();
    for (const std::string& broken :
         {std::string(), text.substr(0, text.size() - 5), std::string("[]"), std::string("null"),
          std::string(R"({"CalibrationInformation": 3})"),
          std::string(R"({"CalibrationInformation": {"Cameras": 3}})"),
          std::string(R"({"CalibrationInformation": {"Cameras": [3, {}, {"Location": 4}]}})"),
          std::string(100'000, '[')}) {
        CAPTURE(broken.substr(0, 80));
        CHECK_FALSE(azure_kinect_depth_camera(broken, {640, 576}));
    }
    CHECK(azure_kinect_depth_camera(text + std::string(3, '\0'), {640, 576}));
}

TEST_CASE("a recording opens as colour and depth, in millimetres, with its depth camera",
          "[azure]") {
    const TemporaryFolder folder;
    write_text(folder / "calibration.json", calibration());
    record(folder / "k.mkv", folder / "calibration.json", "640x576");
    const auto media = open_media(folder / "k.mkv");
    CHECK(media->description().colour_columns == 64);
    CHECK(media->description().depth_columns == 640);
    const VideoFile depth(folder / "k.mkv", PictureRole::depth, 1);
    CHECK(depth.facts().bits == 16);
    CHECK(stated_by(depth.facts()).unit == DepthUnit::mm);
    CHECK(stated_by(depth.facts()).scale == 1.0);
    CHECK(stated_by(depth.facts()).no_data == std::vector<double>{0.0});
    CHECK(stated_by(depth.facts()).intrinsics == Intrinsics{504.0, 505.0, 323.5, 329.5});
    CHECK(origins_of(depth.facts().findings) == "Azure Kinect calibration");
    const VideoFile colour(folder / "k.mkv", PictureRole::colour, 0);
    CHECK(stated_by(colour.facts()) == DepthStatement{});
}

TEST_CASE("a recording whose calibration is not readable is in millimetres all the same",
          "[azure]") {
    const TemporaryFolder folder;
    write_text(folder / "calibration.json", "{}");
    record(folder / "k.mkv", folder / "calibration.json", "320x288");
    const VideoFile depth(folder / "k.mkv", PictureRole::depth, 1);
    CHECK(stated_by(depth.facts()).unit == DepthUnit::mm);
    CHECK_FALSE(stated_by(depth.facts()).intrinsics);
    CHECK(origins_of(depth.facts().findings) == "Azure Kinect recording");
}
