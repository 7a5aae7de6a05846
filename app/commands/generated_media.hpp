// A colour + depth pair made in memory, for timing without files: a hill that wanders.
#pragma once

#include <optional>

#include "core/video/media.hpp"

namespace dibhr {

class GeneratedMedia final : public Media {
  public:
    GeneratedMedia(int columns, int rows, int frames, double frames_per_s);
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override;
    void seek(double media_s) override;

  private:
    MediaDescription description_{};
    std::int64_t next_{0};
};

}  // namespace dibhr
