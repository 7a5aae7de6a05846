// The readers of still pictures, one for each form; inside the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/video/depth/findings.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

struct StillPicture {
    cv::Mat picture{};    ///< as in a TimedPicture
    int bits{8};          ///< of a level; kRealBits: real numbers
    std::string codec{};  ///< "PNG", "EXR"
    Findings findings{};  ///< as in SourceFacts
};

/// Whether OpenCV's codecs read the file, or it is a WebP picture. OpenCV does not recognise a
/// damaged WebP, and libav would take it for a video and end the program. Loads the codecs, but not
/// for the first bytes of PNG and JPEG.
[[nodiscard]] bool is_opencv_picture(const std::filesystem::path& file, std::string_view head);

/// Depth keeps its levels and channels, colour becomes 8-bit BGR. Levels with a sign, and real ones
/// (TIFF), become real. Throws InputError.
[[nodiscard]] StillPicture read_by_opencv(const std::filesystem::path& file, PictureRole role);

/// A PNG picture of 8 or 16 bits in grey or colour, as read_by_opencv() has it, without loading the
/// codecs. Empty when it is of another kind, or damaged.
[[nodiscard]] cv::Mat read_plain_png(const std::filesystem::path& file, PictureRole role);

/// A picture in memory, in a form that claimed_size() knows; `flags`: OpenCV's for reading. Empty
/// when it is damaged, or beyond the bound.
[[nodiscard]] cv::Mat decoded_picture(std::span<const std::uint8_t> bytes, int flags);

/// OpenEXR, as renderers and estimators write it, often with colours. Reads the display window;
/// outside the data window, and at a renderer's infinity, is no data. Depth is the channel Z, else
/// V, Y or R, preferably of a layer named depth; of R, G and B that differ, all three. Throws
/// InputError.
[[nodiscard]] StillPicture read_exr(const std::filesystem::path& file, PictureRole role);

/// Whether every attribute of an OpenEXR header lies in the file and has the length of its type.
/// The library allocates what an attribute claims before it reads it, and loses its position when a
/// length is wrong.
[[nodiscard]] bool has_valid_exr_header(const std::filesystem::path& file);

/// Whether it has channels R, G and B, and Z or V. False when the file cannot be read.
[[nodiscard]] bool exr_has_colour_and_depth(const std::filesystem::path& file);

/// Portable float maps (.pfm), as stereo datasets have them. Gives the values unchanged: of the
/// file's scale only the sign counts, which is the byte order, as in the datasets' own readers
/// (OpenCV divides by the scale). Throws InputError.
[[nodiscard]] StillPicture read_pfm(const std::filesystem::path& file, PictureRole role);

/// Whether a file named .raw holds 16-bit levels: as many as the pixels of the picture beside it
/// that has its name, as RealSense Viewer writes both.
[[nodiscard]] bool is_raw_levels(const std::filesystem::path& file, std::string_view head);

/// Reads these levels, in little-endian order. Throws InputError.
[[nodiscard]] StillPicture read_raw_levels(const std::filesystem::path& file, PictureRole role);

/// HEIC photos: the primary picture, or the depth picture of a portrait, each turned as the file
/// states. Throws InputError, also when depth is requested and there is none.
[[nodiscard]] StillPicture read_heif(const std::filesystem::path& file, PictureRole role);

/// False when the file cannot be read.
[[nodiscard]] bool heif_has_depth(const std::filesystem::path& file);

/// JPEG photos with a depth map inside: Google's GDepth and Dynamic Depth, Apple's second picture.
/// Gives the colour, of a blurred portrait the sharp original; or the depth, upright as the colour:
/// distances where the photo states near and far, else disparities or levels. Throws InputError,
/// also when depth is requested and there is none.
[[nodiscard]] StillPicture read_jpeg_photo(const std::filesystem::path& file, PictureRole role);

/// Reads only the metadata of a plain photo. False when the file cannot be read.
[[nodiscard]] bool jpeg_has_depth(const std::filesystem::path& file);

/// Whether the photo has a gain map, by which bright screens show it (HDR), and which is no depth.
[[nodiscard]] bool jpeg_has_gain_map(const std::filesystem::path& file);
/// The rest of a sentence that begins with the name of such a photo.
inline constexpr const char* kGainMapAlone =
    " has a second picture that is a gain map for bright screens (HDR), and no depth: give a depth "
    "file as the second file, or let an estimator make it (dibhr help depth)";

}  // namespace dibhr
