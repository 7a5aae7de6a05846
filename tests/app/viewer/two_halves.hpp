// A recording of two named halves for the tests of what guides a finger.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/video/frames/colour_image.hpp"
#include "core/video/sources/picture_files.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

inline constexpr const char* kSize = "640x480";
inline constexpr int kWide = 160;
inline constexpr int kHigh = 120;
/// Over the relief, which is left of the panels: in its left and in its right half.
inline constexpr const char* kLeft = "mousemove 100 240";
inline constexpr const char* kRight = "mousemove 240 240";

/// Level 1 in the left half, 2 in the right one.
inline void write_halves(const std::filesystem::path& file) {
    ColourImage picture{kWide, kHigh, {}};
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            picture.rgb.insert(picture.rgb.end(), 3,
                               static_cast<std::uint8_t>(i < kWide / 2 ? 1 : 2));
    write_png(picture, file);
}

/// A level wall of which the left half is a cup, and the right half a table without a text.
inline void write_cup(const TemporaryFolder& folder) {
    write_depth_png(folder / "cup_depth.png", kWide, kHigh, 120);
    write_text(folder / "cup_regions.toml",
               "[[region]]\nlevel = 1\nname = \"Cup\"\ntext = \"A blue cup.\"\n"
               "[[region]]\nlevel = 2\nname = \"Table\"\n");
    write_halves(folder / "cup_regions.png");
}

inline std::vector<std::string> cup_options(std::initializer_list<const char*> more = {}) {
    std::vector<std::string> options{"cup_depth.png", "--raw-depth", "--device", "mouse",
                                     "--no-sync",     "--size",      kSize};
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

}  // namespace dibhr::test
