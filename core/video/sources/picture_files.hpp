// Single pictures: read from files of any form, and written as PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// A bump map from an 8- or 16-bit image, normalised: lowest level 0, highest 1.
[[nodiscard]] BumpMap read_bump_map(const std::filesystem::path& file);

/// A colour picture of any supported form. Throws InputError.
[[nodiscard]] ColourImage read_colour_picture(const std::filesystem::path& file);

/// The bytes of an RGB picture's PNG file. Throws InputError for an empty picture.
[[nodiscard]] std::string png_of(const ColourImage& picture);

/// The bytes of a grey picture's PNG file: `levels` row by row, columns x rows of them.
[[nodiscard]] std::string png_of(std::span<const std::uint8_t> levels, int columns, int rows);

/// Writes an RGB picture as PNG, whole or not at all. Throws InputError.
void write_png(const ColourImage& picture, const std::filesystem::path& file);

/// The same, but keeps a file of that name: adds the first free number, "view-2.png". Gives the
/// name.
std::filesystem::path write_new_png(const ColourImage& picture, const std::filesystem::path& file);

}  // namespace dibhr
