// Estimates where every pixel of a frame has gone when the next one is there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/video/frames/frame_window.hpp"
#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"
#include "core/video/motion/motion_search.hpp"
#include "core/video/motion/motion_sums.hpp"
#include "core/video/motion/reused.hpp"

namespace dibhr {

/// To each side, no way is longer than this part of the picture's width.
inline constexpr double kFarthestMotion = 1.0 / 16.0;

/// The same two frames give the same bits; scratch memory is kept inside. One thread at a time.
class MotionEstimator {
  public:
    /// From one frame to the next, of one size and scale, at least 2 x 2; by their colour, or,
    /// where one has none of its depth's view, by the depth. Null: nothing moves, or nothing shows
    /// that it does.
    [[nodiscard]] std::shared_ptr<const MotionField> between(const Frame& from, const Frame& to);

  private:
    using Way = MotionField::Way;
    /// What is near in a cell, or what is far.
    struct Part {
        int i, j;
        std::size_t part;
    };
    enum class Verdict : std::uint8_t { stays, may_go, goes };
    struct Convinced {
        Part part;
        int plain;  ///< steps over what is plain
    };

    [[nodiscard]] bool find_changed();
    void find_rows();
    void sum(std::size_t size, const MotionLayers& wanted, const MotionWays& ways,
             MotionMeasure measure);
    void gather(int reach, MotionMeasure measure);
    void weigh_by_fit();
    void go_downhill(std::size_t size);
    void choose(std::size_t size);
    void propose(int right, int down);
    void attempt(std::size_t size);
    void take_better(float share);
    void leave_noise();
    void judge();
    void convince();
    void stop();

    /// visit(part, index) of all.
    template <typename Visit>
    void each_part(const Visit& visit) const;
    [[nodiscard]] Way way_of(const Part& part) const;
    void go(const Part& part, Way way);
    [[nodiscard]] bool is_plain(const Part& part, Way way) const;
    [[nodiscard]] Verdict& verdict(const Part& part);
    [[nodiscard]] float gap(const Part& a, const Part& b) const;  ///< between their depths

    MotionPictureMaker maker_{};
    MotionSearcher searcher_{};
    MotionSide from_{}, to_{};
    /// What the second one was made of: mostly the next first ones.
    std::shared_ptr<const DepthImage> last_depth_{};
    std::shared_ptr<const ColourImage> last_colour_{};
    bool by_depth_{false};
    MotionKin kin_{};        ///< of the first one's parts
    MotionLayers wanted_{};  ///< 1: the part is looked at
    MotionLayers trust_{};   ///< in what a part says of those around it, in [0, 1]
    MotionRows rows_{};
    MotionLayers differs_{};  ///< 1: what is tried is another way
    MotionWays ways_{}, tried_{}, chosen_{}, even_{};
    MotionLayers best_{};   ///< how far off what was tried is
    MotionLayers still_{};  ///< and standing still
    std::array<std::vector<Verdict>, 2> verdicts_{};
    MotionSums sums_{}, own_{}, gathered_{}, slopes_{};
    Reused<MotionField> fields_{};
};

}  // namespace dibhr
