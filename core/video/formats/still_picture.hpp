// One still picture out of a file, and the reader of the forms that OpenCV knows; inside the room.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

struct StillPicture {
    cv::Mat picture{};    ///< as in a TimedPicture
    int bits{8};          ///< of a level; kRealBits: real numbers
    std::string codec{};  ///< "PNG", "EXR"
    DepthStatement known{};
    std::string known_from{};  ///< as in SourceFacts
};

/// Whether OpenCV's codecs read it, or it is a WebP picture, also a damaged one, which they do not
/// know any more: libav takes that for a video, and ends the program. Loads the codecs.
[[nodiscard]] bool is_opencv_picture(const std::filesystem::path& file, std::string_view head);

/// Depth keeps its levels and channels, colour becomes 8-bit BGR. Levels with a sign, and real ones
/// (TIFF), become real. Throws InputError.
[[nodiscard]] StillPicture read_by_opencv(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
