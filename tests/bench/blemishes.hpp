// Counts what a cleaned picture should not have: teeth along outlines, and pimples on flat ground.
#pragma once

#include <cstddef>

#include "core/haptics/depth_image.hpp"

namespace dibhr::bench {

struct Blemishes {
    /// Pixels of an outline (a step above 5 % of the range) that differ in side from both
    /// neighbours along it, per 100,000 px of picture.
    double teeth{0.0};
    /// Pixels above, or below, the eight around them and farther than 0.5 px from the plane that
    /// fits 9x9 pixels, per 1000 px of flat ground.
    double pimples{0.0};
    /// Of these, those with one of the same side there, or beside it, in the next frame.
    double pimples_again{0.0};
    /// Share of the picture that is flat ground: of such 9x9 pixels three quarters are within 0.5
    /// px of the plane, which is no steeper than 0.8.
    double flat{0.0};
};

/// Sums blemishes over frames, in pixels of a relief of 255. Level 0 is no data.
class BlemishMeter {
  public:
    /// `is_flat`: all that is added is known to be flat ground, whatever noise is on it.
    explicit BlemishMeter(bool is_flat = false) : is_flat_(is_flat) {}

    /// The blemishes of a frame; `next` follows it.
    void add(const DepthImage& frame, const DepthImage& next);
    [[nodiscard]] Blemishes blemishes() const;

  private:
    bool is_flat_;
    std::size_t pixels_{0}, teeth_{0};
    std::size_t ground_{0};  ///< pixels that have 9x9 around them
    std::size_t flat_{0}, pimples_{0}, again_{0};
};

}  // namespace dibhr::bench
