// Compares pictures before they are drawn.
#include "app/viewer/picture_change.hpp"

namespace dibhr {

namespace {

/// After a change panels may change by themselves, as a tooltip that fades in: so long they are
/// laid out in each turn.
constexpr std::chrono::milliseconds kPanelsSettle{300};
/// Later they are laid out so often.
constexpr std::chrono::milliseconds kPanelInterval{250};
/// How long a hand that moves may wait for the next frame of a video.
constexpr std::chrono::milliseconds kLongestHandWait{100};

/// Times between turns: while panels may change by themselves, with a device's hand, which may
/// begin to move, and else. All are far below the time after which a silent window takes the force
/// off.
constexpr std::chrono::milliseconds kSettlingPause{16};
constexpr std::chrono::milliseconds kDevicePause{33};
constexpr std::chrono::milliseconds kRestingPause{100};

}  // namespace

SceneMark PictureChange::with_drawn_hand(SceneMark scene, Time now) const {
    if (!drawn_ || now >= drawn_at_ + kLongestHandWait) return scene;
    scene.colour = drawn_->scene.colour;
    scene.markers = drawn_->scene.markers;
    scene.dent = drawn_->scene.dent;
    return scene;
}

bool PictureChange::waits(double most_per_s, const PanelChanges& panels, Time now) const {
    const bool used = panels.input || panels.in_use || now < input_until_;
    if (!drawn_ || used || !(most_per_s > 0.0)) return false;
    return std::chrono::duration<double>(now - drawn_at_).count() * most_per_s < 1.0;
}

bool PictureChange::may_differ(const SceneMark& scene, const PanelChanges& panels, Time now) {
    if (panels.input) input_until_ = settling_until_ = now + kPanelsSettle;
    const bool settling = now < input_until_ || (!panels.video_runs && now < settling_until_);
    return !drawn_ || !(drawn_->scene == scene) || panels.input || panels.in_use || settling ||
           now >= laid_out_ + kPanelInterval;
}

bool PictureChange::take(const PictureMark& next, Time now) {
    laid_out_ = now;
    if (drawn_ == next) return false;
    drawn_ = next;
    drawn_at_ = now;
    settling_until_ = now + kPanelsSettle;
    return true;
}

std::chrono::milliseconds PictureChange::pause(bool by_device, Time now) const {
    if (now < settling_until_) return kSettlingPause;
    return by_device ? kDevicePause : kRestingPause;
}

}  // namespace dibhr
