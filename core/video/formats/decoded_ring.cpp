// Refers to libav's frames, which free their memory with the last reference.
#include "core/video/formats/decoded_ring.hpp"

extern "C" {
#include <libavutil/buffer.h>
#include <libavutil/frame.h>
}

#include <algorithm>
#include <new>
#include <utility>

#include "core/video/formats/av_frame.hpp"

namespace dibhr {

void DecodedRing::add(const AVFrame& frame, double time_s, std::int64_t index) {
    const std::size_t bytes = bytes_of(frame);
    if (frame.hw_frames_ctx != nullptr || bytes > kMostBytes) return clear();
    const std::size_t most = few_ ? kFewBytes : kMostBytes;
    while (!pictures_.empty() && (bytes_ + bytes > most || pictures_.size() >= kMostPictures)) {
        bytes_ -= pictures_.front().bytes;
        pictures_.pop_front();
    }
    DecodedPicture picture{new_frame(), time_s, index, bytes};
    if (av_frame_ref(picture.frame.get(), &frame) < 0) throw std::bad_alloc();
    pictures_.push_back(std::move(picture));
    bytes_ += bytes;
}

void DecodedRing::clear() noexcept {
    pictures_.clear();
    bytes_ = 0;
}

std::optional<std::size_t> DecodedRing::place_at(double time_s) const {
    const auto later = std::upper_bound(
        pictures_.begin(), pictures_.end(), time_s,
        [](double wanted_s, const DecodedPicture& picture) { return wanted_s < picture.time_s; });
    if (later == pictures_.begin() || later == pictures_.end()) return std::nullopt;
    return static_cast<std::size_t>(later - pictures_.begin()) - 1;
}

std::size_t DecodedRing::room() const noexcept {
    if (pictures_.empty()) return 0;
    const std::size_t bytes = std::max<std::size_t>(pictures_.back().bytes, 1);
    return std::min(kMostPictures, kMostBytes / bytes);
}

}  // namespace dibhr
