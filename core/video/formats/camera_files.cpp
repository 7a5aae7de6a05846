// Parses matrices of numbers, and JSON.
#include "core/video/formats/camera_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/files/text_file.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/numpy_array.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongest_bytes = 1 << 20;

constexpr std::array<std::string_view, 6> kScaleNames{"integer_depth_scale", "depth_scale",
                                                      "depth_factor",        "factor_depth",
                                                      "depth_map_factor",    "png_depth_scale"};
constexpr std::array kMatrixNames{"intrinsics",       "K", "k", "cam_K", "camera_matrix",
                                  "camera_intrinsics"};
constexpr std::array kObjectNames{"depth_intrinsics", "depth", "intrinsics", "camera"};
constexpr std::array kJsonFiles{"depth_intrinsics.json",
                                "depth_camera.json",
                                "intrinsics.json",
                                "intrinsic.json",
                                "camera.json",
                                "transforms.json",
                                "camera_intrinsics.json",
                                "camera_info.json",
                                "camera_intrinsic.json",
                                "camera_params.json",
                                "cam_params.json",
                                "calibration.json",
                                "calib.json",
                                "depth_scale.json"};
constexpr std::array kMatrixFiles{
    "camK.npy", "cam_K.npy", "K.npy", "intrinsics.npy", "intrinsic.npy", "camera_matrix.npy",
    "camK.txt", "cam_K.txt", "K.txt", "intrinsics.txt", "intrinsic.txt", "camera-intrinsics.txt"};

/// A discarded value when it is no JSON, or too long. Ignores zero bytes after the text.
Json json_of(const std::string& text) {
    if (text.size() > kLongest_bytes) return Json::value_t::discarded;
    return parsed_json(text.substr(0, text.find('\0')));
}

