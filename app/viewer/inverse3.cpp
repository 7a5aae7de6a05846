// The window thread's end of the Inverse3.
#include "app/viewer/inverse3.hpp"

#include <utility>

namespace dibhr {

namespace {

inverse3::Tuning tuning_in(const ViewerState& state) {
    const Settings& settings = state.settings;
    return tuning_of(settings.inverse3, settings.max_force_newton, state.touch.centred);
}

}  // namespace

ViewerInverse3::ViewerInverse3(const HandDevice& hand, ViewerState& state)
    : device_(hand.find<inverse3::Inverse3Device>()) {
    if (device_ == nullptr) return;
    state.touch.inverse3.emplace();
    hand_over(state);
}

std::optional<std::string> ViewerInverse3::take_news(ViewerState& state) {
    if (device_ == nullptr) return {};
    Inverse3News& news = *state.touch.inverse3;
    news.status = device_->status();
    news.asked = true;
    take_ages(news);
    return stages_.take(news.status.stage, "Inverse3", news.was_ready, state);
}

void ViewerInverse3::take_ages(Inverse3News& news) {
    news.ages = device_->pose_ages();
    const auto now = std::chrono::steady_clock::now();
    if (now - second_begin_ < std::chrono::seconds(1)) return;
    second_begin_ = now;
    news.recent_ages = news.ages.since(told_ages_);
    told_ages_ = news.ages;
}

std::vector<Action> ViewerInverse3::take_presses(const ViewerState& state) {
    if (device_ == nullptr) return {};
    return presses_.take(state.touch.inverse3->status.presses, state.settings.inverse3.buttons);
}

bool ViewerInverse3::tuning_changed(const ViewerState& state) const {
    return device_ != nullptr && !(handed_ == tuning_in(state));
}

void ViewerInverse3::hand_over(const ViewerState& state) {
    if (device_ == nullptr) return;
    handed_ = tuning_in(state);
    device_->tuning().publish(handed_);
}

void ServiceSettings::follow(ViewerState& state) {
    constexpr int kMostTries = 3;
    constexpr std::chrono::seconds kBetween{3};
    if (!state.touch.inverse3) return;
    Inverse3News& news = *state.touch.inverse3;
    if (auto kept = asking_.take()) news.kept = std::move(*kept);
    if (asking_.under_way()) return;
    if (news.status.id != device_) {
        device_ = news.status.id;
        news.kept.clear();
        tries_ = 0;
        asked_ = {};
    }
    const auto now = std::chrono::steady_clock::now();
    if (device_.empty() || !news.kept.empty() || tries_ == kMostTries || now < asked_ + kBetween)
        return;
    ++tries_;
    asked_ = now;
    asking_.start([connection = connection_of(state.settings.inverse3), device = device_] {
        return ask_kept_settings(connection, device);
    });
}

}  // namespace dibhr
