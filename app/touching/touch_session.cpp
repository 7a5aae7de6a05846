// Touching: poll and publish once a turn of the window; start and stop of the loop.
#include "app/touching/touch_session.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "app/settings/command_options.hpp"
#include "app/touching/force_law.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/surface.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

using std::chrono::steady_clock;

/// The sign stays so long, also after a single tick: else it would flicker.
constexpr std::chrono::milliseconds kCatchingUpTime{300};

std::string text_of(const Standstill& last) {
    const char* const thread = last.thread == Standstill::Thread::window  ? "The window"
                               : last.thread == Standstill::Thread::video ? "Reading the video"
                                                                          : "Writing the recording";
    return std::string(thread) + " stood still for " + number_text(last.seconds, 1) +
           " s: the force was off";
}

}  // namespace

CleaningOptions wanted_cleaning(const Settings& settings, const MediaState& media) {
    if (media.as_recorded) return {.preset = CleaningPreset::raw};
    CleaningOptions cleaning = cleaning_on(media, settings.cleaning);
    const double radius_mm = finger_mm_on(media, settings.finger_mm);
    if (radius_mm > 0.0) cleaning.finger = fingertip_of(radius_mm, settings.touch);
    return cleaning;
}

TouchSession::TouchSession(HandDevice hand, const TouchConnections& connections,
                           const TouchStateRefs& state)
    : connections_(connections),
      state_(state),
      hand_(std::move(hand)),
      player_(connections.on_frames,
              [this](const FrameWindow& window) { felt_frames_.add(window); }),
      strips_(std::make_unique<StripRing>()),
      ticks_(std::make_unique<TickRing>()),
      walked_(std::make_unique<WalkedTickRing>()),
      recording_(*ticks_, connections.crash_note, player_, felt_frames_, state) {
    state_.touch.device = hand_.device->specification();
    state_.touch.haptic.hand = hand_.device->reading_without_surface();
    for (std::size_t k = 0; k < hand_.devices.size(); ++k)
        if (ForceDevice* const device = hand_.devices[k])
            devices_.emplace_back(k, *device, state_.settings, state_.touch);
}

std::vector<std::string> TouchSession::poll(bool window_in_front) {
    TouchState& touch = state_.touch;
    std::vector<std::string> notices;
    touch.in_front = window_in_front;
    state_.media.playback = player_.status();
    if (loop_) touch.haptic = haptic_state_.front();
    follow_others();
    update_catching_up();
    const Standstill& last = touch.haptic.standstill;
    if (last.count > standstills_) notices.push_back(text_of(last));
    standstills_ = last.count;
    for (DeviceClient& device : devices_)
        if (auto notice = device.poll(touch)) notices.push_back(std::move(*notice));
    if (!touch.grants && loop_) touch.grants = loop_->grants();
    if (auto notice = priority_notice()) notices.push_back(std::move(*notice));
    for (TickStrip strip; strips_->pop(strip);) touch.strips.add(strip);
    touch.sound = sound_.state();
    touch.moves_coils = sound_.moves_coils();
    touch.pads = pads_.info();
    return notices;
}

std::vector<DeviceButtonPress> TouchSession::take_presses() {
    std::vector<DeviceButtonPress> presses;
    for (DeviceClient& device : devices_)
        device.take_presses(state_.settings, state_.touch, presses);
    return presses;
}

void TouchSession::follow_others() {
    if (state_.touch.replay) return;
    if (published_.compare_algorithms) {
        others_.follow(*walked_, player_.picture(), published_.bump);
    } else {
        others_.forget(*walked_);
    }
    state_.touch.others = others_.proxies();
}

/// Counts also what happened in the ticks between two pictures.
void TouchSession::update_catching_up() {
    const HapticState& haptic = state_.touch.haptic;
    const auto now = steady_clock::now();
    if (haptic.catching_up() || haptic.bounds_met > bounds_met_)
        catching_up_until_ = now + kCatchingUpTime;
    bounds_met_ = haptic.bounds_met;
    state_.touch.catching_up = now < catching_up_until_;
}

std::optional<std::string> TouchSession::priority_notice() {
    constexpr std::uint64_t kManyTicks = 100;
    const TouchState& touch = state_.touch;
    if (priority_reported_ || !touch.grants || touch.haptic.late_ticks < kManyTicks) return {};
    const Grant priority = touch.grants->priority->get();
    if (priority.granted) return {};
    priority_reported_ = true;
    return std::to_string(touch.haptic.late_ticks) +
           " ticks came late, because other programs run first. Real-time priority: " +
           priority.answer;
}

std::string TouchSession::use_firmware(const std::filesystem::path& file) {
    const auto kinds = force_device_kinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [](const ForceDeviceKind* one) {
        return one->keep_firmware != nullptr;
    });
    if (kind == kinds.end()) return "No device takes firmware";
    const auto device =
        std::find_if(devices_.begin(), devices_.end(),
                     [&](const DeviceClient& one) { return kinds[one.kind()] == *kind; });
    const std::string name = device == devices_.end() ? (*kind)->keep_firmware(file)
                                                      : device->device().use_firmware(file);
    return std::string("Kept for the ") + (*kind)->short_name + ": " + name;
}

void TouchSession::agree_to(std::size_t kind, std::uint64_t offer) {
    for (const DeviceClient& client : devices_)
        if (client.kind() == kind) client.device().agree_to(offer);
}

