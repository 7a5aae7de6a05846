// One scene of depth in the forms that people bring it in, written byte by byte or by the libraries
// that write it for them.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "tests/core/video/coded_scene.hpp"

namespace dibhr::test {

inline constexpr int kSceneLevels = 4096;

/// Which of the 4096 levels a pixel of the scene has; each occurs.
[[nodiscard]] int scene_level(int column, int row);

/// The depth of a level, 1 to 16, every one exact also in half precision.
[[nodiscard]] float scene_depth(int level);

/// The scene's levels, and its depths, as 32-bit floats.
[[nodiscard]] cv::Mat scene_levels();
[[nodiscard]] cv::Mat scene();

/// The bytes of a number, the least first or the greatest.
template <typename Number>
void append_bytes(std::string& text, Number number, bool little = true) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    if (little != (std::endian::native == std::endian::little))
        bytes = {bytes.rbegin(), bytes.rend()};
    text += bytes;
}

/// The bytes of a .npy file: `shape` as Python writes it, "(2, 3)"; `data`: the numbers.
[[nodiscard]] std::string npy(const std::string& type, const std::string& shape,
                              const std::string& data, bool fortran = false);

/// A zip file of these entries, deflated or stored.
void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& entries,
               bool deflated);

/// A portable float map of a picture of 1 or 3 channels (BGR), as stereo datasets write it.
[[nodiscard]] std::string pfm(const cv::Mat& picture, const std::string& scale, bool little);

/// A TIFF file of one channel. `format`: 1 whole numbers, 2 with a sign, 3 real ones. `no_data`: of
/// the tag GDAL_NODATA; empty: without it. `is_geographic`: with a key directory of GeoTIFF.
/// `texts`: other tags of text.
[[nodiscard]] std::string tiff(int columns, int rows, int bits, int format, bool little,
                               const std::string& data, const std::string& no_data = {},
                               bool is_geographic = false,
                               const std::map<int, std::string>& texts = {});

/// A HEIC photo: a colour picture, and a depth picture beside it where there is one, each the first
/// of what ffmpeg's source gives.
struct Photo {
    std::string colour{"testsrc2=s=64x48"};
    std::string depth{};
    int quarter_turns{0};             ///< against the clock, of both
    std::string depth_information{};  ///< an SEI message as the depth's auxC has it
};
void write_photo(const Photo& photo, const std::filesystem::path& file);

/// The SEI message that says: uniform disparity from 0 to 1.
[[nodiscard]] std::string disparity_information();

}  // namespace dibhr::test
