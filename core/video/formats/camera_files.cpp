// Parses matrices of numbers, and JSON.
#include "core/video/formats/camera_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/files/text_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongest_bytes = 1 << 20;

/// A discarded value when it is no JSON, or too long. Ignores zero bytes after the text.
Json json_of(const std::string& text) {
    if (text.size() > kLongest_bytes) return Json::value_t::discarded;
    return parsed_json(text.substr(0, text.find('\0')));
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

/// A side of a picture, by the first of these names that is there.
int side_in(const Json& json, const char* name, const char* short_name) {
    const int side = whole_in(json, name);
    return side > 0 ? side : whole_in(json, short_name);
}

void take_scale(CameraFile& camera, double levels_per_m) {
    if (levels_per_m > 0.0 && std::isfinite(levels_per_m)) camera.levels_per_m = levels_per_m;
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

/// The part of the sensor that a mode of the Azure Kinect's depth camera shows; the sensor may be
/// halved first (Azure-Kinect-Sensor-SDK, mode_specific_calibration.c).
struct KinectMode {
    int columns, rows;
    int sensor;  ///< columns and rows of the sensor, in pixels of this mode
    int left, top;
};
constexpr std::array kKinectModes{
    KinectMode{320, 288, 512, 96, 90}, KinectMode{640, 576, 1024, 192, 180},
    KinectMode{512, 512, 512, 0, 0}, KinectMode{1024, 1024, 1024, 0, 0}};

/// The JSON of the camera at that location; a discarded value when there is none.
Json camera_in(const Json& calibration, const char* location) {
    const Json::json_pointer place("/CalibrationInformation/Cameras");
    if (!calibration.is_object() || !calibration.contains(place)) return Json::value_t::discarded;
    for (const Json& camera : calibration.at(place)) {
        const bool is_it =
            camera.is_object() && camera.contains("Location") && camera["Location"] == location;
        if (is_it && camera.contains("Intrinsics") && camera["Intrinsics"].is_object())
            return camera;
    }
    return Json::value_t::discarded;
}

/// The stored camera, for a sensor of size 1 with its corner at 0, 0. Order of the parameters as in
/// k4a_calibration_intrinsic_parameters_t: cx, cy, fx, fy, k1 to k6, two zeros, p2, p1.
std::optional<CameraModel> unit_camera(const Json& camera) {
    constexpr std::size_t kParameters = 14;
    constexpr double kUsualRadius = 1.7;  // where the calibration has none
    if (!camera.is_object()) return std::nullopt;
    const std::vector<double> p = numbers_in(camera["Intrinsics"], "ModelParameters");
    if (p.size() < 4) return std::nullopt;
    Lens lens;
    if (p.size() >= kParameters) {
        lens = {{p[4], p[5], p[6], p[7], p[8], p[9]}, p[13], p[12], kUsualRadius};
        const double radius = number_in(camera, "MetricRadius").value_or(0.0);
        if (radius > 0.0001) lens.widest = radius;
    }
    const bool finite =
        std::all_of(p.begin(), p.end(), [](double number) { return std::abs(number) < 1e6; });
    return finite ? std::optional(CameraModel({p[2], p[3], p[0], p[1]}, lens)) : std::nullopt;
}

/// The camera of a picture at `left`, `top` of a sensor of that size. Our origin is the centre of
/// the first pixel, theirs its corner.
CameraModel cut_out(const CameraModel& unit, cv::Size sensor, int left, int top) {
    const Intrinsics& i = unit.intrinsics();
    return {Intrinsics{i.fx * sensor.width, i.fy * sensor.height, i.cx * sensor.width - left - 0.5,
                       i.cy * sensor.height - top - 0.5},
            unit.lens()};
}

/// The placement relative to the depth camera, whose axes all cameras use.
std::optional<Placement> placement_of(const Json& camera) {
    if (!camera.contains("Rt") || !camera["Rt"].is_object()) return std::nullopt;
    const std::vector<double> rotation = numbers_in(camera["Rt"], "Rotation");
    const std::vector<double> shift_m = numbers_in(camera["Rt"], "Translation");
    if (rotation.size() != 9 || shift_m.size() != 3) return std::nullopt;
    const Placement placement{cv::Matx33d(rotation.data()), 1000.0 * cv::Vec3d(shift_m.data())};
    return is_placement(placement) ? std::optional(placement) : std::nullopt;
}

}  // namespace

std::optional<CameraFile> read_camera_matrix(const fs::path& file) {
    std::string numbers = small_text_in(file).value_or("");
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream text(numbers);
    std::vector<double> m;
    for (double number = 0.0; m.size() < 17 && text >> number;) m.push_back(number);
    if (m.size() != 9 && m.size() != 16) return std::nullopt;
    const std::size_t row = m.size() == 9 ? 3 : 4;
    CameraFile camera;
    camera.intrinsics = {m[0], m[row + 1], m[2], m[row + 2]};
    return camera;
}

std::optional<CameraFile> read_camera_json(const fs::path& file) {
    Json json = json_of(small_text_in(file).value_or(""));
    if (!json.is_object()) return std::nullopt;
    const bool is_inside = json.contains("camera") && json["camera"].is_object();
    if (is_inside) json = Json(json["camera"]);
    const std::vector<double> columns = numbers_in(json, "intrinsic_matrix");
    const std::vector<double> rows = numbers_in(json, "intrinsics");
    CameraFile camera;
    if (columns.size() == 9)
        camera.intrinsics = {columns[0], columns[4], columns[6], columns[7]};
    else if (rows.size() == 9)
        camera.intrinsics = {rows[0], rows[4], rows[2], rows[5]};
    else if (json.contains("fx") && json.contains("cx"))
        camera.intrinsics = {
            number_in(json, "fx").value_or(0.0), number_in(json, "fy").value_or(0.0),
            number_in(json, "cx").value_or(0.0), number_in(json, "cy").value_or(0.0)};
    else
        return std::nullopt;
    camera.columns = side_in(json, "width", "w");
    camera.rows = side_in(json, "height", "h");
    take_scale(camera, number_in(json, is_inside ? "scale" : "depth_scale").value_or(0.0));
    return camera;
}

std::optional<CameraFile> read_camera_bop(const fs::path& file, int number) {
    const Json scene = json_of(small_text_in(file).value_or(""));
    if (!scene.is_object() || scene.empty()) return std::nullopt;
    const auto named = scene.find(std::to_string(number));
    const Json& picture = named == scene.end() ? *scene.begin() : *named;
    if (!picture.is_object()) return std::nullopt;
    CameraFile camera;
    const std::vector<double> rows = numbers_in(picture, "cam_K");
    if (rows.size() == 9) camera.intrinsics = {rows[0], rows[4], rows[2], rows[5]};
    take_scale(camera, 1000.0 / number_in(picture, "depth_scale").value_or(0.0));
    return camera;
}

std::optional<InverseLevels> read_stereo_calibration(const fs::path& file, int columns) {
    std::istringstream text(small_text_in(file).value_or(""));
    double focal_px = 0.0;
    double baseline_mm = 0.0;
    double width = 0.0;
    double doffs = 0.0;
    for (std::string line; std::getline(text, line);) {
        const auto value = [&line](const std::string& begin, double& into) {
            if (line.starts_with(begin)) std::istringstream(line.substr(begin.size())) >> into;
        };
        value("cam0=[", focal_px);
        value("baseline=", baseline_mm);
        value("width=", width);
        value("doffs=", doffs);
    }
    const double scale = width > 0.0 ? columns / width : 1.0;
    const InverseLevels law{focal_px * scale * baseline_mm, doffs * scale};
    const bool is_law = law.factor_mm > 0.0 && std::isfinite(law.factor_mm) &&
                        std::isfinite(law.offset) && scale > 0.0;
    return is_law ? std::optional(law) : std::nullopt;
}

std::optional<CameraFile> read_camera_pincam(const fs::path& file) {
    std::istringstream text(small_text_in(file).value_or(""));
    CameraFile camera;
    Intrinsics& k = camera.intrinsics;
    double columns = 0.0;
    double rows = 0.0;
    if (!(text >> columns >> rows >> k.fx >> k.fy >> k.cx >> k.cy)) return std::nullopt;
    constexpr double kMost = 1e6;
    if (!(columns >= 1.0 && rows >= 1.0 && columns < kMost && rows < kMost)) return std::nullopt;
    camera.columns = static_cast<int>(columns);
    camera.rows = static_cast<int>(rows);
    return camera;
}

std::optional<CameraModel> azure_kinect_depth_camera(const std::string& json, cv::Size depth) {
    constexpr int kSensor = 1024;
    const auto mode =
        std::find_if(kKinectModes.begin(), kKinectModes.end(), [=](const KinectMode& candidate) {
            return cv::Size(candidate.columns, candidate.rows) == depth;
        });
    if (mode == kKinectModes.end()) return std::nullopt;
    const Json camera = camera_in(json_of(json), "CALIBRATION_CameraLocationD0");
    if (!camera.is_object() || whole_in(camera, "SensorWidth") != kSensor ||
        whole_in(camera, "SensorHeight") != kSensor)
        return std::nullopt;
    const auto unit = unit_camera(camera);
    if (!unit) return std::nullopt;
    const CameraModel found = cut_out(*unit, {mode->sensor, mode->sensor}, mode->left, mode->top);
    return is_camera(found.intrinsics()) ? std::optional(found) : std::nullopt;
}

std::optional<CameraPair> azure_kinect_cameras(const std::string& json, cv::Size depth) {
    const auto depth_camera = azure_kinect_depth_camera(json, depth);
    const Json camera = camera_in(json_of(json), "CALIBRATION_CameraLocationPV0");
    const auto unit = unit_camera(camera);
    if (!depth_camera || !unit) return std::nullopt;
    const auto placement = placement_of(camera);
    const cv::Size size(whole_in(camera, "SensorWidth"), whole_in(camera, "SensorHeight"));
    const CameraPair pair{*depth_camera, cut_out(*unit, size, 0, 0), size,
                          placement.value_or(Placement{}), "Azure Kinect calibration"};
    const bool is_whole = placement && is_camera(pair.colour.intrinsics());
    return is_whole ? std::optional(pair) : std::nullopt;
}

}  // namespace dibhr
