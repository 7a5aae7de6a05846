// Tiny clips and pictures, made at test time in a folder that goes with the test.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

/// Runs the ffmpeg program; its own words go nowhere. Throws when it fails.
void ffmpeg(const std::string& arguments);

/// A flat clip whose frame n has level 5 n (luma), so that a picture tells which frame it is.
/// `encoding`: ffmpeg's output options; `filter`: appended to the source's filters.
void make_flat_clip(const std::filesystem::path& file, int frames, int frames_per_s,
                    const std::string& encoding, const std::string& filter = "", int width = 64,
                    int height = 48);

inline const std::string kLossless = "-c:v ffv1 -pix_fmt gray";
inline const std::string kH264 = "-c:v libx264 -crf 8 -bf 2 -g 12 -pix_fmt yuv420p";
/// Of one key frame; every other picture is a non-reference one.
inline const std::string kRareKeys =
    "-c:v libx264 -crf 8 -bf 3 -b_strategy 0 -sc_threshold 0 -g 250 -pix_fmt yuv420p";
inline const std::string kVp9 =
    "-c:v libvpx-vp9 -crf 8 -b:v 0 -deadline realtime -g 12 -pix_fmt yuv420p";

/// The same video, to be shown turned clockwise.
void turn(const std::filesystem::path& file, const std::filesystem::path& turned, int degrees);

/// A PNG of the given bits and channels, level(column, row, channel).
void write_picture(const std::filesystem::path& file, int columns, int rows, int bits, int channels,
                   const std::function<int(int, int, int)>& level);

/// The first `bytes` of a file as another file.
void cut(const std::filesystem::path& file, const std::filesystem::path& cut_file,
         std::uintmax_t bytes);

/// What the call throws as an InputError; empty when it throws none.
std::string refusal(const std::function<void()>& call);

/// A flat 16-bit depth picture and an 8-bit colour picture that tell their number, in a folder that
/// is made for them.
void write_depth(const std::filesystem::path& file, int number, int columns = 16, int rows = 12);
void write_colour(const std::filesystem::path& file, int number);

/// The numbers of such pictures as a media gives them, colour -1 where it has none.
struct Shown {
    int depth;
    int colour;
    double time_s;
};
[[nodiscard]] std::vector<Shown> all_of(Media& media);

}  // namespace dibhr::test
