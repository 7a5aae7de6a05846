// Estimates where every pixel of a frame moves until the next frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/video/frames/frame_window.hpp"
#include "core/video/frames/object_pool.hpp"
#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"
#include "core/video/motion/motion_plain.hpp"
#include "core/video/motion/motion_search.hpp"
#include "core/video/motion/motion_sums.hpp"

namespace dibhr {

/// Longest way to each side, as a part of the picture's width.
inline constexpr double kFarthestMotion = 1.0 / 16.0;

/// The same two frames give the same bits; scratch memory is kept inside. One thread at a time.
class MotionEstimator {
  public:
    /// The motion from one frame to the next, which have one size and scale and are at least 2 x 2.
    /// By colour, or by depth where either frame has no colour of its depth's view. Null: nothing
    /// moves, or there is no evidence that it does.
    [[nodiscard]] std::shared_ptr<const MotionField> estimate(const Frame& from, const Frame& to);

  private:
    using Way = MotionField::Way;
    enum class Verdict : std::uint8_t { stays, may_go, goes };
    struct Confirmed {
        MotionPart part;
        int plain;  ///< steps over plain parts
    };

    [[nodiscard]] bool find_changed();
    void find_rows();
    void sum(std::size_t size, const MotionLayers& wanted, const MotionWays& ways,
             MotionMeasure measure);
    void gather(int reach, MotionMeasure measure);
    void find_trust();
    void weigh_by_trust();
    void go_downhill(std::size_t size);
    void choose(std::size_t size);
    void propose(int right, int down);
    void attempt(std::size_t size);
    void take_better(float share);
    void drop_noise();
    void judge();
    void confirm_neighbours();
    void stop_unconfirmed();

    [[nodiscard]] Way way_of(const MotionPart& part) const;
    void set_way(const MotionPart& part, Way way);
    [[nodiscard]] Verdict& verdict(const MotionPart& part);

    MotionPictureMaker maker_{};
    MotionSearcher searcher_{};
    MotionSide from_{}, to_{};
    /// Inputs of `to_`: mostly they are the next call's first frame.
    std::shared_ptr<const DepthImage> last_depth_{};
    std::shared_ptr<const void> last_colour_{};
    bool by_depth_{false};
    SimilarParts similar_{};  ///< of the first frame's parts
    PlainParts plain_{};
    float gain_{1.0F};       ///< of the second frame's grey
    MotionLayers wanted_{};  ///< 1: the part is processed
    MotionLayers trust_{};   ///< weight of a part for those around it, in [0, 1]
    MotionRows rows_{};
    MotionLayers differs_{};  ///< 1: the tried way is another one
    MotionWays ways_{}, tried_{}, chosen_{}, even_{};
    MotionLayers best_{};   ///< least mean square of the tried ways
    MotionLayers still_{};  ///< mean square without motion
    std::array<std::vector<Verdict>, 2> verdicts_{};
    MotionSums sums_{}, own_{}, gathered_{};
    ObjectPool<MotionField> fields_{};
};

}  // namespace dibhr
