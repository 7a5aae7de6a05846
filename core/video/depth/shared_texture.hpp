// Measures how much of the fine structure of two pictures is the same: tells a second photograph of
// a scene from its depth.
#pragma once

#include <opencv2/core/mat.hpp>

namespace dibhr {

/// How well the structure of two pictures that is finer than five pixels agrees, 0 to 1: medians
/// over the parts of one picture that have any, each where the other one agrees best with it, at
/// the same place, beside it or a little above or below. 0 where too few parts have any.
///
/// | of a colour picture and | inside | all |
/// |---|---|---|
/// | its grey copy | 1 | 1 |
/// | the other picture of a stereo pair, or infrared | 0.35 to 1 | 0.6 to 1 |
/// | noisy depth, also a displacement of the same texture | at most 0.2 | at most 0.75 |
struct SharedTexture {
    double inside{0.0};  ///< away from edges: these are silhouettes, which depth and colour share
    double all{0.0};
};

/// Both of 8 bits and one channel.
[[nodiscard]] SharedTexture shared_texture(const cv::Mat& colour, const cv::Mat& grey);

}  // namespace dibhr
