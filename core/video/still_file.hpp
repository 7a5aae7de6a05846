// A still image as a source of one picture.
#pragma once

#include <filesystem>
#include <optional>

#include "core/video/picture_source.hpp"

namespace dibhr {

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
