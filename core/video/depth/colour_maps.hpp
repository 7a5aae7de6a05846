// Recognises pictures that paint numbers: in the colours of a colour map, or as a mask.
#pragma once

#include <opencv2/core/mat.hpp>

namespace dibhr {

/// Whether nearly all pixels of a picture (8-bit BGR) have colours of one usual colour map, and not
/// greys alone: jet, turbo, viridis, inferno, magma, plasma, hot, Spectral.
[[nodiscard]] bool is_colour_mapped(const cv::Mat& picture);

/// Whether that is a colour map whose brightness rises from one end to the other, so that greys of
/// the picture have the order of the numbers: not jet, turbo and Spectral.
[[nodiscard]] bool has_map_of_rising_brightness(const cv::Mat& picture);

/// Whether it has two colours alone, as masks have; false for a picture of one colour.
[[nodiscard]] bool has_two_levels(const cv::Mat& picture);

}  // namespace dibhr
