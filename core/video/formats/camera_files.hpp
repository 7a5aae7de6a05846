// Reads camera intrinsics as datasets write them beside their pictures; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/video/depth/camera.hpp"
#include "core/video/depth/depth_meaning.hpp"
#include "core/video/depth/level_code.hpp"

namespace dibhr {

/// The content of a camera file.
struct CameraFile {
    Intrinsics intrinsics{};  ///< as stated; maybe of no camera: see fit_camera()
    int columns{0}, rows{0};  ///< picture size of the intrinsics; 0: not stated
    std::optional<double> levels_per_m{};
};

/// The names under which programs state what a level is, in JSON or as an array of a .npz.
[[nodiscard]] std::span<const std::string_view> depth_scale_names() noexcept;

/// The millimetres of a level that was stated under such a name, by its size: metres of a level
/// (0.001, 0.00025), millimetres of a level (0.1, 1), or levels of a metre (1000, 5000). Nothing
/// where it is of no usual size, or is 0.05 to 10 and levels are real numbers, which may be metres.
[[nodiscard]] std::optional<double> level_mm_of(double stated, bool is_real);

/// Reads a matrix of 3 x 3 or 4 x 4 numbers, row by row, with spaces as in ScanNet or commas as in
/// Stray Scanner, or as a numpy array. Nothing when the file is missing or holds no matrix.
[[nodiscard]] std::optional<CameraFile> read_camera_matrix(const std::filesystem::path& file);

/// A camera in JSON: Open3D's `intrinsic_matrix`, column by column; `fx`, `fy`, `cx`, `cy`, as of
/// Polycam, or `ppx`, `ppy`, as of RealSense; or `intrinsics`, `K`, `camera_matrix`, row by row, as
/// of 3D Scanner App and ROS; each also inside `depth_intrinsics`, `depth`, `intrinsics` or
/// `camera`. With `width` and `height`, or `w` and `h`, and with what a level is (inside `camera`
/// also `scale`, as of Replica). Nothing as above.
[[nodiscard]] std::optional<CameraFile> read_camera_json(const std::filesystem::path& file);

/// The picture of that number in a scene_camera.json of BOP, or the first one: `cam_K` row by row,
/// and `depth_scale`, the millimetres of a level (bop.felk.cvut.cz: "BOP dataset format"). Nothing
/// as above.
[[nodiscard]] std::optional<CameraFile> read_camera_bop(const std::filesystem::path& file,
                                                        int number);

/// A camera file that lies beside pictures.
struct CameraBeside {
    std::filesystem::path file{};
    CameraFile camera{};
    bool has_intrinsics{true};  ///< false: it only states what a level is
};

/// The camera of a picture by a file with a usual name, or with the picture's: a JSON as above, or
/// a matrix. In its folder, then, `and_above`, in the folder that holds that one. `number`: as
/// above.
[[nodiscard]] std::optional<CameraBeside> read_camera_beside(const std::filesystem::path& picture,
                                                             bool and_above, int number);

/// The law of disparities by a calib.txt as of Middlebury 2014 (vision.middlebury.edu/stereo) and
/// ETH3D: focal length of `cam0`, `doffs` and `baseline` [mm], for pictures of `width` columns;
/// here for pictures of so many `columns`. Nothing as above.
[[nodiscard]] std::optional<InverseLevels> read_stereo_calibration(
    const std::filesystem::path& file, int columns);

/// ARKitScenes' line of six numbers: columns, rows, fx, fy, cx, cy. Nothing as above.
[[nodiscard]] std::optional<CameraFile> read_camera_pincam(const std::filesystem::path& file);

/// The depth camera by an Azure Kinect calibration, as attached to its recordings. The size of the
/// depth pictures selects the camera mode. Nothing when the text is invalid or no mode fits.
[[nodiscard]] std::optional<CameraModel> azure_kinect_depth_camera(const std::string& json,
                                                                   cv::Size depth);
/// The same, with the colour camera; nothing as above, or without a colour camera.
[[nodiscard]] std::optional<CameraPair> azure_kinect_cameras(const std::string& json,
                                                             cv::Size depth);

}  // namespace dibhr
