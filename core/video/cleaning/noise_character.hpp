// Which noise a recording's depth has: fine or coarse, fresh in each frame or standing still, in
// steps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/noise_bands.hpp"

namespace dibhr {

/// The highest correlation of noise from frame to frame that is measured or read.
inline constexpr float kMostKeptNoise = 0.9F;

/// Less noise is neither felt nor measured: in parts of the highest level (0.1 px of 255).
inline constexpr float kLeastNoise = 0.1F / 255.0F;

/// Of the variance of noise with this correlation from frame to frame: what second differences in
/// time show, 1 - 4/3 r + 1/3 r^2 where each frame's noise depends on the one before.
[[nodiscard]] float shown_in_time(float kept) noexcept;

/// How many times as many frames with such noise have a mean as even as independent ones.
[[nodiscard]] inline float frames_as_one(float kept) noexcept {
    return (1.0F + kept) / (1.0F - kept);
}

/// Independent of how much noise there is.
struct NoiseCharacter {
    /// The share of a pixel's variance that each band of NoiseBands has.
    std::array<float, kNoiseBands> bands{kWhiteBands};
    float kept{0.0F};  ///< correlation of a pixel's noise with that of the frame before, [0, 0.9]
    float kept_in_motion{0.0F};  ///< the same, without what shapes that move add to it
    float fixed{0.0F};  ///< deviation of grain that stands still [parts of the highest level]
    /// What stands still in each band, all over the picture, of the variance of what does not.
    std::array<float, kNoiseBands> standing{};

    bool operator==(const NoiseCharacter&) const = default;
};

/// The typical step from a level to the next one that occurs.
struct LevelStep {
    double away;   ///< 1 - level / highest
    double step;   ///< parts of the highest level; 0: levels are continuous
    double tiles;  ///< in how many tiles it was seen
};

/// The grain of levels about as far away.
struct LevelNoise {
    double away;       ///< 1 - level / highest
    double deviation;  ///< parts of the highest level
};

/// Measures the middle of frames (at most 640 x 480 px), tile by tile where all pixels have data.
class NoiseCharacterMeter {
  public:
    /// The next frame, of the size and highest level of the first one: NaN is no data.
    void add(const DepthImage& frame);

    [[nodiscard]] NoiseCharacter character() const;
    [[nodiscard]] std::vector<LevelStep> steps() const;
    /// Grain of a single picture, however coarse: the deviation in the smoothest tiles. Empty: in
    /// most tiles finer bands have no more than coarser ones, as shapes do, or not all alike.
    [[nodiscard]] std::vector<LevelNoise> still_noise() const;

  private:
    using Energies = std::array<float, kNoiseBands>;
    struct Seen {
        BandPicture picture{};             ///< no data: the level of the pixel before
        std::vector<std::uint8_t> data{};  ///< 1: has data
    };
    /// Of each measured frame; medians over frames leave out what passes.
    struct Tile {
        std::vector<Energies> in_time{}, in_space{};
        std::vector<float> variances{};  ///< of second differences in time
        /// Of differences over two frames to those over one; the same without the tile's mean.
        std::vector<float> ratios{}, level_ratios{};
        std::vector<float> levels{};
    };
    struct Bin;

    void look(const DepthImage& frame, Seen& seen) const;
    [[nodiscard]] bool has_data(const std::vector<std::uint8_t>& data, std::size_t tile) const;
    [[nodiscard]] static Energies energies_of(const NoiseBands& bands, int x, int y);
    [[nodiscard]] Energies standing(const Energies& moving, float kept) const;
    void measure(const BandPicture& picture, const std::vector<std::uint8_t>& data, bool in_time);
    void compare_frames();
    [[nodiscard]] std::vector<Bin> bins() const;
    [[nodiscard]] static std::optional<float> step_in(const Bin& bin);
    /// What one picture's grain has in each band, of each bin, 0 in bands that may be shape. Empty:
    /// most tiles may have none.
    [[nodiscard]] std::vector<Energies> still_grain(const std::vector<Bin>& bins) const;
    [[nodiscard]] static Energies grain_in(const Bin& bin, float highest);

    double highest_{1.0};
    int columns_{0}, rows_{0};  ///< of tiles
    std::size_t count_{0};
    Seen before_last_{}, last_{}, now_{};
    BandPicture change_{};
    std::vector<std::uint8_t> known_{};
    NoiseBands split_{};
    std::vector<Tile> tiles_{};
    std::vector<float> some_levels_{};      ///< of a few frames, for the steps
    BandPicture sum_{}, sum_of_first_{};    ///< of all frames, of the first half
    std::vector<std::uint8_t> seen_all_{};  ///< 1: had data in all of them
};

}  // namespace dibhr
