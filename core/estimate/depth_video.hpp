// A video of depth that loses nothing: FFV1 in Matroska, grey, 8 or 16 bits.
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
    double pixel_aspect{1.0};  ///< how many times as wide as high a pixel is to be shown
};

class DepthVideo {
  public:
    /// Writes over the file. Throws InputError.
    DepthVideo(const std::filesystem::path& file, const DepthVideoShape& shape);

    /// CV_8UC1 or CV_16UC1. `shown_s` is later than that of the picture before, by a millisecond at
    /// least, and rounded to one. Throws InputError, e.g. when the disk is full.
    void add(const cv::Mat& levels, double shown_s, double interval_s);
    /// Nothing may be added any more. Throws InputError.
    void finish();

  private:
    void write(AVPacket& packet);

    TrackEncoder encoder_;
    TrackFile file_;
    std::int64_t interval_ms_{1};
};

}  // namespace dibhr
