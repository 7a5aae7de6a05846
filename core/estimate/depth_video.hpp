// Writes a lossless video of depth: FFV1 in Matroska, grey, 8 or 16 bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/av/track_encoder.hpp"
#include "core/av/track_file.hpp"

namespace dibhr {

struct DepthVideoShape {
    int columns{0}, rows{0};
    int bits{16};              ///< of a level: 8 or 16
    double pixel_aspect{1.0};  ///< width of a shown pixel divided by its height
};

class DepthVideo {
  public:
    /// Overwrites the file. Throws InputError.
    DepthVideo(const std::filesystem::path& file, const DepthVideoShape& shape);

    /// CV_8UC1 or CV_16UC1. `shown_s` must be at least a millisecond after that of the picture
    /// before; it is rounded to milliseconds. Throws InputError, e.g. when the disk is full.
    void add(const cv::Mat& levels, double shown_s, double interval_s);
    /// No add() afterwards. Throws InputError.
    void finish();

  private:
    void write(AVPacket& packet);

    TrackEncoder encoder_;
    TrackFile file_;
    std::int64_t interval_ms_{1};
};

}  // namespace dibhr
