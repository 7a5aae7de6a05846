// Compares pictures before they are drawn.
#include "app/viewer/picture_change.hpp"

namespace dibhr {

namespace {

/// Laid out panels settle, blink and fade: what changes again within this time is seen at once.
constexpr std::chrono::milliseconds kLively{300};
/// What changes later, or in another thread, is seen so late at most.
constexpr std::chrono::milliseconds kGlance{250};

/// While the panels may change by themselves; and else. Far below the silence of the window's
/// heartbeat that takes the force off. A hand that begins to move is seen as soon as by a window
/// that is always drawn.
constexpr std::chrono::milliseconds kLivelyPause{16};
constexpr std::chrono::milliseconds kRestingPause{33};

}  // namespace

bool PictureChange::may_differ(const SceneMark& scene, const PanelChanges& panels, Time now) {
    if (panels.input) lively_until_ = now + kLively;
    const bool lively = !panels.video_runs && now < lively_until_;
    return !drawn_ || !(drawn_->scene == scene) || panels.input || panels.in_use || lively ||
           now >= laid_out_ + kGlance;
}

bool PictureChange::take(const PictureMark& next, Time now) {
    laid_out_ = now;
    if (drawn_ == next) return false;
    drawn_ = next;
    lively_until_ = now + kLively;
    return true;
}

std::chrono::milliseconds PictureChange::pause(Time now) const {
    return now < lively_until_ ? kLivelyPause : kRestingPause;
}

}  // namespace dibhr
