// Finds out what a source's levels mean: asks everybody who may know; inside the room.
#pragma once

#include <filesystem>
#include <vector>

#include "core/video/depth/depth_scale.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// What is said of depth before anything is opened, the strongest word on each thing: by the
/// request, by what is kept of the place of the depth, and by the sidecars of it and of the
/// colour's place, which may be empty. Throws InputError for what cannot be understood.
[[nodiscard]] DepthStatement said_of(const std::filesystem::path& depth,
                                     const std::filesystem::path& colour,
                                     const DepthRequest& request);

/// What is to be known of the depth before its first frame is shown. It is read here and there, and
/// then from its beginning. Throws InputError for a sidecar that cannot be understood, and for a
/// range that cannot be one.
[[nodiscard]] DepthScale find_scale(const Sources& sources, const DepthRequest& request);

/// As many pictures as tell what a source holds and can be read within a moment.
[[nodiscard]] std::vector<cv::Mat> some_pictures(PictureSource& source);

}  // namespace dibhr
