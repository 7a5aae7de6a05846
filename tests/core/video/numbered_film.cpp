// Films whose pictures show their own number as blocks of bits, in colour and in depth.
#include "tests/core/video/numbered_film.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"

namespace dibhr::test {

namespace {

constexpr int kBits = 8;
constexpr int kBlocks = kBits + 2;  ///< two more show a 0 and a 1
constexpr int kBlock_px = kNumberedColumns / kBlocks;
constexpr int kNear_mm = 1000;
constexpr int kFar_mm = 3000;

bool shows_one(int column, int number) {
    const int block = column / kBlock_px;
    if (block >= kBits) return block > kBits;
    return (number >> block) % 2 == 1;
}

/// `level`: of the middle of a block.
template <typename Level>
int number_by(const Level& level) {
    const double least = level(kBits);
    const double most = level(kBits + 1);
    int number = 0;
    for (int block = 0; block < kBits; ++block) {
        const double at = level(block);
        if ((at - least) / (most - least) > 0.5) number += 1 << block;
    }
    return number;
}

}  // namespace

void make_numbered_clip(const std::filesystem::path& file, int frames, const std::string& rate,
                        const std::string& encoding, const std::string& filter) {
    ffmpeg("-f lavfi -i \"color=black:s=" + std::to_string(kNumberedColumns) + "x" +
           std::to_string(kNumberedRows) + ":r=" + rate +
           ",format=gray,geq=lum='if(gt(floor(X/16)\\,8)\\,255\\,if(eq(floor(X/16)\\,8)\\,0\\,"
           "255*mod(floor(N/pow(2\\,floor(X/16)))\\,2)))'" +
           (filter.empty() ? "" : "," + filter) + "\" -frames:v " + std::to_string(frames) +
           " -fps_mode passthrough " + encoding + " '" + file.string() + "'");
}

void write_numbered_depth(const std::filesystem::path& file, int number) {
    std::filesystem::create_directories(file.parent_path());
    write_picture(file, kNumberedColumns, kNumberedRows, 16, 1, [number](int column, int, int) {
        return shows_one(column, number) ? kNear_mm : kFar_mm;
    });
}

void write_numbered_colour(const std::filesystem::path& file, int number) {
    std::filesystem::create_directories(file.parent_path());
    write_picture(file, kNumberedColumns, kNumberedRows, 8, 3,
                  [number](int column, int, int) { return shows_one(column, number) ? 255 : 0; });
}

std::string numbered_depth_data(int number) {
    std::string data;
    for (int k = 0; k < kNumberedColumns * kNumberedRows; ++k)
        append_bytes(data, static_cast<std::uint16_t>(
                               shows_one(k % kNumberedColumns, number) ? kNear_mm : kFar_mm));
    return data;
}

std::string numbered_colour_data(int number) {
    std::string data;
    for (int k = 0; k < kNumberedColumns * kNumberedRows; ++k)
        data.append(3, shows_one(k % kNumberedColumns, number) ? '\xff' : '\0');
    return data;
}

int number_in(const DepthImage& depth) {
    return number_by([&depth](int block) {
        const int column = (2 * block + 1) * depth.columns / (2 * kBlocks);
        return static_cast<double>(depth.at(column, depth.rows / 2));
    });
}

int number_in(const ColourImage& colour) {
    return number_by([&colour](int block) {
        const int column = (2 * block + 1) * colour.columns / (2 * kBlocks);
        const int pixel = colour.rows / 2 * colour.columns + column;
        return static_cast<double>(colour.rgb[3 * static_cast<std::size_t>(pixel)]);
    });
}

DepthStatement numbered_depth_meaning() {
    return {.near = NearLevels::dark,
            .unit = DepthUnit::mm,
            .scale = 1.0,
            .range = DepthRange{500.0, 4000.0},
            .no_data = std::vector<double>{}};
}

}  // namespace dibhr::test
