// What of touch is rubbing: texture and scraping, as the ear and a game pad's motors are given
// them.
#pragma once

#include "core/sound/filters.hpp"
#include "core/sound/heard_ticks.hpp"

namespace dibhr {

inline constexpr double kScrapingHeard = 0.8;  ///< of the hiss of a material

/// 0 .. 1: how loud scraping is, by speed and force.
[[nodiscard]] double scraping_of(const HeardTick& tick) noexcept;

/// Texture: force and height, above 30 Hz.
class Texture {
  public:
    /// Of so many felt moments a second.
    explicit Texture(double rate_hz) noexcept;

    /// Of the next moment; held softly to +-0.6, as the force may leap by newtons over an edge.
    [[nodiscard]] double next(const HeardTick& felt) noexcept;

    /// What was felt is forgotten: being there is no texture.
    void be_quiet() noexcept;

  private:
    HighPass force_, height_;
    bool begins_{true};
    HeardTick rest_{};  ///< where force and height were when it began
};

}  // namespace dibhr
