// The named regions of the sample: which one each pixel of a frame belongs to.
#pragma once

#include <cstdint>
#include <vector>

namespace dibhr::sample {

/// The label pictures of the sample have half its columns and rows, and are spread evenly over it.
inline constexpr int kLabelStep = 2;
inline constexpr int kLabelPictures = 60;

/// In the order of depth_regions.toml; the level of the first one is kRegionStep, of the second
/// twice that.
enum class SampleRegion : std::uint8_t {
    hair,
    forehead,
    eye,
    nose,
    cheek,
    mouth,
    chin,
    ear,
    neck,
    jumper,
    hand,
    wall
};
inline constexpr int kSampleRegions = 12;
inline constexpr int kRegionStep = 20;

/// The levels of a frame's label picture, row by row from the top.
[[nodiscard]] std::vector<std::uint8_t> labels_of(int frame);

/// The frame in the middle of the time of a label picture, 0 .. kLabelPictures - 1.
[[nodiscard]] int frame_of_labels(int picture);

}  // namespace dibhr::sample
