// Media whose frames carry the last level of each pixel that now has no data.
#pragma once

#include <memory>
#include <optional>

#include "core/video/cleaning/holes/depth_memory.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// The held levels depend on the file alone, not on earlier seeks: for a seek to a frame with holes
/// the frames of the second before are read first. For other frames nothing more is read.
class HeldLevelsMedia : public Media {
  public:
    explicit HeldLevelsMedia(std::unique_ptr<Media> media) : media_(std::move(media)) {}

    [[nodiscard]] const MediaDescription& description() const override {
        return media_->description();
    }
    /// The next frame, with its held levels.
    std::optional<RawFrame> next() override;
    /// Reads the frames before it, too, where frames may have holes.
    std::optional<RawFrame> next_from(double earliest_s) override;
    /// Reads nothing until the next frame is requested.
    void seek(double media_s) override { place(media_s, Content::all); }
    void seek_depth(double media_s) override { place(media_s, Content::depth); }
    /// That frame has no held levels.
    void seek_near(double media_s) override;
    void leave_out_depth(const FrameTimes& times) override { media_->leave_out_depth(times); }

  private:
    enum class Content { all, depth };

    void place(double media_s, Content content);
    void seek_now(double media_s);
    std::optional<RawFrame> read();
    std::optional<RawFrame> read_at(double media_s);

    std::unique_ptr<Media> media_;
    DepthMemory memory_{};
    bool never_has_holes_{false};       ///< as of the last frame
    std::optional<double> wanted_s_{};  ///< target of a seek; nothing: the following frame
    Content content_{Content::all};     ///< of the frames since that seek
};

}  // namespace dibhr
