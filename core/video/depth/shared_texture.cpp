// Searches blocks of one picture's fine structure in the other picture's.
#include "core/video/depth/shared_texture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr int kBlock_px = 32;
constexpr double kLeastEnergy = 0.25;  ///< mean square of fine structure [levels]

enum class Edges { count, are_left_out };

/// What is finer than five pixels, and where it counts.
struct FineStructure {
    cv::Mat levels{};  ///< CV_32F, 0 where it does not count
    cv::Mat counts{};  ///< CV_8U, else 0
};

FineStructure fine_structure(const cv::Mat& picture, Edges edges) {
    constexpr double kJump = 8.0;  // levels a pixel
    cv::Mat around;
    cv::medianBlur(picture, around, 5);
    FineStructure fine;
    cv::subtract(picture, around, fine.levels, cv::noArray(), CV_32F);
    fine.counts = cv::Mat(picture.size(), CV_8U, cv::Scalar(255));
    if (edges == Edges::count) return fine;
    const cv::Mat rise = rise_of(around);
    cv::erode(rise < kJump, fine.counts, cv::Mat::ones(5, 5, CV_8U));
    fine.levels.setTo(0.0, ~fine.counts);
    return fine;
}

/// The highest correlation of a block with the places in a larger part of the other picture.
double best_correlation(const cv::Mat& part, const cv::Mat& block) {
    cv::Mat agreement;
    cv::matchTemplate(part, block, agreement, cv::TM_CCORR);
    cv::Mat energy;
    cv::matchTemplate(part.mul(part), cv::Mat::ones(block.size(), CV_32F), energy, cv::TM_CCORR);
    energy = cv::max(energy, kLeastEnergy * static_cast<double>(block.total()));
    cv::sqrt(energy * block.dot(block), energy);
    double highest = 0.0;
    cv::minMaxLoc(cv::abs(agreement / energy), nullptr, &highest);
    return std::min(highest, 1.0);
}

/// The median of the best correlations of the blocks; 0: too few have fine structure.
double agreement(const cv::Mat& colour, const cv::Mat& grey, Edges edges) {
    constexpr double kMostDisparity = 0.15;  // of the width
    constexpr int kMostUneven_px = 2;        // of stereo pictures that are not rectified
    constexpr double kLeastCounted = 0.4;    // of a block
    constexpr int kLeastBlocks = 4;
    constexpr int kOneBlockOf = 6;
    const FineStructure own = fine_structure(grey, edges);
    const cv::Mat other = fine_structure(colour, edges).levels;
    const int reach_px = static_cast<int>(kMostDisparity * grey.cols);
    const cv::Rect whole({}, grey.size());
    std::vector<double> best;
    int blocks = 0;
    for (int j = 0; j + kBlock_px <= grey.rows; j += kBlock_px) {
        for (int i = 0; i + kBlock_px <= grey.cols; i += kBlock_px) {
            ++blocks;
            const cv::Rect at(i, j, kBlock_px, kBlock_px);
            const cv::Mat block = own.levels(at);
            if (block.dot(block) < kLeastEnergy * at.area() ||
                cv::countNonZero(own.counts(at)) < kLeastCounted * at.area())
                continue;
            const cv::Rect around(i - reach_px, j - kMostUneven_px, kBlock_px + 2 * reach_px,
                                  kBlock_px + 2 * kMostUneven_px);
            best.push_back(best_correlation(other(around & whole), block));
        }
    }
    const int count = static_cast<int>(best.size());
    if (count < kLeastBlocks || kOneBlockOf * count < blocks) return 0.0;
    const auto middle = best.begin() + count / 2;
    std::nth_element(best.begin(), middle, best.end());
    return *middle;
}

}  // namespace

SharedTexture shared_texture(const cv::Mat& colour, const cv::Mat& grey) {
    constexpr double kLongSide_px = 320.0;
    const double scale = std::min(1.0, kLongSide_px / std::max(grey.cols, grey.rows));
    const cv::Size size(static_cast<int>(std::lround(grey.cols * scale)),
                        static_cast<int>(std::lround(grey.rows * scale)));
    if (std::min(size.width, size.height) < kBlock_px) return {};
    cv::Mat first;
    cv::Mat second;
    cv::resize(colour, first, size, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(grey, second, size, 0.0, 0.0, cv::INTER_AREA);
    return {agreement(first, second, Edges::are_left_out), agreement(first, second, Edges::count)};
}

}  // namespace dibhr
