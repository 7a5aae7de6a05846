// What recorders of volumetric video (Depthkit, Record3D) write down beside a packed video, or in
// it: how depth is coded, over which distances, through which camera; inside the room.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/video/sources/packed.hpp"

namespace dibhr {

/// How a recorder packed a video whose pictures are of that size: Depthkit's `*.Metadata.asset`,
/// `*_meta.txt` or `*metadata.json`, or Record3D's `metadata.json`, in the folder of the video (of
/// its name, or the only one there, and for pictures of these proportions), or what Record3D writes
/// at the end of its .mp4. Nothing when there is none, when it cannot be understood, or when it
/// speaks of several cameras. `known_from` names the file.
[[nodiscard]] std::optional<PackedForm> form_by_recorder(const std::filesystem::path& video,
                                                         cv::Size picture);

}  // namespace dibhr
