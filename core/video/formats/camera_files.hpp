// Intrinsics as datasets write them beside their pictures; inside the room.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/video/depth/camera.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Of a camera file, and what else that says.
struct CameraFile {
    Intrinsics intrinsics{};
    int columns{0}, rows{0};  ///< of the pictures that they are for; 0: not said
    std::optional<double> levels_per_m{};
};

/// A matrix of 3 x 3 or 4 x 4 numbers, row by row, as ScanNet has it. Nothing when the file is
/// missing or holds no camera.
[[nodiscard]] std::optional<CameraFile> read_camera_matrix(const std::filesystem::path& file);

/// Open3D's JSON: `intrinsic_matrix`, column by column, `width`, `height` and `depth_scale`.
/// Nothing as above.
[[nodiscard]] std::optional<CameraFile> read_camera_json(const std::filesystem::path& file);

/// Microsoft's calibration of an Azure Kinect, as it is attached to its recordings, for depth
/// pictures of that size, which says the mode. Nothing when the text is none, or there is no such
/// mode.
[[nodiscard]] std::optional<Camera> azure_kinect_depth_camera(const std::string& json,
                                                              cv::Size depth);
/// The same, and its colour camera; nothing as above, or when that is not in it.
[[nodiscard]] std::optional<CameraPair> azure_kinect_cameras(const std::string& json,
                                                             cv::Size depth);

}  // namespace dibhr
