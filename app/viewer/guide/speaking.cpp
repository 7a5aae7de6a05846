// Chooses what is said of what has changed.
#include "app/viewer/guide/speaking.hpp"

#include <array>

namespace dibhr {

std::string news_of(const Spoken& now, const Spoken& before) {
    constexpr std::array kByWeight{&Spoken::message, &Spoken::notice, &Spoken::lead,
                                   &Spoken::focus,   &Spoken::value,  &Spoken::help,
                                   &Spoken::region,  &Spoken::text,   &Spoken::caption};
    for (const auto part : kByWeight) {
        if (now.*part == before.*part || (now.*part).empty()) continue;
        const bool with_value = part == &Spoken::focus && !now.value.empty();
        return with_value ? now.focus + ", " + now.value : now.*part;
    }
    return {};
}

Spoken spoken_of(const ViewerState& state, double now_s) {
    const UiState& ui = state.ui;
    Spoken spoken{.message = ui.message, .region = ui.region.name, .caption = ui.caption};
    if (now_s < ui.notice_until_s && !ui.notice_shows_position) spoken.notice = ui.notice;
    if (!ui.focus.kind.empty()) spoken.focus = ui.focus.label + ", " + ui.focus.kind;
    if (ui.lead) spoken.lead = ui.lead->words;
    spoken.value = ui.focus.value;
    spoken.help = ui.focus.help;
    if (ui.region.rests) spoken.text = ui.region.text;
    return spoken;
}

std::optional<std::string> ViewerSpeaking::follow(Spoken now, double now_s, bool on) {
    constexpr double kRest_s = 1.0;  // the label is said meanwhile
    if (now.focus != last_.focus) focus_since_s_ = now_s;
    if (now_s < focus_since_s_ + kRest_s) now.help.clear();
    if (!on) {
        speaker_.reset();
        last_ = now;
        return std::nullopt;
    }
    if (!speaker_) speaker_ = std::make_unique<Speaker>();
    const std::string news = news_of(now, last_);
    const bool is_help = news == now.help;
    if (!news.empty()) is_help ? speaker_->say_next(news) : speaker_->say(said_ = news);
    last_ = now;
    return speaker_->take_trouble();
}

void ViewerSpeaking::repeat() {
    if (speaker_) speaker_->say(said_);
}

}  // namespace dibhr
