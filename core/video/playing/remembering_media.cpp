// Reads the second before a frame with holes.
#include "core/video/playing/remembering_media.hpp"

#include <algorithm>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

std::optional<RawFrame> RememberingMedia::next() {
    if (!wanted_s_) return read();
    const double media_s = *wanted_s_;
    wanted_s_.reset();
    return read_at(media_s);
}

std::optional<RawFrame> RememberingMedia::next_from(double earliest_s) {
    if (wanted_s_ || !always_whole_) return Media::next_from(earliest_s);
    return media_->next_from(earliest_s);
}

void RememberingMedia::seek_near(double media_s) {
    wanted_s_.reset();
    memory_.forget();
    media_->seek_near(media_s);
}

std::optional<RawFrame> RememberingMedia::read() {
    std::optional<RawFrame> frame = media_->next();
    if (!frame) return frame;
    always_whole_ = frame->always_whole;
    const bool has_before = !media_->description().still;
    if (has_before && !always_whole_) frame->held = memory_.take(frame->depth, frame->media_s);
    return frame;
}

std::optional<RawFrame> RememberingMedia::read_at(double media_s) {
    memory_.forget();
    media_->seek(media_s);
    std::optional<RawFrame> frame = read();
    if (!frame || frame->always_whole || frame->index == 0 || !has_holes(frame->depth))
        return frame;
    const double frame_s = frame->media_s;
    memory_.forget();
    media_->seek(std::max(0.0, frame_s - kHold_s - 2.0 * kTimeTolerance_s));
    do frame = read();
    while (frame && frame->media_s < frame_s);
    return frame;
}

}  // namespace dibhr
