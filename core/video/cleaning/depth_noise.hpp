// How much the depth of a recording errs, measured in its first frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/lone_depth.hpp"

namespace dibhr {

/// Standard deviation of a level about what it should be, by how far the surface is away: constant,
/// and growing with the distance and with its square, as that of stereo cameras does (K. Khoshelham
/// and S. Oude Elberink, Sensors 12, 2012). All in parts of the highest level.
struct DepthNoise {
    float constant{0.0F};
    float linear{0.0F};  ///< more of it at the farthest level, falling to 0 at the nearest
    float square{0.0F};  ///< the same, falling with the square
    /// How far it is the same in pixels beside each other, in [0, 1]: blotches, not grain.
    float blotched{0.0F};
    /// Frames have a scale and a shift each, as those of estimators from single pictures have.
    bool of_scale{false};

    bool operator==(const DepthNoise&) const = default;

    /// Of a level that is `height` parts of the highest one.
    [[nodiscard]] float at(float height) const noexcept {
        const float away = 1.0F - height;
        return constant + away * (linear + away * square);
    }
};

// What a file of depth that was recorded live says of it beside its levels: the noise, by which it
// is cleaned again, and the bits of a level.
inline constexpr const char* kNoiseTag = "DIBHR_NOISE";
inline constexpr const char* kBitsTag = "DIBHR_BITS";
[[nodiscard]] std::string text_of(const DepthNoise& noise);
/// Nothing where it is no such text.
[[nodiscard]] std::optional<DepthNoise> noise_in(const std::string& text);

/// How far levels of one surface may differ: so many standard deviations.
class NoiseBound {
  public:
    NoiseBound() = default;
    /// No less than those of `least`, in parts of the highest level.
    NoiseBound(const DepthNoise& noise, float deviations, float least, double highest_level)
        : per_level_(1.0F / static_cast<float>(highest_level)) {
        const float levels = deviations * static_cast<float>(highest_level);
        constant_ = levels * std::max(noise.constant, least);
        linear_ = levels * noise.linear;
        square_ = levels * noise.square;
    }

    /// From this level [levels].
    [[nodiscard]] float operator()(float level) const noexcept {
        const float away = std::max(1.0F - level * per_level_, 0.0F);
        return constant_ + away * (linear_ + away * square_);
    }

  private:
    float constant_{0.0F}, linear_{0.0F}, square_{0.0F};
    float per_level_{1.0F};
};

/// Collects what stands still or moves evenly and is shaken all the same.
class NoiseMeter {
  public:
    static constexpr std::size_t kEnough = 10;  ///< frames, a third of a second

    /// The next frame of the recording, as recorded: NaN is no data. Of another size or highest
    /// level than the first one: passed over.
    void add(DepthImage frame);

    /// Of one or two frames it is what they are rough by. Nothing measured (no data): no noise.
    [[nodiscard]] DepthNoise noise() const;

  private:
    /// Of absolute values; NaN is passed over.
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
    [[nodiscard]] bool is_of_scale() const;

    std::vector<Tile> tiles_{};
    DepthImage last_{}, before_last_{};
    std::vector<LoneDepth> small_{};  ///< every frame, with few of its pixels
};

}  // namespace dibhr
