// What is shown when: the frames around now on the playback timeline, and the clock that moves over
// them.
#include "core/video/playback.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {
namespace {

constexpr double kJump_s = 0.001;  ///< a jump begins later: no playback time means two frames

}  // namespace

void Playback::open(std::unique_ptr<FrameReader> reader, Time now) {
    reader->set_cleaning(cleaning_);
    auto first = reader->at(0.0);
    if (!first)
        throw InputError("'" + reader->description().depth_path.string() +
                         "' holds no frame: record it again");
    reader_ = std::move(reader);
    first_media_s_ = first->media_s;
    playing_ = true;
    jump_to(std::move(*first), now);
}

void Playback::anchor(double playback_s, Time now) {
    clock_ = {now, playback_s, playing_ ? speed_ : 0.0};
}

double Playback::moment(Time now) const {
    const double playback_s = clock_.playback_s(now);
    return frames_.empty() ? playback_s : std::min(playback_s, frames_.back().time_s);
}

void Playback::jump_to(Frame frame, Time now) {
    frame.time_s = frames_.empty() ? 0.0 : clock_.playback_s(now) + kJump_s;
    frames_.clear();
    frames_.push_back(std::move(frame));
    complete_ = false;
    ++discontinuity_;
    anchor(frames_.front().time_s, now);
}

bool Playback::single() const {
    return complete_ && frames_.size() == 1 && !(frames_.front().media_s > first_media_s_);
}

void Playback::play(Time now) {
    if (!is_open() || playing_) return;
    const bool at_end = complete_ && frames_.size() == 1;
    playing_ = !single();
    if (at_end && playing_)
        seek(first_media_s_, now);
    else
        anchor(moment(now), now);
}

void Playback::pause(Time now) {
    if (!is_open()) return;
    const double playback_s = moment(now);
    playing_ = false;
    anchor(playback_s, now);
}

void Playback::seek(double media_s, Time now) {
    if (!is_open()) return;
    if (auto frame = reader_->at(std::max(media_s, first_media_s_)))
        jump_to(std::move(*frame), now);
}

void Playback::step(int frames, Time now) {
    if (!is_open()) return;
    pause(now);
    Frame reached = frames_.front();
    for (int k = 0; k < std::abs(frames); ++k) {
        auto next = frames > 0 ? reader_->after(reached.media_s) : reader_->before(reached.media_s);
        if (!next) break;
        reached = std::move(*next);
    }
    jump_to(std::move(reached), now);
}

void Playback::set_looping(bool looping) {
    if (looping == looping_) return;
    looping_ = looping;
    complete_ = false;  // asked again by the next reading
    if (looping) return;
    // Frames of the next lap are forgotten, unless the surface is moving towards one already.
    for (std::size_t k = 2; k < frames_.size(); ++k)
        if (frames_[k].media_s <= frames_[k - 1].media_s) frames_.resize(k);
}

void Playback::set_speed(double speed, Time now) {
    speed_ = speed > kSlowestSpeed ? std::min(speed, kFastestSpeed) : kSlowestSpeed;
    anchor(moment(now), now);
}

void Playback::set_cleaning(const CleaningOptions& options) {
    if (options == cleaning_) return;
    if (is_open()) clean_again(options);
    cleaning_ = options;
}

/// All frames or none: no surface lies between two cleanings.
void Playback::clean_again(const CleaningOptions& options) {
    std::deque<Frame> cleaned;
    reader_->set_cleaning(options);
    try {
        for (const Frame& frame : frames_) {
            auto again = reader_->at(frame.media_s);
            if (!again) {
                throw InputError("the video cannot be read again at " + short_text(frame.media_s) +
                                 " s: open it again");
            }
            again->time_s = frame.time_s;
            cleaned.push_back(std::move(*again));
        }
    } catch (...) {
        reader_->set_cleaning(cleaning_);
        throw;
    }
    frames_ = std::move(cleaned);
    ++discontinuity_;  // the surface is another one at once
}

bool Playback::advance(Time now) {
    if (!playing_) return false;
    const double playback_s = clock_.playback_s(now);
    bool changed = false;
    while (frames_.size() > 1 && frames_[1].time_s <= playback_s) {
        frames_.pop_front();
        changed = true;
        if (at_seam()) ++discontinuity_;
    }
    if (complete_ && frames_.size() == 1) {
        playing_ = false;
        anchor(frames_.front().time_s, now);
        changed = true;
    }
    return changed;
}

bool Playback::needs_frame() const {
    return is_open() && !complete_ && frames_.size() < FrameWindow::kFrames;
}

bool Playback::read_ahead() {
    const Frame& newest = frames_.back();
    read_to_s_ = newest.time_s;
    double time_s = 0.0;
    auto next = reader_->after(newest.media_s);
    if (next) {
        time_s = newest.time_s + (next->media_s - newest.media_s);
    } else if (looping_ && newest.media_s > first_media_s_) {
        time_s = newest.time_s + reader_->last_interval_s(newest.media_s);
        next = reader_->at(first_media_s_);
    }
    complete_ = !next;
    if (!next) return false;
    next->time_s = time_s;
    frames_.push_back(std::move(*next));
    if (frames_.size() == 2 && at_seam()) ++discontinuity_;
    return true;
}

bool Playback::at_seam() const {
    return frames_.size() > 1 && frames_[1].media_s <= frames_[0].media_s;
}

void Playback::hold_if_behind(Time now) {
    if (playing_ && clock_.playback_s(now) > read_to_s_) anchor(read_to_s_, now);
}

Playback::Time Playback::next_due() const {
    if (!playing_) return Time::max();
    if (frames_.size() < 2) return clock_.anchor;
    const double wait_s = (frames_[1].time_s - clock_.anchor_s) / clock_.speed;
    return clock_.anchor + std::chrono::ceil<Time::duration>(std::chrono::duration<double>(wait_s));
}

FrameWindow Playback::window() const {
    FrameWindow window;
    window.count = std::min(frames_.size(), FrameWindow::kFrames);
    std::copy_n(frames_.begin(), window.count, window.frames.begin());
    window.clock = clock_;
    window.discontinuity = discontinuity_;
    return window;
}

}  // namespace dibhr