int whole_in(const Json& json, const char* name) {
    constexpr double kMost = 1e6;
    const double number = finite_number_in(json, name).value_or(0.0);
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

/// The nine numbers of a matrix, row by row: in one list, in lists of rows, or as ROS's `data`.
std::vector<double> matrix_in(const Json& json, const char* name) {
    constexpr std::size_t kNumbers = 9;
    const auto found = json.find(name);
    if (found == json.end()) return {};
    if (found->is_object()) return numbers_in(*found, "data");
    if (!found->is_array() || found->empty() || !found->front().is_array())
        return numbers_in(json, name);
    std::vector<double> rows;
    for (const Json& row : *found) {
        if (!row.is_array()) return {};
        for (const Json& number : row) {
            if (!number.is_number() || rows.size() == kNumbers) return {};
            rows.push_back(number.get<double>());
        }
    }
    return rows;
}

/// The intrinsics of an object, without those inside its members.
std::optional<Intrinsics> intrinsics_in(const Json& json) {
    const std::vector<double> m = matrix_in(json, "intrinsic_matrix");
    if (m.size() == 9)  // column by column or row by row: the other two are 0
        return Intrinsics{m[0], m[4], m[2] + m[6], m[5] + m[7]};
    const auto centre_x =
        json.contains("cx") ? finite_number_in(json, "cx") : finite_number_in(json, "ppx");
    const auto centre_y =
        json.contains("cy") ? finite_number_in(json, "cy") : finite_number_in(json, "ppy");
    const bool has_lengths = json.contains("fx") && (json.contains("cx") || json.contains("ppx"));
    if (has_lengths) {
        const double fx = finite_number_in(json, "fx").value_or(0.0);
        const double fy = json.contains("fy") ? finite_number_in(json, "fy").value_or(0.0) : fx;
        return Intrinsics{fx, fy, centre_x.value_or(0.0), centre_y.value_or(0.0)};
    }
    for (const char* const name : kMatrixNames) {
        const std::vector<double> rows = matrix_in(json, name);
        if (rows.size() == 9) return Intrinsics{rows[0], rows[4], rows[2], rows[5]};
    }
    return std::nullopt;
}

/// What a level is, by the first of the usual names; inside an object `camera` also by `scale`.
void read_scale(const Json& json, bool is_camera_object, CameraFile& camera) {
    std::optional<double> stated;
    for (const std::string_view name : kScaleNames)
        if (!stated) stated = finite_number_in(json, std::string(name).c_str());
    if (!stated && is_camera_object) stated = finite_number_in(json, "scale");
    const auto level_mm = stated ? level_mm_of(*stated, false) : std::nullopt;
    if (level_mm) take_scale(camera, 1000.0 / *level_mm);
}

/// The camera of a JSON: of the object itself, or of the first member that has one. Intrinsics of
/// zeros are stated, too.
std::optional<CameraBeside> camera_of_json(const fs::path& file) {
    const Json json = json_of(small_text_in(file).value_or(""));
    if (!json.is_object()) return std::nullopt;
    CameraBeside found{.file = file, .has_intrinsics = false};
    const auto take = [&](const Json& object) {
        const auto intrinsics = intrinsics_in(object);
        if (!intrinsics) return;
        found.has_intrinsics = true;
        found.camera.intrinsics = *intrinsics;
        found.camera.columns = side_in(object, "width", "w");
        found.camera.rows = side_in(object, "height", "h");
        if (found.camera.columns > 0 && found.camera.rows > 0) return;
        found.camera.columns = side_in(json, "width", "w");
        found.camera.rows = side_in(json, "height", "h");
    };
    take(json);
    read_scale(json, false, found.camera);
    for (const char* const name : kObjectNames) {
        const auto inside = json.find(name);
        if (inside == json.end() || !inside->is_object()) continue;
        if (!found.has_intrinsics) take(*inside);
        if (!found.camera.levels_per_m)
            read_scale(*inside, std::string_view(name) == "camera", found.camera);
    }
    const bool is_of_camera = found.has_intrinsics || found.camera.levels_per_m;
    return is_of_camera ? std::optional(found) : std::nullopt;
}

/// The numbers of a matrix in a text or a numpy array, row by row; at most one more than it can
/// have.
std::vector<double> matrix_numbers_in(const fs::path& file) {
    constexpr std::size_t kMost = 16;
    if (is_npy(head_of(file))) {
        try {
            NumpyArray array(file, {}, NamedArrays(file).open({}));
            if (array.header().fortran) return {};
            return array.numbers(kMost);
        } catch (const InputError&) {
            return {};
        }
    }
    std::string numbers = small_text_in(file).value_or("");
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream text(numbers);
    std::vector<double> m;
    for (double number = 0.0; m.size() <= kMost && text >> number;) m.push_back(number);
    return m;
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
        const double radius = finite_number_in(camera, "MetricRadius").value_or(0.0);
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

std::span<const std::string_view> depth_scale_names() noexcept {
    return kScaleNames;
}

std::optional<double> level_mm_of(double stated, bool is_real) {
    constexpr double kLeast_m = 1e-7;
    constexpr double kMost_m = 0.02;
    constexpr double kLeast_mm = 0.05;
    constexpr double kMost_mm = 10.0;
    constexpr double kLeastPerMetre = 100.0;
    constexpr double kMostPerMetre = 1e7;
    if (stated >= kLeast_m && stated <= kMost_m) return 1000.0 * stated;
    if (stated >= kLeast_mm && stated <= kMost_mm && !is_real) return stated;
    if (stated >= kLeastPerMetre && stated <= kMostPerMetre) return 1000.0 / stated;
    return std::nullopt;
}

std::optional<CameraFile> read_camera_matrix(const fs::path& file) {
    const std::vector<double> m = matrix_numbers_in(file);
    if (m.size() != 9 && m.size() != 16) return std::nullopt;
    const std::size_t row = m.size() == 9 ? 3 : 4;
    // Others are lists of as many numbers, or poses.
    if (m[2 * row] != 0.0 || m[2 * row + 1] != 0.0 || m[2 * row + 2] != 1.0 || m[row] != 0.0)
        return std::nullopt;
    CameraFile camera;
    camera.intrinsics = {m[0], m[row + 1], m[2], m[row + 2]};
    return camera;
}

std::optional<CameraFile> read_camera_json(const fs::path& file) {
    const auto found = camera_of_json(file);
    return found && found->has_intrinsics ? std::optional(found->camera) : std::nullopt;
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
    take_scale(camera, 1000.0 / finite_number_in(picture, "depth_scale").value_or(0.0));
    return camera;
}

std::optional<CameraBeside> read_camera_beside(const fs::path& picture, bool and_above,
                                               int number) {
    const fs::path folder = picture.has_parent_path() ? picture.parent_path() : fs::path(".");
    if (auto own = camera_of_json(fs::path(picture).replace_extension(".json"))) return own;
    for (const fs::path& place : {folder, folder / ".."}) {
        if (place != folder && !and_above) break;
        if (const auto camera = read_camera_bop(place / "scene_camera.json", number))
            return CameraBeside{place / "scene_camera.json", *camera,
                                camera->intrinsics != Intrinsics{}};
        for (const char* const name : kJsonFiles)
            if (auto found = camera_of_json(place / name)) return found;
        for (const char* const name : kMatrixFiles)
            if (const auto camera = read_camera_matrix(place / name))
                return CameraBeside{place / name, *camera};
    }
    return std::nullopt;
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
