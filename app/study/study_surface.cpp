// Wears a condition's values, plays its media, and records.
#include "app/study/study_surface.hpp"

#include <utility>

#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/material.hpp"
#include "app/settings/study_values.hpp"
#include "app/touching/force_law.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/cleaning/fingertip.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

const std::string& word_of(const TouchValues& values, const char* name) {
    static const std::string none;
    const auto found = values.words.find(name);
    return found == values.words.end() ? none : found->second;
}

/// All buttons of the grip are answers, but those that take the force off: these stay.
void free_buttons(ButtonActions& buttons) {
    for (ButtonAction& action : buttons)
        if (action != ButtonAction::force_off) action = ButtonAction::none;
}

}  // namespace

StudySurface::StudySurface(HandDevice hand, const Settings& settings, const StudyTies& ties)
    : ties_(ties),
      own_(settings),
      hand_(std::move(hand)),
      state_{.settings = settings,
             .keys = KeyTable(settings.keys),
             .touch = {.force_enabled = false}},
      falcon_(hand_, state_),
      inverse3_(hand_, state_),
      strips_(std::make_unique<StripRing>()),
      ticks_(std::make_unique<TickRing>()),
      recording_(*ticks_, ties.words, player_) {
    free_buttons(own_.falcon.buttons);
    free_buttons(own_.inverse3.buttons);
    state_.settings = own_;
    state_.touch.device = hand_.device->specification();
    state_.touch.haptic.hand = hand_.device->unread();
}

void StudySurface::begin_trial(const std::filesystem::path& session) {
    session_ = session;
}

void StudySurface::wear(const TouchValues& values) {
    const TouchRequest request = request_of(values);
    Settings& settings = state_.settings = own_;
    settings.touch = {};
    settings.fit_relief = settings.fit_pitch = false;
    take_protections(values, settings);
    settings.cleaning = {.preset = request.preset.value_or(CleaningPreset::automatic)};
    settings.finger_mm = request.finger_mm.value_or(0.0);
    settings.in_betweens = request.in_betweens.value_or(InBetweens::automatic);
    request.given.apply(settings.touch);
    state_.touch.material = request.given.material.value_or(Material{});
    settings.material = state_.touch.material.name;
    state_.touch.bump_file = request.given.bump_file();
    state_.touch.bump = request.given.read_bumps();
}

void StudySurface::open(const Protocol& protocol, const std::string& media) {
    SampleFiles files = sample_files();
    for (const StudyMedia& one : protocol.media)
        if (one.name == media && media != kSampleMedia) files = {one.colour, one.depth};
    std::unique_ptr<Media> opened = open_media(files.colour, files.depth, usual_depth_request());
    state_.media.describe(opened->description());
    number_ = recording_.opened(state_.media);
    player_.play_media(std::move(opened), number_);
    media_ = media;
}

void StudySurface::show(const Protocol& protocol, const StudyInterval& interval) {
    rest();
    wear(interval.values);
    const std::string& media = word_of(interval.values, "media");
    const std::string name = media.empty() ? kSampleMedia : media;
    if (name != media_) {
        open(protocol, name);
    } else {
        player_.seek(0.0);
        player_.play();
    }
    if (!loop_) start_loop();
}

/// What a recording says of itself needs the media; and the loop must have seen the last one's end.
void StudySurface::record_if_possible() {
    const bool seen = !handed_.recording && state_.touch.haptic.ticks > handed_at_ + 1;
    if (!session_.empty() && loop_ && seen) recording_.start(std::exchange(session_, {}), state_);
}

bool StudySurface::is_there() const {
    return session_.empty() && shown_.makes_surface() && shown_.nearest().media == number_;
}

void StudySurface::begin_interval(int number) {
    recording_.mark("interval " + std::to_string(number));
    state_.touch.force_enabled = true;
}

void StudySurface::rest() {
    rests_ = rests_ || state_.touch.force_enabled;
    state_.touch.force_enabled = false;
}

void StudySurface::turn(const std::string& parameter, double value) {
    TouchParameters& touch = state_.settings.touch;
    if (parameter == "friction")
        touch.friction = {value, value};
    else if (parameter == "finger")
        state_.settings.finger_mm = value;
    else if (const TouchNumber* const number = touch_number(parameter))
        number->in(touch) = value;
    keep_in_range(touch);
}

void StudySurface::end_trial() {
    rest();
    hand_over();  // while it is recorded
    static_cast<void>(recording_.stop(state_));
    if (!state_.touch.recording_trouble.empty()) throw InputError(state_.touch.recording_trouble);
}

