// Known surfaces seen through a noisy camera: a level of 255 is a pixel of the paper's relief.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr::test {

/// The level at a pixel of a frame.
using Scene = std::function<double(int frame, int i, int j)>;

/// Normally distributed errors, independent from pixel to pixel and from frame to frame.
struct NoisyScene {
    Scene scene{};
    std::function<double(double level)> deviation{};  ///< [levels]
    int columns{160};
    int rows{120};
    double highest_level{255.0};

    [[nodiscard]] DepthImage truth(int frame) const {
        return image_of(columns, rows, highest_level,
                        [&](int i, int j) { return scene(frame, i, j); });
    }
    [[nodiscard]] std::vector<DepthImage> frames(int count, unsigned seed = 1) const {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        std::vector<DepthImage> made;
        for (int k = 0; k < count; ++k) {
            DepthImage& frame = made.emplace_back(truth(k));
            for (float& level : frame.levels) {
                const double error = deviation(static_cast<double>(level)) * normal(random);
                level = static_cast<float>(static_cast<double>(level) + error);
            }
        }
        return made;
    }
};

/// Root mean square of the difference, further than `border` from the image's border.
inline double rms_error(const DepthImage& a, const DepthImage& b, int border = 8) {
    double sum = 0.0;
    int count = 0;
    for (int j = border; j < a.rows - border; ++j) {
        for (int i = border; i < a.columns - border; ++i, ++count) {
            const double off = static_cast<double>(a.at(i, j)) - static_cast<double>(b.at(i, j));
            sum += off * off;
        }
    }
    return std::sqrt(sum / count);
}

}  // namespace dibhr::test
