// The filter in time: what does not move keeps its level from frame to frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/camera/camera_motion.hpp"
#include "core/video/cleaning/camera/shift.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/frame_groups.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

namespace cv {
class Mat;
}

namespace dibhr {

class EvenMotionSearch;

/// Averages each pixel over the frames before and after it in which it is on the same surface: the
/// nearest ones one by one, and, where a tile stands still, those farther in groups.
/// Levels that last two frames or less are removed, with two exceptions: parts as wide as a finger
/// that belong to a surface that stays; and moving parts, which are beside their place, on opposite
/// sides, before and after. Even motion has no lag, since the filter reaches as far ahead as back.
/// Where one surface replaces another, the frames of both are not mixed.
/// Where most of the picture moves, as before a moving camera, each tile is averaged along that
/// motion or in its place, whichever fits it.
class TemporalFilter {
  public:
    /// Filters frame `now` of `frames`, which follow each other in time. Frames of another size or
    /// highest level are ignored. The same frames give the same bits.
    [[nodiscard]] DepthImage filtered(std::span<const SingleFrameDepth* const> frames,
                                      std::size_t now, const DepthNoise& noise);

    /// Of the frame that was filtered last.
    [[nodiscard]] const TimeEvidence& evidence() const noexcept { return evidence_; }

  private:
    /// A row's sums of the mean, beside the level that others are compared with.
    struct Sums {
        std::vector<float> reference{}, per_bound{}, sum{}, squares{};
        float* weights{nullptr};  ///< in the evidence

        /// Of `count` pixels.
        void start(std::size_t count, float* weights_there);
    };
    struct Neighbour {
        const float* levels;
        const std::uint8_t* filled;  ///< null: no pixel
        Shift shift{};               ///< where most of the picture moves
    };
    using Neighbours = std::array<Neighbour, 2 * kNearInTime + 1>;
    /// Tiles side by side that are read alike.
    struct Piece {
        int left;
        std::size_t count;  ///< of columns
        bool moves;         ///< along the picture's motion
    };
    /// A pixel that may be a part of the lasting surface beside it.
    struct Held {
        float level, reference;
        float alike;  ///< largest difference to that surface
    };

    /// Columns [left, right), rows [top, bottom).
    struct Region {
        int left, top, right, bottom;
    };

    void gather(std::span<const SingleFrameDepth* const> frames, std::size_t now);
    void find_motion(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                     const DepthNoise& noise);
    void choose_tiles(const DepthImage& here);
    void share_weights(const DepthImage& out);
    void add_misfits(int j, bool moves, const DepthImage& here);
    void find_pieces(std::size_t row_of_tiles, std::size_t tiles, std::size_t columns);
    [[nodiscard]] Neighbours rows_at(std::size_t at) const;
    [[nodiscard]] Neighbours rows_of(const Piece& piece, int j, const DepthImage& size);
    [[nodiscard]] const float* row_of(const FrameGroup& group, const Piece& piece, int j,
                                      std::size_t number, const DepthImage& size);
    void find_reference(const Neighbours& rows, const float* here, std::size_t count,
                        float* reference) const;
    [[nodiscard]] float reference_at(const DepthImage& here, std::size_t at) const;
    [[nodiscard]] bool average_rows(const SingleFrameDepth& here, DepthImage& out);
    void average(const float* reference, std::size_t at, std::size_t count, DepthImage& out);
    void add_near(const Neighbours& rows, std::size_t left, std::size_t count, Sums& sums) const;
    void take_mean(const Sums& sums, std::size_t at, DepthImage& out);
    void measure_variances(int rows, const DepthImage& out);
    void add_groups(const Piece& piece, int top, int rows, const DepthImage& out);
    void find_still(const FrameGroup& group, const Piece& piece, int top, int rows,
                    const DepthImage& out);
    [[nodiscard]] const std::uint8_t* filled_of(const Neighbour& n) const;
    void follow_parts(const SingleFrameDepth& here, DepthImage& out);
    void follow_motion(const SingleFrameDepth& here, DepthImage& out);
    [[nodiscard]] bool take_samples(const DepthImage& here, const Region& region,
                                    EvenMotionSearch& search);
    void follow_region(const SingleFrameDepth& here, const Region& region,
                       const EvenMotionSearch& search, DepthImage& out);
    [[nodiscard]] bool is_other(const SingleFrameDepth& here, std::size_t at) const;
    void follow_between(const DepthImage& here);
    void follow_patches(const DepthImage& here);
    [[nodiscard]] std::vector<char> held_patches(const DepthImage& here, const cv::Mat& patches,
                                                 const cv::Mat& to_rim, int count, int left,
                                                 int top) const;
    [[nodiscard]] Held held_at(const DepthImage& here, int i, int j) const;
    [[nodiscard]] bool is_held(const DepthImage& here, const Held& held, int i, int j, int right,
                               int down) const;

    NoiseBound bound_{};   ///< beyond, a level is perhaps another surface
    NoiseBound mixing_{};  ///< from full weight to none
    Neighbours neighbours_{};
    std::size_t count_{0};
    std::size_t now_{0};                      ///< the frame itself, of these
    bool any_filled_{false};                  ///< of the neighbours' pixels
    std::size_t first_near_{0}, nearest_{0};  ///< the neighbours in the median: first, count
    std::vector<std::uint8_t> other_{};       ///< where the frame's own level is another surface
    std::vector<std::uint8_t> inner_{};       ///< where that is so all around, too
    std::vector<std::uint8_t> followed_{};    ///< 1 where the own level is kept all the same
    std::vector<std::uint8_t> nothing_filled_{};  ///< a row of zeros
    std::vector<std::size_t> surely_other_{};     ///< pixels of a region with kSurelyOther
    Sums run_{};
    std::vector<Sums> rows_{};  ///< of a row of tiles
    CameraMotion camera_{};
    FrameGroups groups_{}, moving_groups_{};
    std::span<const FrameGroup> far_{}, moving_far_{};  ///< groups of frames
    int farthest_shift_{0};                             ///< of any frame, to a side; 0: no motion
    std::vector<std::uint8_t> moving_{};           ///< 1: of all tiles, those read along the motion
    std::array<std::vector<float>, 2> misfits_{};  ///< of all tiles: in place, along the motion
    std::vector<Piece> pieces_{};                  ///< of a row of tiles
    std::vector<float> shifted_{};
    std::vector<std::uint8_t> shifted_filled_{};
    std::vector<std::uint8_t> still_{};  ///< 1: of a row of tiles, those that all groups agree on
    std::vector<float> off_{}, squared_off_{}, counted_{};  ///< of columns
    /// Variance of a mean of frames, over that of frames without correlation: in place, and along
    /// the motion.
    std::array<float, 2> shared_{1.0F, 1.0F};
    TimeEvidence evidence_{};
};

}  // namespace dibhr
