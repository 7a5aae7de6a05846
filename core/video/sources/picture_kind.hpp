// What pictures look like: photographs, or depth in one of the forms that it comes in; inside the
// room. Guessed from their content alone, where neither metadata nor names say it.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

enum class PictureKind {
    photo,       ///< also drawings, text, screenshots, stereo pairs: all that is not clearly depth
    grey_depth,  ///< grey, smooth, with silhouettes: may still be a soft black-and-white photograph
    hue_depth,   ///< smooth in hue, of pure colours, the rest black
    ramp_depth,  ///< white - cyan - blue - black
    packed       ///< colour and depth in halves
};

/// How one picture looks as a surface of levels from 0 to 255.
struct SurfaceLook {
    double covered{0.0};  ///< share of the pixels that have a level
    double range{0.0};    ///< between the percentiles 2 and 98
    double texture{0.0};  ///< mean distance of a level from the median around it, in ranges; away
                          ///< from edges
    double slopes{0.0};   ///< share of the pixels with a level where it rises a little
    double edges{0.0};    ///< share where it jumps
};

/// How one picture looks. Shares are of the pixels that are not dark.
struct PictureLook {
    double lit{0.0};       ///< share of all pixels that are not dark
    double coloured{0.0};  ///< not grey
    double pure{0.0};      ///< of nearly pure hues
    double ramp{0.0};      ///< on the ramp, of those with a colour
    SurfaceLook brightness{};
    SurfaceLook hue{};  ///< where at least half is pure
};

/// What pictures are, and the numbers that say so: means over the pictures. `packing`, `code` and
/// the halves' numbers are of `packed` only.
struct PictureGuess {
    PictureKind kind{PictureKind::photo};
    DepthPacking packing{DepthPacking::separate};
    DepthCode code{DepthCode::grey};
    PictureLook whole{};
    PictureLook colour_half{};
    PictureLook depth_half{};
    double brightness_alike{0.0};  ///< correlation of the halves, 0 to 1
    double edges_agree{0.0};       ///< correlation of the halves' edges, -1 to 1
    double edges_by_chance{0.0};   ///< the same with one half moved or mirrored: the highest
};

[[nodiscard]] PictureLook look_of(const cv::Mat& picture);

/// `pictures`: 8-bit BGR, sampled across one file; up to 24 are looked at, reduced to 320 pixels.
/// In doubt they are photographs; so are none.
[[nodiscard]] PictureGuess guess_kind(std::span<const cv::Mat> pictures);

}  // namespace dibhr
