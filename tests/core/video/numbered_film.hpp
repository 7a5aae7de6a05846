// Films whose pictures show their own number as blocks of bits, in colour and in depth.
#pragma once

#include <filesystem>
#include <string>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr::test {

/// A clip whose frame n shows n, of 0 to 255. `rate`: "30000/1001"; `encoding`: ffmpeg's output
/// options; `filter`: appended to the source's filters.
void make_numbered_clip(const std::filesystem::path& file, int frames, const std::string& rate,
                        const std::string& encoding, const std::string& filter = "");

/// A depth picture of 16 bits in mm, or a colour picture, that shows the number; makes its folder.
void write_numbered_depth(const std::filesystem::path& file, int number);
void write_numbered_colour(const std::filesystem::path& file, int number);

/// The same as the data of a raw picture: levels of 16 bits, and red, green and blue.
[[nodiscard]] std::string numbered_depth_data(int number);
[[nodiscard]] std::string numbered_colour_data(int number);
inline constexpr int kNumberedColumns = 160;
inline constexpr int kNumberedRows = 48;

/// The number that a picture shows.
[[nodiscard]] int number_in(const DepthImage& depth);
[[nodiscard]] int number_in(const ColourImage& colour);

/// What the levels of these depth pictures mean, so that nothing is guessed.
[[nodiscard]] DepthStatement numbered_depth_meaning();

}  // namespace dibhr::test
