// Single pictures: read from files of any form, and written as PNG.
#pragma once

#include <filesystem>
#include <string>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// A bump map from an 8- or 16-bit image, normalised so that its lowest level is 0 and its
/// highest 1.
[[nodiscard]] BumpMap read_bump_map(const std::filesystem::path& file);

/// A picture to be looked at, of any form that is read. Throws InputError.
[[nodiscard]] ColourImage read_colour_picture(const std::filesystem::path& file);

/// The bytes of an RGB picture's PNG file. Throws InputError for an empty picture.
[[nodiscard]] std::string png_of(const ColourImage& picture);

/// Writes an RGB picture as PNG, whole or not at all. Throws InputError.
void write_png(const ColourImage& picture, const std::filesystem::path& file);

/// The same, but beside a file of that name: with the first free number, "view-2.png". Gives the
/// name.
std::filesystem::path write_new_png(const ColourImage& picture, const std::filesystem::path& file);

}  // namespace dibhr
