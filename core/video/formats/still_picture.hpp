// One still picture out of a file, and who reads it by its form; inside the room.
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

/// OpenEXR: depth as renderers and estimators leave it, often beside colours. Of its display
/// window; outside its data window, and at renderers' infinity, is no data. Depth is the channel Z,
/// else V, Y or R, of a layer that says depth before others; of R, G and B that differ all three.
/// Throws InputError.
[[nodiscard]] StillPicture read_exr(const std::filesystem::path& file, PictureRole role);

/// Whether every attribute of an OpenEXR header lies in the file and is as long as its type. The
/// library takes memory for what an attribute claims before it reads it, and goes on elsewhere when
/// a length is wrong.
[[nodiscard]] bool has_sound_exr_header(const std::filesystem::path& file);

/// Channels R, G and B, and a Z or V. False when the file cannot be read.
[[nodiscard]] bool exr_has_colour_and_depth(const std::filesystem::path& file);

/// Portable float maps (.pfm), as stereo datasets leave them. The values as they stand in the file:
/// of its scale only the sign counts, which says the byte order, as in the readers of the datasets
/// themselves (OpenCV divides by it). Throws InputError.
[[nodiscard]] StillPicture read_pfm(const std::filesystem::path& file, PictureRole role);

/// HEIC photos: the primary picture, or the depth picture that portraits have beside it, each
/// turned as it says itself. Throws InputError, also when depth is asked for and there is none.
[[nodiscard]] StillPicture read_heif(const std::filesystem::path& file, PictureRole role);

/// False when the file cannot be read.
[[nodiscard]] bool heif_has_depth(const std::filesystem::path& file);

}  // namespace dibhr
