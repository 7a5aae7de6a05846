// Video files of the sample, written through the ffmpeg program.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dibhr::sample {

/// A running ffmpeg that turns raw frames of kColumns x kRows into one file.
class VideoFile {
  public:
    /// Colour: H.264, 8 bits; good to the eye rather than exact.
    [[nodiscard]] static VideoFile colour(const std::filesystem::path& file);
    /// Depth: H.264 without loss, full range: every level comes back through OpenCV.
    [[nodiscard]] static VideoFile depth(const std::filesystem::path& file);

    /// Appends one frame; throws InputError when ffmpeg has ended.
    void write(const std::vector<std::uint8_t>& frame);
    /// Waits for ffmpeg to finish the file; throws InputError when it could not.
    void finish();

  private:
    struct Close {
        void operator()(std::FILE* pipe) const noexcept;
    };
    VideoFile(std::filesystem::path file, const std::string& pixels, const std::string& codec);

    std::filesystem::path file_{};
    std::unique_ptr<std::FILE, Close> pipe_{};
};

}  // namespace dibhr::sample
