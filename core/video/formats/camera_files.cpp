// Reads matrices of numbers, and JSON.
#include "core/video/formats/camera_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "core/files/json.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLongest_bytes = 1 << 20;

/// Empty when it cannot be read, or is too long for a camera.
std::string text_of(const fs::path& file) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed) || fs::file_size(file, failed) > kLongest_bytes)
        return {};
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// A discarded value when it is no JSON, or too long. Zeros behind it belong to what held it.
Json json_of(const std::string& text) {
    if (text.size() > kLongest_bytes) return Json::value_t::discarded;
    return Json::parse(text.substr(0, text.find('\0')), nullptr, false);
}

std::optional<double> number_in(const Json& json, const char* name) {
    const auto found = json.find(name);
    if (found == json.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

int whole_in(const Json& json, const char* name) {
    constexpr double kMost = 1e6;
    const double number = number_in(json, name).value_or(0.0);
    return number > 0.0 && number < kMost ? static_cast<int>(number) : 0;
}

std::vector<double> numbers_in(const Json& json, const char* name) {
    std::vector<double> numbers;
    const auto found = json.find(name);
    if (found == json.end() || !found->is_array()) return numbers;
    for (const Json& number : *found) {
        if (!number.is_number()) return {};
        numbers.push_back(number.get<double>());
    }
    return numbers;
}

/// How a mode of the Azure Kinect's depth camera cuts its picture out of the sensor's, which may be
/// halved before (Azure-Kinect-Sensor-SDK, mode_specific_calibration.c).
struct KinectMode {
    int columns, rows;
    int sensor;  ///< its columns and rows, of this mode's pixels
    int left, top;
};
constexpr std::array kKinectModes{
    KinectMode{320, 288, 512, 96, 90}, KinectMode{640, 576, 1024, 192, 180},
    KinectMode{512, 512, 512, 0, 0}, KinectMode{1024, 1024, 1024, 0, 0}};

/// The depth camera's; a discarded value when there is none.
Json depth_camera_in(const Json& calibration) {
    const Json::json_pointer place("/CalibrationInformation/Cameras");
    if (!calibration.is_object() || !calibration.contains(place)) return Json::value_t::discarded;
    for (const Json& camera : calibration.at(place)) {
        const bool is_depth = camera.is_object() && camera.contains("Location") &&
                              camera["Location"] == "CALIBRATION_CameraLocationD0";
        if (is_depth && camera.contains("Intrinsics") && camera["Intrinsics"].is_object())
            return camera;
    }
    return Json::value_t::discarded;
}

}  // namespace

std::optional<CameraFile> read_camera_matrix(const fs::path& file) {
    std::istringstream text(text_of(file));
    std::vector<double> m;
    for (double number = 0.0; m.size() < 17 && text >> number;) m.push_back(number);
    if (m.size() != 9 && m.size() != 16) return std::nullopt;
    const std::size_t row = m.size() == 9 ? 3 : 4;
    CameraFile camera;
    camera.intrinsics = {m[0], m[row + 1], m[2], m[row + 2]};
    return is_camera(camera.intrinsics) ? std::optional(camera) : std::nullopt;
}

std::optional<CameraFile> read_camera_json(const fs::path& file) {
    const Json json = json_of(text_of(file));
    if (!json.is_object()) return std::nullopt;
    const std::vector<double> m = numbers_in(json, "intrinsic_matrix");
    if (m.size() != 9) return std::nullopt;
    CameraFile camera;
    camera.intrinsics = {m[0], m[4], m[6], m[7]};
    camera.columns = whole_in(json, "width");
    camera.rows = whole_in(json, "height");
    const double scale = number_in(json, "depth_scale").value_or(0.0);
    if (scale > 0.0 && std::isfinite(scale)) camera.levels_per_m = scale;
    return is_camera(camera.intrinsics) ? std::optional(camera) : std::nullopt;
}

std::optional<Intrinsics> azure_kinect_intrinsics(const std::string& json, int columns, int rows) {
    constexpr int kSensor = 1024;
    const auto mode =
        std::find_if(kKinectModes.begin(), kKinectModes.end(), [=](const KinectMode& candidate) {
            return candidate.columns == columns && candidate.rows == rows;
        });
    if (mode == kKinectModes.end()) return std::nullopt;
    const Json camera = depth_camera_in(json_of(json));
    if (!camera.is_object() || whole_in(camera, "SensorWidth") != kSensor ||
        whole_in(camera, "SensorHeight") != kSensor)
        return std::nullopt;
    const std::vector<double> p = numbers_in(camera["Intrinsics"], "ModelParameters");
    if (p.size() < 4) return std::nullopt;
    // Of a sensor of size 1, whose corner is 0, 0; ours is the centre of its first pixel.
    const double size = mode->sensor;
    const Intrinsics found{p[2] * size, p[3] * size, p[0] * size - mode->left - 0.5,
                           p[1] * size - mode->top - 0.5};
    return is_camera(found) ? std::optional(found) : std::nullopt;
}

}  // namespace dibhr
