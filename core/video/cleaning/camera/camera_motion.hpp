// How the whole picture moves before a moving camera, from depth alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/noise_bands.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

namespace dibhr {

/// From the frame that is cleaned to another one [px].
struct PictureWay {
    float right{0.0F}, down{0.0F};
};

/// Finds the motion that most of the picture shares. Every second frame is made small, and each of
/// its bands of scale divided by the noise there: so shapes far below a pixel's noise tell, too.
/// How much two such pictures agree at every way, summed over the pairs of ten frames, is highest
/// at the motion. The same frames give the same bits.
class CameraMotion {
  public:
    /// The way of what frame `now` shows to each of `frames`, which follow each other in time.
    /// Empty where the picture stands still or shows too little. Valid until the next call.
    [[nodiscard]] std::span<const PictureWay> ways(std::span<const SingleFrameDepth* const> frames,
                                                   std::size_t now, const DepthNoise& noise);

  private:
    static constexpr std::size_t kLags = 2;  ///< pairs of frames 2 and 4 apart

    struct Velocity {
        float right{0.0F}, down{0.0F};  ///< px of small pictures a frame
    };
    /// How much two small pictures agree, by way.
    struct Pair {
        std::size_t later{0};  ///< the other one's place; 0: there is none
        std::uint64_t later_id{0};
        bool is_whole{false};  ///< else only the ways that are short are known
        std::vector<float> agrees{};
    };
    /// The ids of the small pictures of ten frames.
    using Ids = std::array<std::uint64_t, 6>;
    /// A small picture, as parts of the noise.
    struct Small {
        std::uint64_t id{0};
        std::int64_t number{0};
        BandPicture picture{};
        float energy{0.0F};               ///< mean square
        std::array<Pair, kLags> pairs{};  ///< with later ones
        Velocity velocity{};              ///< to the next one, computed from these:
        Ids from{};
    };

    void gather(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                const DepthNoise& noise);
    void make_small(const SingleFrameDepth& frame, const DepthNoise& noise, Small& made);
    void pair();
    void compare(Small& from, std::size_t lag, int reach);
    void compare_all(std::int64_t number);
    template <typename Visit>
    void visit_pairs(std::int64_t number, const Visit& visit);
    [[nodiscard]] bool stands_still(float sure) const;
    [[nodiscard]] float at(std::size_t lag, int right, int down) const;
    [[nodiscard]] Velocity velocity_from(std::int64_t number);
    [[nodiscard]] Velocity find_velocity(std::int64_t number);
    [[nodiscard]] float sum_agreements(std::int64_t number);
    [[nodiscard]] Velocity rough_velocity() const;
    [[nodiscard]] float agreement(Velocity at) const;

    DepthNoise noise_{};
    int shrink_{1};  ///< pixels of a frame to one of a small picture, each way
    std::vector<Small> small_{}, kept_{};
    std::vector<std::int64_t> numbers_{};
    NoiseBands bands_{};
    std::array<std::vector<float>, kLags> sums_{};
    std::vector<Velocity> velocities_{};  ///< of each two frames
    std::vector<PictureWay> ways_{};
    std::vector<float> row_{}, lanes_{};
};

}  // namespace dibhr
