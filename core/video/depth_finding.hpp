// Finds out what a source's levels mean: asks everybody who may know; inside the room.
#pragma once

#include <filesystem>
#include <vector>

#include "core/video/depth_scale.hpp"
#include "core/video/media.hpp"
#include "core/video/pictures.hpp"

namespace dibhr {

/// What is to be known of a source before its first frame is shown. `places` are the files and
/// folders that may have a sidecar, the depth's own first. The source is read here and there, and
/// then from its beginning. Throws InputError for a sidecar that cannot be understood, and for a
/// range that cannot be one.
[[nodiscard]] DepthScale find_scale(PictureSource& depth,
                                    const std::vector<std::filesystem::path>& places,
                                    const DepthRequest& request);

/// As many pictures as tell what a source holds and can be read within a moment.
[[nodiscard]] std::vector<cv::Mat> some_pictures(PictureSource& source);

}  // namespace dibhr
