// Decodes a colour video from its begin to its end.
#include "core/estimate/colour_frames.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/modules/picture_codecs.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// A larger start means a clock that counts from 1970 or the machine's start: no other shares it.
constexpr double kLongestStart_s = 1e5;

void write_frame(const cv::Mat& picture, const fs::path& file) {
    constexpr int kQuick = 1;  // of 9: the pictures are read once
    bool written = false;
    try {
        written =
            picture_codecs().write(file.string(), picture, {cv::IMWRITE_PNG_COMPRESSION, kQuick});
    } catch (const cv::Exception&) {
    }
    if (!written)
        throw InputError("the frames for the estimator cannot be written to " + shown(file) +
                         ": make room for them, or let XDG_CACHE_HOME name a folder that has some");
}

template <typename Take>
ColourFrames read_all(const fs::path& colour, const std::atomic<bool>& stop,
                      const ReportFrames& report, const Take& take) {
    const std::unique_ptr<PictureSource> source = open_picture_source(colour, PictureRole::colour);
    ColourFrames frames;
    frames.file = colour;
    while (!stop) {
        const auto picture = source->next();
        if (!picture) break;
        frames.times_s.push_back(picture->time_s);
        take(picture->picture, frames.count());
        const auto about = static_cast<std::size_t>(std::max<std::int64_t>(
            source->facts().frames, static_cast<std::int64_t>(frames.count())));
        report(frames.count(), about);
    }
    const SourceFacts& facts = source->facts();
    frames.columns = facts.columns;
    frames.rows = facts.rows;
    frames.still = facts.still;
    const bool is_time = facts.start_s > 0.0 && facts.start_s < kLongestStart_s;
    frames.start_s = is_time ? facts.start_s : 0.0;
    if (frames.times_s.empty() && !stop)
        throw InputError(shown(colour) + " holds no picture: give a video or pictures in colour");
    return frames;
}

}  // namespace

std::string frame_name(std::size_t number) {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu", number);
    return name;
}

double ColourFrames::interval_s() const noexcept {
    return count() < 2 ? 1.0 : times_s.back() / static_cast<double>(count() - 1);
}

ColourFrames read_colour_frames(const fs::path& colour, const std::atomic<bool>& stop,
                                const ReportFrames& report) {
    return read_all(colour, stop, report, [](const cv::Mat&, std::size_t) {});
}

ColourFrames write_colour_frames(const fs::path& colour, const fs::path& folder,
                                 const std::set<std::size_t>& without,
                                 const std::atomic<bool>& stop, const ReportFrames& report) {
    std::error_code failed;
    fs::remove_all(folder, failed);
    fs::create_directories(folder, failed);  // a failure is reported by the first picture
    return read_all(colour, stop, report, [&](const cv::Mat& picture, std::size_t number) {
        if (!without.contains(number)) write_frame(picture, folder / (frame_name(number) + ".png"));
    });
}

}  // namespace dibhr
