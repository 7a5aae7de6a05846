// Guesses what depth means where no statement says it: from the levels of some of its pictures.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Completes the meaning where no voice states a fact, from pictures spread over the source (1 to 4
/// channels; `bits` of their levels, kRealBits for real numbers; there may be none):
///
///   no data   where they stand out from the other levels: 0 and the highest level of more than 8
///             bits, 0 of 8 bits. None of real numbers: there no data is what is not finite
///   unit      millimetres, for more than 8 bits with no data at 0 or none above 12,000; fifths of
///             a millimetre, where those reach beyond 20 m; levels else. Real numbers: whether the
///             middle and the floor of the picture are the smaller ones (a distance: mm beyond 100,
///             else m) or the larger ones (levels up to 1, else disparity)
///   near      dark for distances, bright for disparities; for levels as the middle and the floor
///             of the picture are, if that is clear, else bright
///   scale     1
///   range     between the half percents at either end, and at most a twentieth of the span beyond;
///             at the near end also the last ten-thousandth. Distances beyond twice the span of the
///             nearest nine tenths do not count
///
/// The range then has the origin `found`, the other facts `assumed`.
void guess(const std::vector<cv::Mat>& pictures, int bits, DepthMeaning& meaning,
           const RankedStatements& statements);

/// Whether the statements have all these facts, so that nothing has to be guessed.
[[nodiscard]] bool is_all_stated(const RankedStatements& statements);

/// The share of the pictures' pixels without data by that meaning, in [0, 1].
[[nodiscard]] double holes_share(const std::vector<cv::Mat>& pictures, const DepthMeaning& meaning);

/// The number of different levels in the pictures.
[[nodiscard]] int levels_used(const std::vector<cv::Mat>& pictures);

}  // namespace dibhr
