// Still pictures and the way from OpenCV's pictures to ours.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/haptics/depth_image.hpp"
#include "core/video/frame_window.hpp"
#include "core/video/picture_source.hpp"

namespace dibhr {

/// Grey levels of an 8- or 16-bit picture of 1 to 4 channels. Where the channels are equal the
/// level is exactly theirs, otherwise their luma.
[[nodiscard]] DepthImage depth_of(const cv::Mat& picture);

/// RGB of an 8-bit BGR picture.
[[nodiscard]] ColourImage colour_of(const cv::Mat& picture);

/// A still image as a source of one picture.
class StillFile : public PictureSource {
  public:
    /// Depth keeps its bits and channels, colour becomes 8-bit BGR. Throws InputError.
    StillFile(const std::filesystem::path& file, PictureRole role);

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    std::optional<TimedPicture> next() override;
    void seek(double time_s) override;

  private:
    SourceFacts facts_{};
    cv::Mat picture_{};
    bool given_{false};
};

}  // namespace dibhr
