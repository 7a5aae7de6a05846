// The prepared surface of a media, as far as there is one for the cleaning that is asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/prepared_cache.hpp"

namespace dibhr {

class PreparedFrames {
  public:
    /// No surface is looked for any more.
    void turn_off() noexcept;
    /// Looks for one, where the cleaning has changed.
    void look(const MediaDescription& media, const CleaningOptions& cleaning);

    [[nodiscard]] bool found() const noexcept { return surface_ != nullptr; }
    /// The cleaning of the surface that was found.
    [[nodiscard]] const CleaningPlan& plan() const noexcept { return surface_->plan; }
    /// The times of its frames; null: none was found.
    [[nodiscard]] FrameTimes times() const { return surface_ ? surface_->reader.times() : nullptr; }
    /// Adds its depth to the frame of exactly frame.media_s. False: there is none, or none that can
    /// be read, and from now on nothing is found.
    [[nodiscard]] bool fill(Frame& frame);

    /// A sentence once a surface could not be read; empty: none was damaged.
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }

  private:
    std::unique_ptr<PreparedSurface> surface_{};
    std::optional<CleaningOptions> looked_for_{};
    bool on_{true};
    std::string trouble_{};
};

}  // namespace dibhr
