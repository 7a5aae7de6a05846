// Means of four frames each: what is known of a still surface beyond the nearest frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/video/cleaning/camera/shift.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

namespace dibhr {

struct FrameGroup {
    const float* levels{nullptr};
    float later{0.0F};   ///< its middle, in frames after the one that is cleaned
    float weight{0.0F};  ///< of its levels: about that of its frames
    Shift shift{};       ///< to where they show what the frame that is cleaned does
};

/// Frames with the same quarter of their number are a group, however they were reached: it has the
/// same bits in the cleaning of every frame around it, and is computed once.
class FrameGroups {
  public:
    /// No level of a group: beyond every bound.
    static constexpr float kNoLevel = -1e9F;

    /// The whole groups that reach as far as kReachInTime from frame `now`, without the frames up
    /// to kNearInTime from it, in order of time. Frames alike to that one only. Where a group's
    /// frames differ by more than noise, or were filled, it has no level. `ways`: to what frame
    /// `now` shows, by frame; empty: nothing moves. Valid until the next call.
    [[nodiscard]] std::span<const FrameGroup> around(
        std::span<const SingleFrameDepth* const> frames, std::size_t now, const NoiseBound& noise,
        std::span<const PictureWay> ways = {});

  private:
    using Four = std::array<const SingleFrameDepth*, kGroupInTime>;
    using Shifts = std::array<Shift, kGroupInTime>;  ///< from the first of them
    struct Group {
        std::array<std::uint64_t, kGroupInTime> ids{};
        Shifts shifts{};
        std::vector<float> levels{};
    };

    [[nodiscard]] const float* group_of(const Four& frames, const Shifts& shifts,
                                        const NoiseBound& noise);
    void average(const Four& frames, const Shifts& shifts, const NoiseBound& noise, float* out);
    void balance();

    NoiseBound noise_{};
    std::vector<Group> groups_{}, kept_{};
    std::vector<FrameGroup> around_{};
    std::vector<float> row_{};
    std::vector<std::uint8_t> filled_row_{};
};

}  // namespace dibhr
