// Reads the metadata that recorders of volumetric video (Depthkit, Record3D) write beside or into a
// packed video: code and range of depth, and the camera; inside the room.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/video/sources/packed.hpp"

namespace dibhr {

/// How a recorder packed a video with pictures of that size. Reads Depthkit's `*.Metadata.asset`,
/// `*_meta.txt` or `*metadata.json`, or Record3D's `metadata.json`, in the video's folder: the one
/// with the video's name, also as plain `.txt` or `.json`, or the only one if its proportions fit;
/// else the text at the end of Record3D's .mp4. Nothing when there is none, when it cannot be
/// parsed, or when it describes several cameras. The finding names the file.
[[nodiscard]] std::optional<PackedForm> form_by_recorder(const std::filesystem::path& video,
                                                         cv::Size picture);

}  // namespace dibhr