void StudySurface::take_news(bool window_in_front) {
    state_.touch.in_front = window_in_front;
    state_.media.playback = player_.status();
    if (loop_) state_.touch.haptic = haptic_state_.front();
    static_cast<void>(falcon_.take_news(state_));
    static_cast<void>(inverse3_.take_news(state_));
    if (!state_.touch.grants && loop_) state_.touch.grants = loop_->grants();
    record_if_possible();
    recording_.take_news(state_);
    if (!state_.touch.recording_trouble.empty()) throw InputError(state_.touch.recording_trouble);
    if (!state_.media.playback.failure.empty()) throw InputError(state_.media.playback.failure);
    for (TickStrip strip; strips_->pop(strip);) continue;
    const FrameWindow& frames = player_.picture().front();
    shown_ = frames.at(frames.clock.playback_s(std::chrono::steady_clock::now()));
}

void StudySurface::hand_over() {
    sound_.choose({state_.touch.material.sound, state_.settings.sound_volume},
                  {.speaker = !state_.settings.mute, .coils = false});
    stretch(state_.touch.bump, state_.media.depth_columns, state_.media.depth_rows,
            state_.settings.touch.shape.bump_size_px);
    HapticSettings asked = asked_settings(state_.settings, state_.touch);
    const bool same = handed_.version > 0 && same_touch(handed_, asked) &&
                      !falcon_.tuning_changed(state_) && !inverse3_.tuning_changed(state_);
    asked.recording = recording_.active();
    if (!same || handed_.recording != asked.recording) {
        asked.version = handed_.version + (same ? 0 : 1);
        handed_ = asked;
        handed_at_ = state_.touch.haptic.ticks;
        recording_.hand_over(handed_, state_.touch.bump_file);
        haptic_settings_.publish(handed_);
    }
    // The next tick has no force.
    if (std::exchange(rests_, false)) recording_.mark("rest");
    if (falcon_.tuning_changed(state_)) falcon_.hand_over(state_);
    if (inverse3_.tuning_changed(state_)) inverse3_.hand_over(state_);
    player_.set_motion(motion_wanted(state_.settings.touch.carry, state_.settings.in_betweens));
    CleaningOptions cleaning = cleaning_on(state_.media, state_.settings.cleaning);
    const double radius_mm = finger_mm_on(state_.media, state_.settings.finger_mm);
    if (radius_mm > 0.0) cleaning.finger = fingertip_of(radius_mm, state_.settings.touch);
    player_.set_cleaning(cleaning);
}

std::vector<StudySurface::ButtonPress> StudySurface::take_presses() {
    std::vector<ButtonPress> pressed;
    const auto take = [&](const auto& status, const ButtonActions& actions, Grip of) {
        const ButtonPresses& now = status.presses;
        ButtonPresses& taken = pressed_[static_cast<std::size_t>(of)];
        for (std::size_t k = 0; k < now.size(); ++k) {
            if (now[k] == taken[k]) continue;
            if (actions[k] == ButtonAction::force_off)
                rest();
            else
                pressed.push_back({static_cast<int>(k), status.pressed_at[k]});
        }
        taken = now;
    };
    if (state_.touch.falcon) take(state_.touch.falcon->status, own_.falcon.buttons, Grip::falcon);
    if (state_.touch.inverse3) take(state_.touch.inverse3->status, own_.inverse3.buttons, Grip::inverse3);
    return pressed;
}

void StudySurface::point(const Camera::Ray& ray, const PointerUse& use) {
    if (hand_.mouse == nullptr || !shown_.makes_surface()) return;
    const DepthSurface surface = shown_.surface(state_.shape(), state_.touch.bump.get());
    hand_.mouse->target().publish(pointer_.target(ray, surface, use));
}

bool StudySurface::by_mouse() const noexcept {
    return hand_.mouse != nullptr && (!hand_.looks_for_device() || state_.touch.haptic.hand.stand_in);
}

void StudySurface::stop() noexcept {
    if (loop_) loop_->stop();
}

void StudySurface::start_loop() {
    hand_over();
    haptic_state_.publish(HapticState{.hand = hand_.device->unread()});
    loop_ = std::make_unique<HapticLoop>(HapticConnections{*hand_.device,
                                                           player_.haptics(),
                                                           haptic_settings_,
                                                           haptic_state_,
                                                           *strips_,
                                                           *ticks_,
                                                           {.window = &ties_.window,
                                                            .video = &player_.heart(),
                                                            .recorder = &recording_.heart(),
                                                            .decoder = &player_.decoder_heart()},
                                                           &ties_.without_force,
                                                           &touch_source_->ticks,
                                                           nullptr});
}

}  // namespace dibhr
