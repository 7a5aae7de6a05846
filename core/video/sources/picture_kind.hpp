// Guesses from pictures alone whether they are photographs or depth, and in which form; inside the
// room. For files whose metadata and names do not say it.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

enum class PictureKind {
    photo,       ///< all that is not clearly depth: also drawings, text, screenshots, stereo pairs
    grey_depth,  ///< grey, smooth, with silhouettes; may still be a soft grey photograph
    hue_depth,   ///< smooth in hue, of pure colours, the rest black
    ramp_depth,  ///< white - cyan - blue - black
    byte_depth,  ///< a number in the bytes of the channels, continuous
    packed       ///< colour and depth in halves
};

/// Statistics of one picture as a surface of levels from 0 to 255.
struct SurfaceStatistics {
    double covered{0.0};  ///< share of the pixels that have a level
    double range{0.0};    ///< between the percentiles 2 and 98
    double texture{0.0};  ///< mean distance of a level from the median around it, as a part of
                          ///< `range`; without edges
    double slopes{0.0};   ///< share of the pixels with a level where the surface rises slowly
    double edges{0.0};    ///< share where it jumps
};

/// Statistics of one picture. Shares are of the pixels that are not dark.
struct PictureStatistics {
    double lit{0.0};       ///< share of all pixels that are not dark
    double coloured{0.0};  ///< not grey
    double pure{0.0};      ///< share with nearly pure hues
    double ramp{0.0};      ///< share on the colour ramp, of the coloured pixels
    SurfaceStatistics brightness{};
    SurfaceStatistics hue{};  ///< only where at least half is pure
};

/// The kind of pictures, and the statistics that decided it: means over the pictures. `packing` and
/// the halves' statistics are for `packed` only, `code` for `packed` and `byte_depth`.
struct PictureGuess {
    PictureKind kind{PictureKind::photo};
    DepthPacking packing{DepthPacking::separate};
    DepthCode code{DepthCode::grey};
    int gap_px{0};  ///< between the halves
    PictureStatistics whole{};
    PictureStatistics colour_half{};
    PictureStatistics depth_half{};
    double brightness_alike{0.0};  ///< correlation of the halves, 0 to 1
    double edges_agree{0.0};       ///< correlation of the halves' edges, -1 to 1
    double edges_by_chance{0.0};   ///< the highest with one half moved or mirrored
};

[[nodiscard]] PictureStatistics picture_statistics(const cv::Mat& picture);

/// How wide a white band is that parts a picture (8-bit BGR) in the middle, as estimators and
/// papers put it between a picture and its depth; 0: none.
[[nodiscard]] int gap_between_halves(const cv::Mat& picture, DepthPacking packing);

/// Whether such a band parts the picture, and one half is painted in the colours of a colour map.
[[nodiscard]] bool has_painted_half(const cv::Mat& picture);

/// Whether a picture, 8-bit BGR, has more coloured pixels than compression gives to a grey one.
[[nodiscard]] bool is_coloured(const cv::Mat& picture);

/// Whether a picture is smooth, with silhouettes, as grey depth is. 8-bit BGR.
[[nodiscard]] bool may_be_grey_depth(const cv::Mat& picture);

/// Whether a grey picture is no depth but another photograph of the scene of a colour picture: a
/// grey copy, the other one of a stereo pair, infrared. It is rougher than depth is, and its fine
/// structure is that of the colour. Both 8-bit BGR.
[[nodiscard]] bool is_photo_of_scene(const cv::Mat& colour, const cv::Mat& grey);

/// Whether a grey picture looks like a photograph: fine structure and many edges. Noise of a sensor
/// alone has few edges. False for one below 64 pixels. 8-bit BGR.
[[nodiscard]] bool looks_like_photo(const cv::Mat& picture);

/// Whether a picture has 0 and the highest level, and nothing else, as a mask has. 8 or 16 bits.
[[nodiscard]] bool is_black_and_white(const cv::Mat& picture);

/// `pictures`: 8-bit BGR, sampled across one file. Uses up to 24, reduced to 320 pixels. In doubt,
/// or without pictures, the answer is photographs.
[[nodiscard]] PictureGuess guess_kind(std::span<const cv::Mat> pictures);

}  // namespace dibhr
