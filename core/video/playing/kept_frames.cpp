// What a FrameReader keeps in memory.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>

#include "core/video/playing/frame_reader.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostKept = 48;
constexpr std::size_t kMostBytes = std::size_t{32} << 20;  ///< beside what cleaning needs
/// Frames read at once to step back: all that clean the frame before.
constexpr auto kMostReadBack = static_cast<double>(kReachInTime + 1);

std::size_t bytes_of(const DepthImage& depth) {
    return depth.levels.size() * sizeof(float);
}

}  // namespace

/// About as many frames as fit into memory beside the wanted one and the next.
double FrameReader::frames_read_back() const {
    const auto depth = static_cast<double>(description().depth_pixels());
    const double colour = 1.0 * description().colour_columns * description().colour_rows;
    const double bytes = depth * sizeof(float) + 3.0 * colour;
    return std::clamp(std::floor(kMostBytes / bytes) - 2.0, 1.0, kMostReadBack);
}

std::size_t FrameReader::Kept::bytes() const {
    std::size_t bytes = frame.colour_bytes();
    bytes += bytes_of(raw.depth) + raw.held.size() * sizeof(HeldLevel);
    if (const SingleFrameDepth* single_frame = raw.single_frame.get(); single_frame != nullptr)
        bytes += bytes_of(single_frame->depth) + single_frame->filled.size() +
                 single_frame->unseen.size();
    if (frame.depth) bytes += bytes_of(*frame.depth);
    if (frame.undilated) bytes += bytes_of(*frame.undilated);
    return bytes;
}

void FrameReader::Kept::forget_cleaned() {
    frame.depth.reset();
    frame.unseen.reset();
    frame.undilated.reset();
}

/// Makes room for one more frame. Keeps all that the wanted frame and the next one depend on. Of
/// other cleaned frames keeps only the result; removes frames farthest from the wanted one first.
void FrameReader::evict() {
    const auto stays = static_cast<std::ptrdiff_t>(reach() + 1);
    // Of large pictures fewer: another cleaning reads them again.
    const auto raw_stays = is_large() ? stays - 1 : stays;
    const auto wanted = kept_.lower_bound(wanted_s_);
    auto before = std::distance(kept_.begin(), wanted);
    auto after = std::distance(wanted, kept_.end());
    std::ptrdiff_t away = -before;
    std::size_t bytes = 0;
    for (auto& [media_s, kept] : kept_) {
        if (kept.is_cleaned() && std::abs(away) > raw_stays) kept.raw = {};
        ++away;
        bytes += kept.bytes();
    }
    while (bytes > kMostBytes || kept_.size() > kMostKept) {
        const double before_s = before > stays ? wanted_s_ - kept_.begin()->first : 0.0;
        const double after_s = after > stays + 1 ? kept_.rbegin()->first - wanted_s_ : 0.0;
        if (!(std::max(before_s, after_s) > 0.0)) break;
        const auto farthest = before_s > after_s ? kept_.begin() : std::prev(kept_.end());
        (before_s > after_s ? before : after) -= 1;
        bytes -= farthest->second.bytes();
        kept_.erase(farthest);
    }
    // Of earlier frames than the one before only the raw depth is needed, to clean others.
    for (auto at = kept_.begin(); at != wanted && std::next(at) != wanted; ++at) {
        if (bytes <= kMostBytes) return;
        Kept& kept = at->second;
        bytes -= kept.bytes();
        kept.frame.colour.reset();
        kept.frame.video.reset();
        kept.forget_cleaned();
        bytes += kept.bytes();
    }
}

}  // namespace dibhr
