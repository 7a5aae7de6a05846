// Reads camera intrinsics as datasets write them beside their pictures; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

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

/// Reads a matrix of 3 x 3 or 4 x 4 numbers, row by row, with spaces as in ScanNet or commas as in
/// Stray Scanner. Nothing when the file is missing or holds no matrix.
[[nodiscard]] std::optional<CameraFile> read_camera_matrix(const std::filesystem::path& file);

/// A camera in JSON: Open3D's `intrinsic_matrix`, column by column, with `depth_scale`;
/// `intrinsics` row by row, as of 3D Scanner App; or `fx`, `fy`, `cx`, `cy`, as of Polycam, or
/// inside `camera` with `scale`, as of Replica. With `width` and `height`, or `w` and `h`. Nothing
/// as above.
[[nodiscard]] std::optional<CameraFile> read_camera_json(const std::filesystem::path& file);

/// The picture of that number in a scene_camera.json of BOP, or the first one: `cam_K` row by row,
/// and `depth_scale`, the millimetres of a level (bop.felk.cvut.cz: "BOP dataset format"). Nothing
/// as above.
[[nodiscard]] std::optional<CameraFile> read_camera_bop(const std::filesystem::path& file,
                                                        int number);

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
