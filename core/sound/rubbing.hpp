// The rubbing part of touch: texture and scraping, for the speakers and a game pad's motors.
#pragma once

#include "core/sound/filters.hpp"
#include "core/sound/tick_history.hpp"

namespace dibhr {

inline constexpr double kScrapingGain = 0.8;  ///< of the hiss of a material

/// 0 .. 1: how loud scraping is, by speed and force.
[[nodiscard]] double scraping_of(const TickFeatures& tick) noexcept;

/// Texture: force and height, above 30 Hz.
class Texture {
  public:
    /// `rate_hz`: calls of next() a second.
    explicit Texture(double rate_hz) noexcept;

    /// The next value, limited softly to +-0.6, as the force may jump by newtons over an edge.
    [[nodiscard]] double next(const TickFeatures& tick) noexcept;

    /// Clears the filters: a constant force and height are no texture.
    void reset() noexcept;

  private:
    HighPass force_, height_;
    bool begins_{true};
    TickFeatures origin_{};  ///< where force and height were when it began
};

}  // namespace dibhr
