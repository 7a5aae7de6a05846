// Compares pictures before they are drawn.
#include "app/viewer/picture_change.hpp"

namespace dibhr {

namespace {

/// Laid out panels settle, blink and fade: what changes again within this time is seen at once.
constexpr std::chrono::milliseconds kLively{300};
/// What changes later, or in another thread, is seen so late at most.
constexpr std::chrono::milliseconds kGlance{250};
/// How long a hand that moves may wait for the next frame of a video.
constexpr std::chrono::milliseconds kHandWaits{100};

/// While the panels may change by themselves; so that a device's hand that begins to move is seen
/// as soon as in a window that is always drawn; and else. Each is far below the silence of the
/// window's heartbeat that takes the force off.
constexpr std::chrono::milliseconds kLivelyPause{16};
constexpr std::chrono::milliseconds kDevicePause{33};
constexpr std::chrono::milliseconds kRestingPause{50};

}  // namespace

SceneMark PictureChange::with_drawn_hand(SceneMark scene, Time now) const {
    if (!drawn_ || now >= drawn_at_ + kHandWaits) return scene;
    scene.colour = drawn_->scene.colour;
    scene.markers = drawn_->scene.markers;
    scene.dent = drawn_->scene.dent;
    return scene;
}

bool PictureChange::may_differ(const SceneMark& scene, const PanelChanges& panels, Time now) {
    if (panels.input) input_until_ = lively_until_ = now + kLively;
    const bool lively = now < input_until_ || (!panels.video_runs && now < lively_until_);
    return !drawn_ || !(drawn_->scene == scene) || panels.input || panels.in_use || lively ||
           now >= laid_out_ + kGlance;
}

bool PictureChange::take(const PictureMark& next, Time now) {
    laid_out_ = now;
    if (drawn_ == next) return false;
    drawn_ = next;
    drawn_at_ = now;
    lively_until_ = now + kLively;
    return true;
}

std::chrono::milliseconds PictureChange::pause(bool by_device, Time now) const {
    if (now < lively_until_) return kLivelyPause;
    return by_device ? kDevicePause : kRestingPause;
}

}  // namespace dibhr
