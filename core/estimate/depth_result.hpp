// From what an estimator has left to depth that goes with its colour: checked, in one file, at the
// colour's times.
#pragma once

#include <atomic>
#include <filesystem>

#include "core/estimate/colour_frames.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Of the forms in which the depth is in `output` the likeliest that fits the colour is written
/// into the folder `target`: depth.mkv, or of a still picture depth.png. It fits when it has as
/// many frames, or is a video that lasts as long, and the colour's shape within 2 %; and it says
/// something: it is not painted, and not the same everywhere. 8 and 16 bits stay to the bit, real
/// numbers become 16 bits, of distances (`unit`) in steps of a millimetre or less.
struct DepthWritten {
    std::filesystem::path file{};
    DepthStatement levels{};  ///< scale: the estimator's number that one is; no data where there is
};

/// Throws InputError: what does not fit, of the likeliest form. Nothing is written where `stop`
/// becomes true: the file's name is empty.
[[nodiscard]] DepthWritten write_depth(const std::filesystem::path& output,
                                       const ColourFrames& colour, DepthUnit unit,
                                       const std::filesystem::path& target,
                                       const std::atomic<bool>& stop, const FramesTold& tell);

}  // namespace dibhr
