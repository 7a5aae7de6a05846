// Converts an estimator's output to depth that matches its colour: checked, in one file, at the
// colour's times.
#pragma once

#include <atomic>
#include <filesystem>

#include "core/estimate/colour_frames.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// The written depth: depth.mkv, or of a still picture depth.png. write_depth() takes the likeliest
/// form in `output` that fits: with as many frames, or a video of the same duration, and the
/// colour's shape within 2 %; neither painted in colours nor the same everywhere. Levels of 8 and
/// 16 bits stay unchanged; real numbers become 16 bits, distances (`unit`) in steps of a millimetre
/// or less.
struct DepthWritten {
    std::filesystem::path file{};
    DepthStatement levels{};  ///< scale: the estimator's number of one level; no data if any
};

/// Throws InputError: why the likeliest form does not fit. Writes nothing when `stop` becomes true:
/// the file's name is empty.
[[nodiscard]] DepthWritten write_depth(const std::filesystem::path& output,
                                       const ColourFrames& colour, DepthUnit unit,
                                       const std::filesystem::path& target,
                                       const std::atomic<bool>& stop, const ReportFrames& report);

}  // namespace dibhr
