// The built-in sample as OpenCV decodes it, read once for all tests.
#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace dibhr::test {

inline std::filesystem::path asset(const std::filesystem::path& name) {
    return std::filesystem::path{DIBHR_SOURCE_ASSETS} / name;
}

struct SampleVideo {
    std::vector<cv::Mat> colour{};  ///< 8UC3
    std::vector<cv::Mat> depth{};   ///< 8UC1
    double colour_frames_per_s{};
    double depth_frames_per_s{};
};

/// Frames of the sample; a file that cannot be opened gives none.
inline const SampleVideo& sample_video() {
    static const SampleVideo video = [] {
        SampleVideo read;
        cv::VideoCapture colour{asset("sample/color.mp4").string(), cv::CAP_FFMPEG};
        cv::VideoCapture depth{asset("sample/depth.mp4").string(), cv::CAP_FFMPEG};
        read.colour_frames_per_s = colour.get(cv::CAP_PROP_FPS);
        read.depth_frames_per_s = depth.get(cv::CAP_PROP_FPS);
        for (cv::Mat frame; colour.read(frame);) read.colour.push_back(frame.clone());
        for (cv::Mat frame, level; depth.read(frame);) {
            cv::extractChannel(frame, level, 0);
            read.depth.push_back(level.clone());
        }
        return read;
    }();
    return video;
}

}  // namespace dibhr::test
