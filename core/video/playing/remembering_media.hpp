// Media whose frames know what their pixels without data were a moment before.
#pragma once

#include <memory>
#include <optional>

#include "core/video/cleaning/depth_memory.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// What a frame holds depends on the file alone, not on the way to it: after a seek to a frame
/// with holes the frames of the second before are read first, and only then.
class RememberingMedia : public Media {
  public:
    explicit RememberingMedia(std::unique_ptr<Media> media) : media_(std::move(media)) {}

    [[nodiscard]] const MediaDescription& description() const override {
        return media_->description();
    }
    /// With its held levels.
    std::optional<RawFrame> next() override;
    /// Those before it are read, too, where they may have holes.
    std::optional<RawFrame> next_from(double earliest_s) override;
    /// Nothing is read before the next frame is asked for.
    void seek(double media_s) override { wanted_s_ = media_s; }
    /// That frame holds nothing.
    void seek_near(double media_s) override;

  private:
    std::optional<RawFrame> read();
    std::optional<RawFrame> read_at(double media_s);

    std::unique_ptr<Media> media_;
    DepthMemory memory_{};
    bool always_whole_{false};          ///< as the last frame said
    std::optional<double> wanted_s_{};  ///< where the next frame is; nothing: it follows
};

}  // namespace dibhr
