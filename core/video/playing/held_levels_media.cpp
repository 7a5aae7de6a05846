// Reads the second before a frame with holes.
#include "core/video/playing/held_levels_media.hpp"

#include <algorithm>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

std::optional<RawFrame> HeldLevelsMedia::next() {
    if (!wanted_s_) return read();
    const double media_s = *wanted_s_;
    wanted_s_.reset();
    return read_at(media_s);
}

std::optional<RawFrame> HeldLevelsMedia::next_from(double earliest_s) {
    if (wanted_s_ || !never_has_holes_) return Media::next_from(earliest_s);
    return media_->next_from(earliest_s);
}

void HeldLevelsMedia::place(double media_s, Content content) {
    wanted_s_ = media_s;
    content_ = content;
}

void HeldLevelsMedia::seek_now(double media_s) {
    content_ == Content::depth ? media_->seek_depth(media_s) : media_->seek(media_s);
}

void HeldLevelsMedia::seek_near(double media_s) {
    wanted_s_.reset();
    memory_.forget();
    media_->seek_near(media_s);
}

std::optional<RawFrame> HeldLevelsMedia::read() {
    std::optional<RawFrame> frame = media_->next();
    if (!frame) return frame;
    never_has_holes_ = frame->never_has_holes;
    const bool has_before = !media_->description().still;
    if (has_before && !never_has_holes_) frame->held = memory_.take(frame->depth, frame->media_s);
    return frame;
}

std::optional<RawFrame> HeldLevelsMedia::read_at(double media_s) {
    memory_.forget();
    seek_now(media_s);
    std::optional<RawFrame> frame = read();
    if (!frame || frame->never_has_holes || frame->index == 0 || !has_holes(frame->depth))
        return frame;
    const double frame_s = frame->media_s;
    memory_.forget();
    seek_now(std::max(0.0, frame_s - kHold_s - 2.0 * kTimeTolerance_s));
    do frame = read();
    while (frame && frame->media_s < frame_s);
    return frame;
}

}  // namespace dibhr
