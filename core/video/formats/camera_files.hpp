// Reads camera intrinsics as datasets write them beside their pictures; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/video/depth/camera.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// The content of a camera file.
struct CameraFile {
    Intrinsics intrinsics{};
    int columns{0}, rows{0};  ///< picture size of the intrinsics; 0: not stated
    std::optional<double> levels_per_m{};
};

/// Reads a matrix of 3 x 3 or 4 x 4 numbers, row by row, as in ScanNet. Nothing when the file is
/// missing or holds no camera.
[[nodiscard]] std::optional<CameraFile> read_camera_matrix(const std::filesystem::path& file);

/// Open3D's JSON: `intrinsic_matrix`, column by column, `width`, `height` and `depth_scale`.
/// Nothing as above.
[[nodiscard]] std::optional<CameraFile> read_camera_json(const std::filesystem::path& file);

/// The depth camera by an Azure Kinect calibration, as attached to its recordings. The size of the
/// depth pictures selects the camera mode. Nothing when the text is invalid or no mode fits.
[[nodiscard]] std::optional<CameraModel> azure_kinect_depth_camera(const std::string& json,
                                                                   cv::Size depth);
/// The same, with the colour camera; nothing as above, or without a colour camera.
[[nodiscard]] std::optional<CameraPair> azure_kinect_cameras(const std::string& json,
                                                             cv::Size depth);

}  // namespace dibhr
