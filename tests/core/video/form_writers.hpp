// What writes a picture, or a video of three of it, into a file of one form or another.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>

namespace dibhr::test {

using Write = std::function<void(const std::filesystem::path&)>;

inline const std::string kFfv1_16 = "-c:v ffv1 -pix_fmt gray16le";

/// The pixels of a picture whose rows follow each other.
[[nodiscard]] std::string bytes_of(const cv::Mat& picture);

/// In the form that the file's ending says, by OpenCV.
[[nodiscard]] Write picture(const cv::Mat& content);
[[nodiscard]] Write text(const std::string& bytes);
/// A zip file of one entry, deflated.
[[nodiscard]] Write zip_of(const std::string& entry, const std::string& bytes);
/// An EXR file of one channel of 32-bit floats.
[[nodiscard]] Write exr(const std::string& channel, const cv::Mat& content);

/// ffmpeg's input of three raw pictures, which it writes into `file`; `format` is ffmpeg's word for
/// them.
[[nodiscard]] std::string raw_input(const cv::Mat& content, const std::string& format,
                                    const std::filesystem::path& file);
/// A video of three pictures, by ffmpeg's output options.
[[nodiscard]] Write video(const cv::Mat& content, const std::string& format,
                          const std::string& encoding);

/// A video of a track of colour, 8-bit BGR, and one of depth with that title, without loss.
[[nodiscard]] Write tracks(const cv::Mat& colour, const cv::Mat& depth, const std::string& format,
                           const std::string& title);

}  // namespace dibhr::test
