// Frames of one media, cleaned, in any order: keeps the last few so that stepping back is
// immediate.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "core/video/depth_cleaning.hpp"
#include "core/video/frame_window.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// What the last frame cost.
struct FrameCost {
    double decode_ms{0.0};
    double clean_ms{0.0};
    std::chrono::steady_clock::time_point cleaned{};  ///< when it was ready
};

/// One thread at a time. Frames are named by their presentation time in the file; those
/// given out have `time_s` 0. Everything that decodes may throw InputError.
class FrameReader {
  public:
    /// Every frame carries `number`, for who needs to know where it came from.
    explicit FrameReader(std::unique_ptr<Media> media, std::uint32_t number = 0);

    /// The frame shown at `media_s`; the first before the beginning, the last after the end.
    std::optional<Frame> at(double media_s);
    /// The frame after the one at exactly `media_s`; nothing at the end.
    std::optional<Frame> after(double media_s);
    /// The frame before the one at exactly `media_s`; nothing at the beginning.
    std::optional<Frame> before(double media_s);

    /// How long the last frame, the one at exactly `media_s`, is shown: as long as the one before
    /// [s].
    [[nodiscard]] double last_interval_s(double media_s);

    /// From here on frames come cleaned so; those given out before are asked for again.
    void set_cleaning(const CleaningOptions& options);

    [[nodiscard]] const MediaDescription& description() const { return media_->description(); }
    [[nodiscard]] const FrameCost& cost() const { return cost_; }

  private:
    /// A decoded frame and its neighbours, as far as they were read one after the other.
    struct Kept {
        Frame raw{};
        std::shared_ptr<const DepthImage> cleaned{};
        std::optional<double> previous_s{}, next_s{};
    };

    Kept* find(double media_s);
    Kept* read();  ///< decodes the next frame and keeps it; null at the end
    void jump_to(double media_s);
    void drop_oldest();
    Frame cleaned(Kept& kept);

    std::unique_ptr<Media> media_;
    std::uint32_t number_;
    DepthCleaner cleaner_{};
    CleaningOptions cleaning_{};
    std::deque<Kept> kept_{};             ///< in the order of decoding
    bool begun_{false};                   ///< something has been read
    std::optional<double> position_s_{};  ///< of the last decoded frame, if the next one follows it
    FrameCost cost_{};
};

}  // namespace dibhr
