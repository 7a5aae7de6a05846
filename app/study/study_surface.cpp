// Applies a condition's values, plays its media, and records.
#include "app/study/study_surface.hpp"

#include <cstddef>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/material.hpp"
#include "app/settings/study_values.hpp"
#include "core/error.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

const std::string& word_of(const TouchValues& values, const char* name) {
    static const std::string none;
    const auto found = values.words.find(name);
    return found == values.words.end() ? none : found->second;
}

/// All device buttons are answers, except those for *force off*.
void free_buttons(ButtonActions& buttons) {
    for (ButtonAction& action : buttons)
        if (action != ButtonAction::force_off) action = ButtonAction::none;
}

/// The user's settings without button actions, game pads and other algorithms.
Settings usable_in_study(Settings settings) {
    for (std::size_t k = 0; k < settings.devices.size(); ++k)
        free_buttons(settings.devices[k].buttons);
    settings.game_pad = false;
    settings.others = false;
    return settings;
}

}  // namespace

StudySurface::StudySurface(HandDevice hand, const Settings& settings,
                           const TouchConnections& connections)
    : own_(usable_in_study(settings)),
      settings_(own_),
      session_(std::move(hand), connections, {settings_, touch_, media_}) {}

void StudySurface::begin_trial(const std::filesystem::path& file) {
    trial_file_ = file;
}

void StudySurface::apply_values(const TouchValues& values) {
    const TouchRequest request = request_of(values);
    Settings& settings = settings_ = own_;
    settings.touch = {};
    settings.fit_relief = settings.fit_pitch = false;
    apply_protections(values, settings);
    settings.cleaning = {.preset = request.preset.value_or(CleaningPreset::automatic)};
    settings.finger_mm = request.finger_mm.value_or(0.0);
    settings.in_betweens = request.in_betweens.value_or(InBetweens::automatic);
    request.given.apply(settings.touch);
    touch_.material = request.given.material.value_or(Material{});
    settings.material = touch_.material.name;
    touch_.bump_file = request.given.bump_file();
    touch_.bump = request.given.read_bumps();
}

void StudySurface::open(const Protocol& protocol, const std::string& media) {
    SampleFiles files = sample_files();
    for (const StudyMedia& one : protocol.media)
        if (one.name == media && media != kSampleMedia) files = {one.colour, one.depth};
    session_.play(open_media(files.colour, files.depth, usual_depth_request()));
    media_name_ = media;
}

void StudySurface::show(const Protocol& protocol, const StudyInterval& interval) {
    take_force_off();
    apply_values(interval.values);
    const std::string& media = word_of(interval.values, "media");
    const std::string name = media.empty() ? kSampleMedia : media;
    if (name != media_name_) {
        open(protocol, name);
    } else {
        session_.player().seek(0.0);
        session_.player().play();
    }
    session_.start();
}

/// Starts the trial's recording, once the loop allows it; its facts need the open media.
void StudySurface::record_if_possible() {
    if (!trial_file_.empty() && session_.runs() && session_.may_record())
        session_.recording().start(std::exchange(trial_file_, {}));
}

bool StudySurface::is_ready() const {
    return trial_file_.empty() && shown_.makes_surface() &&
           shown_.nearest().media == session_.media_number() && !session_.player().status().preview;
}

void StudySurface::begin_interval(int number) {
    session_.recording().mark("interval " + std::to_string(number));
    touch_.force_enabled = true;
}

void StudySurface::take_force_off() {
    rest_mark_due_ = rest_mark_due_ || touch_.force_enabled;
    touch_.force_enabled = false;
}

void StudySurface::turn(const std::string& parameter, double value) {
    TouchParameters& touch = settings_.touch;
    if (parameter == "friction")
        touch.friction = {value, value};
    else if (parameter == "finger")
        settings_.finger_mm = value;
    else if (const TouchNumber* const number = touch_number(parameter))
        number->in(touch) = value;
    keep_in_range(touch);
}

void StudySurface::end_trial() {
    take_force_off();
    publish();  // while still recording
    static_cast<void>(session_.recording().stop());
    if (!touch_.recording_trouble.empty()) throw InputError(touch_.recording_trouble);
}

void StudySurface::poll(bool window_in_front) {
    static_cast<void>(session_.poll(window_in_front));
    record_if_possible();
    session_.recording().poll();
    if (!touch_.recording_trouble.empty()) throw InputError(touch_.recording_trouble);
    if (!media_.playback.failure.empty()) throw InputError(media_.playback.failure);
    shown_ = session_.frames_now();
}

void StudySurface::publish() {
    session_.publish();
    if (std::exchange(rest_mark_due_, false)) session_.recording().mark("rest");
}

std::vector<DeviceButtonPress> StudySurface::take_presses() {
    std::vector<DeviceButtonPress> presses = session_.take_presses();
    const auto takes_force_off = [](const DeviceButtonPress& press) {
        return press.action == ButtonAction::force_off;
    };
    if (std::erase_if(presses, takes_force_off) > 0) take_force_off();
    return presses;
}

}  // namespace dibhr
