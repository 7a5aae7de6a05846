// Recognises pictures that paint numbers: in the colours of a colour map, or as a mask.
#pragma once

#include <opencv2/core/mat.hpp>

namespace dibhr {

/// Whether nearly all pixels of a picture (8-bit BGR) have colours of one usual colour map, and not
/// greys alone: jet, turbo, viridis, inferno, magma, plasma, hot, Spectral.
[[nodiscard]] bool is_colour_mapped(const cv::Mat& picture);

/// Whether it has two colours alone, as masks have; false for a picture of one colour.
[[nodiscard]] bool has_two_levels(const cv::Mat& picture);

}  // namespace dibhr
