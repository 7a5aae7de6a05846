// What does not move keeps its level from frame to frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/lone_depth.hpp"

namespace cv {
class Mat;
}

namespace dibhr {

class MotionSearch;

/// Averages each pixel over the frames before and after it in which it is on the same surface.
/// What is there for two frames and gone again was never there, but for what is as wide as a finger
/// and a part of something that stays, and for what moves: it is beside its place before and after,
/// to opposite sides. Even motion has no lag, since it looks as far ahead as back; where a surface
/// leaves or comes, its frames are not mixed with those of the other one.
class TemporalFilter {
  public:
    /// Of frame `now` of `frames`, which follow each other in time. Frames of another size or
    /// highest level are passed over. Same frames, same bits.
    [[nodiscard]] DepthImage filtered(std::span<const LoneDepth* const> frames, std::size_t now,
                                      const DepthNoise& noise);

  private:
    struct Neighbour {
        const float* levels;
        const std::uint8_t* made_up;  ///< null: none of it
    };
    /// What may be held by what is beside it.
    struct Held {
        float level, reference;
        float alike;  ///< so far off another level may be
    };

    /// Columns [left, right), rows [top, bottom).
    struct Region {
        int left, top, right, bottom;
    };

    void gather(std::span<const LoneDepth* const> frames, std::size_t now);
    void find_reference(const float* here, std::size_t at, std::size_t count,
                        float* reference) const;
    [[nodiscard]] bool average_rows(const LoneDepth& here, DepthImage& out);
    void average(const float* reference, std::size_t at, std::size_t count, DepthImage& out);
    [[nodiscard]] const std::uint8_t* made_up_of(const Neighbour& n, std::size_t at) const;
    void follow_parts(const LoneDepth& here, DepthImage& out);
    void follow_motion(const LoneDepth& here, DepthImage& out);
    [[nodiscard]] bool take_samples(const DepthImage& here, const Region& region,
                                    MotionSearch& search);
    void follow_region(const LoneDepth& here, const Region& region, const MotionSearch& search,
                       DepthImage& out);
    [[nodiscard]] bool is_other(const LoneDepth& here, std::size_t at) const;
    void follow_between(const DepthImage& here);
    void follow_patches(const DepthImage& here);
    [[nodiscard]] std::vector<char> held_patches(const DepthImage& here, const cv::Mat& patches,
                                                 const cv::Mat& to_rim, int count, int left,
                                                 int top) const;
    [[nodiscard]] Held held_at(const DepthImage& here, int i, int j) const;
    [[nodiscard]] bool is_held(const DepthImage& here, const Held& held, int i, int j, int right,
                               int down) const;

    NoiseBound bound_{};
    std::array<Neighbour, 2 * kReachInTime + 1> neighbours_{};
    std::size_t count_{0};
    std::size_t first_near_{0}, nearest_{0};  ///< of those that the median is of
    std::vector<std::uint8_t> other_{};       ///< where the frame's own level is another surface
    std::vector<std::uint8_t> inner_{};       ///< and all around it
    std::vector<std::uint8_t> followed_{};    ///< 1 where that counts all the same
    std::vector<std::uint8_t> nothing_made_up_{};  ///< a row of zeros
    std::vector<std::size_t> surely_{};            ///< of a region, where that is surely so
    // Of one row: the level that others are compared with, and of the mean.
    std::vector<float> reference_{}, per_bound_{}, sum_{}, weights_{};
};

}  // namespace dibhr
