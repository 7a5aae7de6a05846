// The window thread's end of the Falcon.
#include "app/viewer_falcon.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "device/falcon/firmware_image.hpp"

namespace dibhr {

namespace {

using falcon::Stage;

/// It touches, or may begin to before the next picture: that can be a slow one, as the first is.
/// One that was lost comes back without a word.
bool may_touch(const ViewerState& state) {
    if (!state.falcon || state.replay) return false;
    const FalconNews& news = *state.falcon;
    return !news.asked || news.was_ready || news.status.stage == Stage::homing ||
           news.status.stage == Stage::ready;
}

/// It did so in the last tick that is known of.
bool touches(const ViewerState& state) {
    return state.falcon && !state.replay && state.falcon->status.stage == Stage::ready &&
           !state.haptic.hand.stand_in;
}

bool needs_its_person(Stage stage) {
    return stage != Stage::looking && stage != Stage::ready;
}

}  // namespace

ViewerFalcon::ViewerFalcon(const HandDevice& hand, ViewerState& state) : device_(hand.falcon) {
    if (device_ == nullptr) return;
    FalconNews& news = state.falcon.emplace();
    news.firmware = hand.firmware;
    news.firmware_trouble = hand.firmware_trouble;
    hand_over(state);
}

std::optional<std::string> ViewerFalcon::take_news(ViewerState& state) {
    if (device_ == nullptr) return {};
    FalconNews& news = *state.falcon;
    news.status = device_->status();
    news.asked = true;
    const Stage before = std::exchange(stage_, news.status.stage);
    if (before == stage_) return {};
    // Once for each need: one that comes again and again must not keep moving the panels.
    if (needs_its_person(stage_) && shown_ != stage_) {
        state.show_device = true;
        shown_ = stage_;
    }
    if (stage_ != Stage::ready) return {};
    shown_ = stage_;
    const std::string again = std::exchange(news.was_ready, true) ? " again" : "";
    return "The Falcon touches" + again;
}

std::vector<Action> ViewerFalcon::take_presses(const ViewerState& state) {
    std::vector<Action> asked;
    if (device_ == nullptr) return asked;
    for (std::size_t k = 0; k < presses_.size(); ++k) {
        const auto action = static_cast<std::size_t>(state.settings.falcon.buttons[k]);
        const ButtonJob& job = button_jobs()[action];
        for (; presses_[k] < state.falcon->status.presses[k]; ++presses_[k]) {
            if (job.perform) asked.push_back(*job.perform);
        }
    }
    return asked;
}

bool ViewerFalcon::tuning_changed(const ViewerState& state) const {
    return device_ != nullptr && !(handed_ == tuning_of(state.settings.falcon, state.centred));
}

void ViewerFalcon::hand_over(const ViewerState& state) {
    if (device_ == nullptr) return;
    handed_ = tuning_of(state.settings.falcon, state.centred);
    device_->tuning().publish(handed_);
}

std::string ViewerFalcon::use_firmware(const std::filesystem::path& file, ViewerState& state) {
    falcon::FirmwareImage image = falcon::keep_firmware(file);
    const std::string kept = "Kept for the Falcon: " + image.name;
    if (device_ == nullptr) return kept;
    state.falcon->firmware = image.name;
    state.falcon->firmware_trouble.clear();
    device_->use_firmware(std::move(image));
    return kept;
}

TouchParameters touch_parameters(const ViewerState& state) {
    TouchParameters parameters = state.settings.touch;
    if (may_touch(state)) {
        parameters.coupling =
            held_coupling(parameters.coupling, state.settings.falcon.workspace.scale, state.device);
    }
    return parameters;
}

SafetyLimits safety_limits(const ViewerState& state) {
    SafetyLimits limits;
    limits.max_force_newton =
        std::min(state.settings.max_force_newton, state.device.max_force_newton);
    // The mouse's hand is as fast at any scale, so that it keeps its limit while it stands in.
    if (touches(state)) limits.max_goal_speed_mm_per_ms *= state.settings.falcon.workspace.scale;
    return limits;
}

bool waits_for_front(const ViewerState& state) {
    return !state.in_front && state.settings.falcon.force_in_front_only && may_touch(state);
}

bool clutched(const ViewerState& state) {
    const unsigned held =
        state.haptic.hand.buttons &
        unsigned{buttons_for(ButtonAction::clutch, state.settings.falcon.buttons)};
    return touches(state) && held != 0;
}

std::string falcon_banner(const ViewerState& state) {
    if (!state.falcon || state.replay) return {};
    if (touches(state) && state.force_enabled && waits_for_front(state)) {
        return "force off: the window is not in front. Click it, and the force rises again";
    }
    const FalconNews& news = *state.falcon;
    const bool lost =
        news.status.stage == Stage::looking && (news.was_ready || news.status.trouble);
    return lost || needs_its_person(news.status.stage) ? news.status.sentence : std::string{};
}

bool named_firmware(const std::filesystem::path& file) {
    // .h: the image as an installed libnifalcon has it.
    const std::string ending = file.extension().string();
    return ending == ".bin" || ending == ".BIN" || ending == ".h";
}

}  // namespace dibhr
