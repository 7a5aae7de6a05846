// The window thread's control of a clip.
#include "app/viewer/clip.hpp"

#include <exception>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// For 30 pictures a second; a little less than 1/30 s, as a window's pictures come unevenly.
constexpr auto kLeastBetweenPictures = std::chrono::milliseconds(29);

/// Copying an hour's clip takes some seconds; a disk that hangs takes for ever.
constexpr std::chrono::seconds kPatience{60};
constexpr std::chrono::seconds kPatienceAtOnce{5};

double seconds_between(ViewerClip::Clock::time_point begin, ViewerClip::Clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

ViewerClip::~ViewerClip() {
    try {
        finish(ClipEnd::at_once);
    } catch (const std::exception&) {  // the error that ends the program is reported, not this one
        recorder_.reset();
    }
}

void ViewerClip::start(const std::filesystem::path& file, ClipNameConflict name, PictureOf of) {
    recorder_ = std::make_unique<ClipRecorder>(file, name);
    file_ = file;
    name_ = name;
    of_ = of;
    begin_.reset();
    end_.reset();
}

void ViewerClip::stop() {
    if (!recorder_ || end_) return;
    end_ = Clock::now();
    recorder_->stop(*end_, ClipEnd::indexed);
}

bool ViewerClip::wants(PictureOf of, Clock::time_point now) const {
    return recorder_ && of == of_ && (!begin_ || now - last_ >= kLeastBetweenPictures) &&
           recorder_->wants_picture();
}

void ViewerClip::add(ColourImage picture, Clock::time_point now) {
    if (!begin_) begin_ = now;
    last_ = now;
    recorder_->add(std::move(picture), now);
}

std::optional<std::string> ViewerClip::poll(ViewerState& state) {
    state.ui.clip.reset();
    if (!recorder_) return {};
    const Clock::time_point now = end_.value_or(Clock::now());
    const double length_s = begin_ ? seconds_between(*begin_, now) : 0.0;
    if (!recorder_->done()) {
        state.ui.clip = ClipInfo{file_, length_s, end_.has_value()};
        set_crash_note();
        return {};
    }
    clear_crash_note();
    const std::unique_ptr<ClipRecorder> over = std::move(recorder_);
    try {
        return "Saved " + over->result().string() + ", " + clock_text(length_s);
    } catch (const InputError& error) {
        if (failure_.empty()) failure_ = error.what();
        throw;
    }
}

void ViewerClip::set_crash_note() {
    if (in_crash_note_ || !recorder_->plays()) return;
    crash_note_.set_clip(recorder_->written(), file_, name_ == ClipNameConflict::replaces);
    in_crash_note_ = true;
}

void ViewerClip::clear_crash_note() {
    if (std::exchange(in_crash_note_, false)) crash_note_.set_clip({}, {}, false);
}

void ViewerClip::wait_for(std::unique_ptr<ClipRecorder> over, ClipEnd how) {
    const std::chrono::seconds patience = how == ClipEnd::indexed ? kPatience : kPatienceAtOnce;
    if (over->done_within(patience)) {
        static_cast<void>(over->result());
        return;
    }
    static_cast<void>(over.release());  // its thread cannot be ended and still uses it
    tasks_.abandon_one();
    throw InputError(file_.string() + ": the clip is not finished after " +
                     std::to_string(patience.count()) +
                     " s; what was written so far is beside it and ends in .part: check whether "
                     "the disk still works");
}

void ViewerClip::finish(ClipEnd how) {
    if (recorder_) {
        recorder_->stop(Clock::now(), how);
        wait_for(std::move(recorder_), how);
        clear_crash_note();
    }
    if (!failure_.empty()) throw InputError(failure_);
}

}  // namespace dibhr
