// One file as a row of pictures with presentation times; inside the room, so OpenCV types may show.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace dibhr {

/// A decoded picture: 8-bit BGR, or as the file has it where depth needs it (8 or 16 bits, 1 to 4
/// channels). Shared with nobody who writes.
struct TimedPicture {
    cv::Mat picture{};
    double time_s{0.0};  ///< presentation time, from the file's own beginning
    std::int64_t index{0};
};

/// What is known of a source so far; it grows as frames are read.
struct SourceFacts {
    std::filesystem::path file{};
    int columns{0};
    int rows{0};
    int bits{8};
    int channels{3};
    std::string codec{};
    double duration_s{0.0};
    double frames_per_s{0.0};
    std::int64_t frames{0};
    bool frames_exact{false};
    bool still{false};
    std::string remark{};
};

enum class PictureRole { colour, depth };

class PictureSource {
  public:
    virtual ~PictureSource() = default;
    [[nodiscard]] virtual const SourceFacts& facts() const = 0;
    /// The next picture in order of time; nothing at the end.
    virtual std::optional<TimedPicture> next() = 0;
    /// The next picture returned is the one shown at `time_s`: the first before the beginning, the
    /// last after the end.
    virtual void seek(double time_s) = 0;
};

/// A still image or a video, told apart by content. Throws InputError.
[[nodiscard]] std::unique_ptr<PictureSource> open_picture_source(const std::filesystem::path& file,
                                                                 PictureRole role);

}  // namespace dibhr
