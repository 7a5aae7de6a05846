// What depth means where nobody says it: from the levels of some of its pictures.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Completes what the voices said, looking at pictures from all over the source (1 to 4 channels;
/// `bits` of their levels, kRealBits for real numbers; they may be none):
///
///   no data   0 and the highest level of more than 8 bits, 0 of 8, where they stand out of the
///             other levels; nothing of real numbers, where it is what is not finite
///   unit      millimetres, for more than 8 bits with no data at 0 or none above 12,000; fifths of
///             a millimetre, where those reach beyond 20 m; levels else. Real numbers: whether the
///             middle and the floor of the picture are the smaller ones (a distance: mm beyond 100,
///             else m) or the larger ones (levels up to 1, else disparity)
///   near      dark for distances, bright for disparities; for levels what the middle and the floor
///             of the picture are, where they are that clearly, else bright
///   scale     1
///   range     the half percent at either end and at most a twentieth beyond it, nearer also
///             the last ten-thousandth; of distances nothing beyond twice what the nearest nine
///             tenths span
///
/// The range is then found, the rest assumed.
void guess(const std::vector<cv::Mat>& pictures, int bits, DepthMeaning& meaning,
           const Voices& voices);

/// Whether nothing is left of all that to find out.
[[nodiscard]] bool is_all_said(const Voices& voices);

/// The share of pixels of the pictures that are no data by that meaning, in [0, 1].
[[nodiscard]] double holes_share(const std::vector<cv::Mat>& pictures, const DepthMeaning& meaning);

/// How many different levels the pictures hold.
[[nodiscard]] int levels_used(const std::vector<cv::Mat>& pictures);

}  // namespace dibhr
