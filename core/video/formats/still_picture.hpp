// One still picture out of a file of any form, told apart by content; inside the room.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/pictures.hpp"

namespace dibhr {

struct StillPicture {
    cv::Mat picture{};    ///< as in a TimedPicture
    int bits{8};          ///< of a level; kRealBits: real numbers
    std::string codec{};  ///< "PNG", "EXR"
    DepthStatement known{};
    std::string known_from{};  ///< as in SourceFacts
};

/// Whether some reader takes the file as a picture, or as an array of them.
[[nodiscard]] bool is_still(const std::filesystem::path& file);

/// Whether the file holds a colour picture and the depth that belongs to it: an EXR file of R, G, B
/// and Z, a portrait photo, a .npz of both. False for a file that cannot be read.
[[nodiscard]] bool holds_colour_and_depth(const std::filesystem::path& file);

/// Depth keeps its levels and channels, colour becomes 8-bit BGR; of an array the first picture.
/// Throws InputError.
[[nodiscard]] StillPicture read_still(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
