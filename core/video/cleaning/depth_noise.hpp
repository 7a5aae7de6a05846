// The noise of a recording's depth, measured in its first frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/noise_character.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

namespace dibhr {

/// The step from a level to the next one that occurs, in parts of the highest level: constant for
/// whole levels, growing with the square of the distance for disparities.
struct StepByDistance {
    float constant{0.0F}, linear{0.0F}, square{0.0F};

    bool operator==(const StepByDistance&) const = default;

    /// 0: levels are continuous. `height`: the level over the highest one.
    [[nodiscard]] float at(float height) const noexcept {
        const float away = 1.0F - height;
        return constant + away * (linear + away * square);
    }
};

/// Standard deviation of a level by the surface's distance: a constant, a linear and a square part,
/// as stereo cameras have it (K. Khoshelham and S. Oude Elberink, Sensors 12, 2012). All in parts
/// of the highest level.
struct DepthNoise {
    float constant{0.0F};
    float linear{0.0F};  ///< added at the farthest level, falling to 0 at the nearest
    float square{0.0F};  ///< likewise, falling with the square
    /// How far neighbouring pixels have the same noise, in [0, 1]: 0 is grain, 1 is blotches.
    float correlation{0.0F};
    /// Each frame has its own scale and shift, as from estimators of depth from single pictures.
    bool per_frame_scale{false};
    NoiseCharacter character{};
    StepByDistance step{};

    bool operator==(const DepthNoise&) const = default;

    /// At a level; `height`: the level over the highest one.
    [[nodiscard]] float at(float height) const noexcept {
        const float away = 1.0F - height;
        return constant + away * (linear + away * square);
    }
};

// Tags of a file with depth that was recorded live: the noise, so that it is cleaned alike again,
// and the bits of a level.
inline constexpr const char* kNoiseTag = "DIBHR_NOISE";
inline constexpr const char* kBitsTag = "DIBHR_BITS";
[[nodiscard]] std::string text_of(const DepthNoise& noise);
/// The noise in such a text; nothing if it is none. Texts of older versions end before its
/// character, or before its last value.
[[nodiscard]] std::optional<DepthNoise> noise_in(const std::string& text);

/// How far levels of one surface may differ: a number of standard deviations.
class NoiseBound {
  public:
    NoiseBound() = default;
    bool operator==(const NoiseBound&) const = default;
    /// `least`: lower limit of the constant part, in parts of the highest level.
    NoiseBound(const DepthNoise& noise, float deviations, float least, double highest_level)
        : per_level_(1.0F / static_cast<float>(highest_level)) {
        const float levels = deviations * static_cast<float>(highest_level);
        constant_ = levels * std::max(noise.constant, least);
        linear_ = levels * noise.linear;
        square_ = levels * noise.square;
    }

    /// The bound at this level [levels].
    [[nodiscard]] float operator()(float level) const noexcept {
        const float away = std::max(1.0F - level * per_level_, 0.0F);
        return constant_ + away * (linear_ + away * square_);
    }

  private:
    float constant_{0.0F}, linear_{0.0F}, square_{0.0F};
    float per_level_{1.0F};
};

/// What a frame's neighbours in time tell of its pixels. Without variances: there are none.
struct TimeEvidence {
    static constexpr int kTile_px = 8;

    std::size_t near_frames{0};    ///< of those that count one by one: with this one
    /// Of each pixel: how many frames its level is the mean of, as if all shared as much noise as
    /// NoiseCharacter::kept says.
    std::vector<float> weights{};
    /// The variance of one frame's levels, of tiles of kTile_px, row-major [levels^2].
    std::vector<float> variances{};
};

/// Measures the noise of surfaces that stand still or move evenly.
class NoiseMeter {
  public:
    static constexpr std::size_t kEnoughFrames = 10;  ///< frames, a third of a second

    /// The next frame of the recording, not cleaned: NaN is no data. A frame of another size or
    /// highest level than the first one is ignored.
    void add(DepthImage frame);

    /// With one or two frames only: by their roughness. Without data: no noise.
    [[nodiscard]] DepthNoise noise() const;

  private:
    /// Mean of absolute values; NaN is ignored.
    struct Mean {
        double sum{0.0}, squares{0.0};
        std::size_t count{0};

        void add(float value) {
            if (std::isnan(value)) return;
            const auto size = static_cast<double>(std::fabs(value));
            sum += size;
            squares += size * size;
            ++count;
        }
        [[nodiscard]] double of_absolutes() const { return sum / static_cast<double>(count); }
        [[nodiscard]] double deviation() const {
            const double mean = of_absolutes();
            return std::sqrt(std::max(squares / static_cast<double>(count) - mean * mean, 0.0));
        }
    };
    struct Tile {
        Mean shaken{};  ///< second differences in time
        Mean rough{};   ///< differences from the pixels around
        Mean level{};
    };

    void add_tile(Tile& tile, const DepthImage& frame, int left, int top) const;
    [[nodiscard]] bool has_per_frame_scale() const;
    [[nodiscard]] StepByDistance step() const;

    std::vector<Tile> tiles_{};
    NoiseCharacterMeter character_{};
    DepthImage last_{}, before_last_{};
    std::vector<SingleFrameDepth> small_{};  ///< each frame, with fewer pixels
};

}  // namespace dibhr
