// A recording whose frames a test lists.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/video/sources/media.hpp"

namespace dibhr::test {

/// Frames at equal intervals; counts the frames that are read.
class ListedMedia : public Media {
  public:
    ListedMedia(std::vector<DepthImage> frames, double frame_s, int* read = nullptr)
        : frames_(std::move(frames)), frame_s_(frame_s), read_(read) {
        description_.frames = static_cast<std::int64_t>(frames_.size());
        description_.frames_per_s = 1.0 / frame_s;
    }
    void set_sparse(std::optional<double> share) { description_.sparse_share = share; }
    /// Colour of the same view, a picture a frame.
    void set_colours(std::vector<ColourImage> colours) { colours_ = std::move(colours); }
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        if (position_ == frames_.size()) return std::nullopt;
        if (read_ != nullptr) ++*read_;
        RawFrame frame;
        frame.depth = frames_[position_];
        frame.colour_of_view = !colours_.empty();
        if (frame.colour_of_view) frame.colour = colours_[position_];
        frame.media_s = static_cast<double>(position_) * frame_s_;
        frame.index = static_cast<std::int64_t>(position_++);
        return frame;
    }
    void seek(double media_s) override {
        const double frame = std::floor((media_s + kTimeTolerance_s) / frame_s_);
        const auto last = static_cast<double>(frames_.size() - 1);
        position_ = static_cast<std::size_t>(std::clamp(frame, 0.0, last));
    }

  private:
    std::vector<DepthImage> frames_;
    std::vector<ColourImage> colours_{};
    double frame_s_;
    int* read_;
    std::size_t position_{0};
    MediaDescription description_{};
};

}  // namespace dibhr::test
