// What describes a whole video: its first picture, some from all over it, and all times.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/formats/video_packets.hpp"

namespace dibhr {

namespace {

constexpr double kMostSampled = 1e8;  ///< pixels decoded for samples: a third of a second
constexpr double kLarge = 1e6;        ///< pixels; of larger pictures the key frames are enough

}  // namespace

void VideoFile::count_frames(std::int64_t most) {
    for (std::int64_t read = 0; read < most && grab(); ++read) {
    }
}

std::vector<cv::Mat> VideoFile::samples(int most) {
    std::vector<cv::Mat> pictures;
    const double pixels = static_cast<double>(facts_.columns) * facts_.rows;
    const double frames = kMostSampled / pixels;
    if (!ahead_.empty() && !ahead_.front().video) pictures.push_back(ahead_.front().picture);
    if (most <= static_cast<int>(pictures.size())) return pictures;
    if (static_cast<double>(facts_.frames) <= frames)
        sample_evenly(most, pictures);
    else if (has_times_)
        sample_by_jumps(most, static_cast<int>(frames / most), pictures);
    seek(0.0);
    return pictures;
}

cv::Mat VideoFile::first_in_colour() {
    if (ring_.size() == 0 || ring_.picture(0).index != 0) return {};
    decoder_.keep();
    decoder_.show_again(*ring_.picture(0).frame);
    const cv::Mat picture = decoder_.colour();
    decoder_.swap_kept();
    return with_square_pixels(picture, pixel_aspect_, PictureRole::colour);
}

/// A file without any times has the times that grab() gives: one interval after the other.
std::vector<double> VideoFile::picture_times_s() const {
    if (!listed_s_.empty()) return listed_s_;
    std::vector<double> times_s = packet_times_s(facts_.file, track_);
    const auto unknown = std::count_if(times_s.begin(), times_s.end(),
                                       [](double time_s) { return std::isnan(time_s); });
    if (std::cmp_equal(unknown, times_s.size())) {
        for (std::size_t k = 0; k < times_s.size(); ++k)
            times_s[k] = static_cast<double>(k) * interval_s_;
    } else if (unknown > 0) {
        return {};
    }
    std::sort(times_s.begin(), times_s.end());
    if (!times_s.empty()) times_s.front() = std::max(times_s.front(), 0.0);
    return is_rising(times_s) ? times_s : std::vector<double>{};
}

void VideoFile::sample_evenly(int most, std::vector<cv::Mat>& pictures) {
    const std::int64_t step = facts_.frames / most + 1;
    while (grab())
        if (index_ % step == 0) pictures.push_back(retrieve());
}

void VideoFile::sample_by_jumps(int most, int frames_each, std::vector<cv::Mat>& pictures) {
    std::vector<double> wanted_s;
    for (int k = 1; k < most; ++k) wanted_s.push_back(facts_.duration_s * k / most);
    for (std::size_t at = 0; at < wanted_s.size(); ++at) {
        if (!grab_sample(wanted_s, at, frames_each)) break;
        if (!ended_) pictures.push_back(retrieve());
    }
}

/// False where the file cannot jump.
bool VideoFile::grab_sample(const std::vector<double>& wanted_s, std::size_t at, int frames_each) {
    // Where key frames are far apart, decode on instead of decoding the same key frame again.
    const auto key_s = decoder_.packets().key_frame_s(wanted_s[at]);
    const bool jumps = !key_s || *key_s > time_s_;
    const bool is_large = static_cast<double>(facts_.columns) * facts_.rows > kLarge;
    const bool goes_on =
        at + 1 < wanted_s.size() && decoder_.packets().key_frame_s(wanted_s[at + 1]) == key_s;
    if (jumps && is_large && !goes_on) {
        if (!jump(wanted_s[at], 1)) return false;
        if (grab()) return true;
    }
    if (jumps && !jump(wanted_s[at])) return false;
    const int frames = jumps && is_large ? 0 : frames_each;
    for (int n = 0; n <= frames && grab(); ++n) {
    }
    return true;
}

}  // namespace dibhr