void TouchSession::publish() {
    publish_to_outputs();
    TouchState& touch = state_.touch;
    if (touch.replay) return;
    const Settings& settings = state_.settings;
    const MediaDescription& media = state_.media;
    stretch(touch.bump, media.depth_columns, media.depth_rows, settings.touch.shape.bump_size_px);
    // Requested values: the loop limits them to what the device it reads can render.
    HapticSettings requested = requested_settings(settings, touch);
    const bool retuned = std::any_of(
        devices_.begin(), devices_.end(),
        [&](const DeviceClient& device) { return device.has_new_tuning(settings, touch); });
    const bool same = published_.version > 0 && same_touch(published_, requested) && !retuned;
    requested.recording = recording_.active();
    requested.compare_algorithms = settings.others;
    if (!same || published_.recording != requested.recording ||
        published_.compare_algorithms != requested.compare_algorithms) {
        const bool recording_ends = published_.recording && !requested.recording;
        requested.version = published_.version + (same ? 0 : 1);
        published_ = requested;
        recording_.record_parameters(published_);
        haptic_settings_.publish(published_);
        // The next tick may have begun before this publish.
        if (recording_ends) recording_ended_at_ = haptic_state_.front().ticks;
    }
    // After the settings: a new tuning moves the goal, and the force must then rise from zero.
    for (DeviceClient& device : devices_)
        if (device.has_new_tuning(settings, touch)) device.publish(settings, touch);
    publish_to_player();
}

/// Publishes to sound and game pads; both are off in a replay.
void TouchSession::publish_to_outputs() {
    const Settings& settings = state_.settings;
    const TouchState& touch = state_.touch;
    const bool to_pads = settings.game_pad && !touch.replay;
    sound_.choose(
        {touch.material.sound, settings.sound_volume},
        {.speaker = !settings.mute && !touch.replay, .coils = to_pads && touch.pads.has_coils()});
    pads_.choose(touch.material.sound, to_pads, sound_.moves_coils());
}

void TouchSession::publish_to_player() {
    const Settings& settings = state_.settings;
    player_.set_motion(motion_request(
        settings.touch.carry, state_.media.as_recorded ? InBetweens::off : settings.in_betweens));
    player_.set_cleaning(wanted_cleaning(settings, state_.media));
}

void TouchSession::start() {
    if (loop_) return;
    publish();
    // Forget the state of the last loop: a new loop counts ticks from 0.
    state_.touch.haptic = {.hand = hand_.device->reading_without_surface()};
    haptic_state_.publish(state_.touch.haptic);
    state_.touch.grants.reset();
    standstills_ = 0;
    recording_ended_at_ = 0;
    loop_ =
        std::make_unique<HapticLoop>(HapticConnections{*hand_.device,
                                                       player_.haptics(),
                                                       haptic_settings_,
                                                       haptic_state_,
                                                       *strips_,
                                                       *ticks_,
                                                       {.window = &connections_.window,
                                                        .video = &player_.heart(),
                                                        .recorder = &recording_.heart(),
                                                        .decoder = &player_.decoder_heartbeat()},
                                                       &connections_.without_force,
                                                       &touch_source_->ticks,
                                                       walked_.get()});
}

std::optional<TickSchedule> TouchSession::stop() noexcept {
    if (!loop_) return {};
    loop_->stop();
    const TickSchedule schedule = loop_->timer().schedule();
    loop_.reset();
    return schedule;
}

void TouchSession::close_device() {
    static_cast<void>(stop());
    hand_.device.reset();
}

void TouchSession::play(std::unique_ptr<Media> media, std::shared_ptr<const TouchMaps> maps) {
    state_.media.describe(media->description());
    media_number_ = recording_.add_media(state_.media);
    player_.play_media(std::move(media), media_number_, std::move(maps));
}

DepthBlend TouchSession::frames_now() {
    const FrameWindow& frames = player_.picture().front();
    return frames.at(frames.clock.playback_s(steady_clock::now()));
}

void TouchSession::point(const Camera::Ray& ray, const DepthBlend& shown, PointerUse use,
                         steady_clock::time_point at) {
    const TouchState& touch = state_.touch;
    if (touch.replay || hand_.mouse == nullptr || !shown.makes_surface()) return;
    use.pressed = use.pressed && by_mouse();
    const SurfaceShape& shape = touch.shape(state_.settings.touch);
    const DepthSurface surface = shown.surface(shape, touch.bump.get());
    MouseTarget target = pointer_.target(ray, surface, use);
    const bool pressed = target.pressed && target.pointing;  // beside the relief nothing is pressed
    if (std::exchange(clicked_, pressed) != pressed) {
        const double after_s =
            std::chrono::duration<double>(at - std::exchange(clicked_at_, at)).count();
        if (hand_.mouse->clicks().push({target.cursor_in_grid, pressed, after_s})) ++clicks_;
    }
    target.clicks = clicks_;
    hand_.mouse->target().publish(target);
}

bool TouchSession::by_mouse() const noexcept {
    return hand_.mouse != nullptr &&
           (!hand_.looks_for_device() || state_.touch.haptic.hand.mouse_fallback);
}

bool TouchSession::may_record() const noexcept {
    return !published_.recording && (!loop_ || state_.touch.haptic.ticks > recording_ended_at_ + 1);
}

}  // namespace dibhr
