// The window thread's control of the recorder.
#include "app/touching/recording.hpp"

#include <map>
#include <thread>
#include <utility>

#include "app/touching/device_state.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/sources/sidecar.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

constexpr const char* kPlainTag = "mark";
constexpr const char* kParticipant = "participant";
constexpr const char* kNote = "note";
/// Time for the loop to see the recording's end: until then ticks may refer to newer frames.
constexpr std::chrono::milliseconds kLastTicks{100};

/// Full name of the touching device where it has one; else the requested device's name.
std::string device_name(const TouchState& touch) {
    const DeviceInfo* const device = touching_device(touch);
    return device == nullptr || device->state.full_name.empty() ? touch.device.name
                                                                : device->state.full_name;
}

/// Prefix of the names of the device's facts.
std::string prefix_of(const DeviceInfo& device) {
    return std::string(force_device_kinds()[device.kind]->name) + "-";
}

std::string fact_of(double number) {
    return number_text(number);
}

std::string fact_of(bool on) {
    return on ? "on" : "off";
}

std::string fact_of(std::string_view word) {
    return std::string(word);
}

/// The facts of a recording: versions of program and libraries, files, parameters, device.
std::map<std::string, std::string> session_facts(const TouchStateRefs& state) {
    const Settings& settings = state.settings;
    const MediaDescription& media = state.media;
    const DeviceSpecification& device = state.touch.device;
    std::map<std::string, std::string> facts{
        {"program", "dibhr " DIBHR_VERSION},
        {"device", device_name(state.touch)},
        {"device-max-force", number_text(device.limits.max_force_newton)},
        {"device-max-stiffness", number_text(device.limits.max_stiffness_newton_per_mm)},
        {"device-workspace-mm", number_text(device.workspace_mm.x) + " x " +
                                    number_text(device.workspace_mm.y) + " x " +
                                    number_text(device.workspace_mm.z)},
        {"colour", public_name(media.colour_path)},
        {"depth", public_name(media.depth_path)},
        {"depth-columns", std::to_string(media.depth_columns)},
        {"depth-rows", std::to_string(media.depth_rows)},
        {"bump", state.touch.bump_file.string()},
        {"material", state.touch.material.name},
        {"max-force", number_text(settings.max_force_newton)},
        {"stability", settings.stability ? "on" : "off"},
        {"damping-as-needed", settings.damping_as_needed ? "yes" : "no"},
    };
    facts.merge(library_versions());
    visit_touch_entries([&](const auto& entry) {
        facts.emplace(std::string(entry.name), fact_of(entry.of(settings.touch)));
    });
    facts.emplace("cleaning", name_of(cleaning_on(media, settings.cleaning).preset));
    facts.emplace("finger", number_text(finger_mm_on(media, settings.finger_mm)));
    facts.emplace("surface-version", std::to_string(kSurfaceVersion));
    for (const DeviceInfo& one : state.touch.devices) {
        for (const DeviceFacts& known : {one.state.facts, number_facts(settings.devices[one.kind])})
            for (const auto& [name, value] : known) facts.emplace(prefix_of(one) + name, value);
    }
    return facts;
}

/// Finishes the video first: the session stores the hash of its content.
RecorderStatus finish_both(Recorder& recorder, LiveRecorder& live,
                           std::chrono::milliseconds for_sums) {
    live.finish();
    recorder.complete_media(live.contents());
    RecorderStatus recorded = recorder.finish(for_sums);
    if (recorded.failure.empty()) recorded.failure = live.failure();
    return recorded;
}

}  // namespace

std::uint32_t TouchRecording::add_media(const MediaDescription& media) {
    known_media_.push_back({media});
    const auto number = static_cast<std::uint32_t>(known_media_.size());
    if (recorder_) record_media(number, known_media_.back());
    return number;
}

void TouchRecording::record_media(std::uint32_t number, const KnownMedia& known) {
    const MediaDescription& media = known.media;
    recorder_->media(number, media.colour_path, media.depth_path,
                     media.meaning ? toml_of(media.meaning->statement()) : std::string{},
                     known.grows);
}

void TouchRecording::start_live(const std::filesystem::path& file) {
    LiveFiles files = live_files_beside(file);
    MediaDescription kept = state_.media;
    if (kept.colour_path.empty()) files.colour.clear();
    live_ = std::make_shared<LiveRecorder>(files);
    kept.colour_path = files.colour;
    kept.depth_path = files.depth;
    if (kept.meaning) {  // the video is saved after unpacking and decoding
        kept.meaning->packing.value = DepthPacking::separate;
        kept.meaning->code.value = DepthCode::grey;
    }
    known_media_.push_back({std::move(kept), true});
    waiting_ = {file, static_cast<std::uint32_t>(known_media_.size())};
    player_.record_live(waiting_->number,
                        [live = live_](const LiveRecord& record) { live->add(record); });
}

/// From the first saved frame on, every touched frame is in the video.
void TouchRecording::start_at_first_frame() {
    const auto& live = state_.media.playback.live;
    if (!waiting_ || !live || live->media != waiting_->number) return;
    start(std::exchange(waiting_, {})->file);
}

void TouchRecording::start(const std::filesystem::path& file) {
    TickRecord left_behind;  // ticks of a recording that was stopped
    while (ticks_.pop(left_behind)) continue;
    participant_ = state_.touch.session_fields.participant.data();
    note_ = state_.touch.session_fields.note.data();
    std::map<std::string, std::string> facts = session_facts(state_);
    facts.emplace(kParticipant, participant_);
    facts.emplace(kNote, note_);
    const SurfaceRecording how = state_.touch.record_surface;
    recorder_ =
        std::make_unique<Recorder>(file, ticks_, facts, &heart_, std::chrono::steady_clock::now,
                                   RecordedSurface{&felt_frames_, how});
    felt_frames_.keep(how != SurfaceRecording::off, state_.touch.record_preview);
    crash_note_.set_recording(file);
    std::uint32_t number = 0;
    for (const KnownMedia& known : known_media_) record_media(++number, known);
    recorded_maps_.clear();
    for (const VersionOfMaps& known : last_maps_) record_maps(known);
    recorded_version_ = 0;
    recorded_devices_.clear();
    for (const DeviceInfo& one : state_.touch.devices)
        recorded_devices_.push_back({.ages_before = one.state.ages.value_or(PoseAges{})});
    device_.clear();
    start_ = std::chrono::steady_clock::now();
    state_.touch.recording_trouble.clear();
    state_.touch.recording.emplace().file = file;
}

std::string TouchRecording::stop(const std::string& reason) {
    poll();  // records what was typed last
    if (std::exchange(waiting_, {})) {
        live_->discard();
        release_recorder();
        return "Nothing was recorded: no frame came";
    }
    if (!recorder_) return {};
    finishing_file_ = state_.touch.recording->file;
    finishing_s_ = state_.touch.recording->time_s;
    if (!reason.empty())
        print_warning(finishing_file_.string() + ": the recording ends here, as " + reason);
    if (live_) {
        finishing_ = std::async(std::launch::async,
                                [recorder = std::move(recorder_), live = std::move(live_)] {
                                    std::this_thread::sleep_for(kLastTicks);
                                    return finish_both(*recorder, *live, Recorder::kPatience);
                                });
        known_media_.back().grows = false;
        release_recorder();
        state_.touch.recording.reset();
        return "Finishing the recording" + (reason.empty() ? "" : ", as " + reason);
    }
    return report_end(recorder_->finish());
}

/// Updates the state after the end of a recording. Returns the notice about it.
std::string TouchRecording::report_end(const RecorderStatus& recorded) {
    if (!recorded.failure.empty()) {
        abort_recording(recorded.failure);
        return {};
    }
    state_.touch.recorded_file = finishing_file_;
    release_recorder();
    state_.touch.recording.reset();
    state_.touch.session_fields.note = {};  // the note was about this recording
    return "Recorded " + number_text(finishing_s_, 1) + " s into " +
           state_.touch.recorded_file.string();
}

std::optional<std::string> TouchRecording::take_finished() {
    if (!finishing_.valid() ||
        finishing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return report_end(finishing_.get());
}

void TouchRecording::abort_recording(const std::string& failure) {
    state_.touch.recording_trouble = failure;
    // What is felt from here on is in no file. The user must notice that, so the force goes off.
    state_.touch.force_enabled = false;
    trouble_ = failure;
    if (failure_.empty()) failure_ = failure;
    release_recorder();
    state_.touch.recording.reset();
}

void TouchRecording::record_parameters(const HapticSettings& settings) {
    if (!recorder_ || recorded_version_ == settings.version) return;
    recorded_version_ = settings.version;
    recorder_->parameters(
        {.version = settings.version,
         .touch = settings.parameters,
         .limits = settings.limits,
         .force_enabled = settings.force_enabled,
         .bump = {settings.bump ? state_.touch.bump_file : std::filesystem::path{}}},
        settings.bump);
}

void TouchRecording::maps(std::uint32_t version, std::vector<SessionMap> maps) {
    if (!last_maps_.empty() && last_maps_.back().version != version) {
        last_maps_.erase(last_maps_.begin(), last_maps_.end() - 1);
    } else {
        last_maps_.clear();
    }
    last_maps_.push_back({version, std::move(maps)});
    if (recorder_) record_maps(last_maps_.back());
}

void TouchRecording::record_maps(const VersionOfMaps& known) {
    if (!known.maps.empty() && recorded_maps_.insert(known.version).second)
        recorder_->maps(known.version, known.maps);
}

std::string TouchRecording::mark(const KeyTable& keys,
                                 std::chrono::steady_clock::time_point moment) {
    if (!recorder_)
        return "Nothing is recorded that could be marked" +
               keys.key_hint(Action::record, " begins");
    const char* typed = state_.touch.session_fields.tag.data();
    const std::string tag = *typed == '\0' ? kPlainTag : typed;
    recorder_->mark(tag, {}, moment);
    const std::chrono::duration<double> ago = std::chrono::steady_clock::now() - moment;
    const double t_s = std::max(0.0, now_s() - ago.count());
    state_.touch.recording->marks.push_back({t_s, tag, {}});
    return "Marked at " + clock_text(t_s) + ": " + tag;
}

void TouchRecording::mark(const std::string& tag) {
    if (recorder_) recorder_->mark(tag);
}

void TouchRecording::poll() {
    start_at_first_frame();
    if (!recorder_) return;
    const auto record_changed = [this](const char* key, const TextField& field,
                                       std::string& recorded) {
        if (recorded == field.data()) return;
        recorded = field.data();
        recorder_->set_fact(key, recorded);
    };
    const TouchState& touch = state_.touch;
    record_changed(kParticipant, touch.session_fields.participant, participant_);
    record_changed(kNote, touch.session_fields.note, note_);
    // The device that touched last need not be the requested one.
    if (const std::string device = device_name(touch);
        device != device_ && device != touch.device.name) {
        device_ = device;
        recorder_->set_fact("device", device);
    }
    record_devices();
    RecordingInfo& info = *state_.touch.recording;
    info.status = recorder_->status();
    info.time_s = now_s();
    std::string failure = info.status.failure;
    if (const std::string of_video = live_ ? live_->failure() : std::string{}; !of_video.empty())
        failure = "Recording the live video stopped: " + of_video;
    if (!failure.empty()) abort_recording(failure);
}

/// Facts of devices found meanwhile, and the ages of the poses that the recorded ticks used.
void TouchRecording::record_devices() {
    for (std::size_t k = 0; k < recorded_devices_.size(); ++k) {
        const DeviceInfo& one = state_.touch.devices[k];
        const DeviceState& state = one.state;
        RecordedDevice& recorded = recorded_devices_[k];
        if (!state.id.empty() && state.id != recorded.id) {
            recorded.id = state.id;
            for (const auto& [name, value] : state.facts)
                recorder_->set_fact(prefix_of(one) + name, value);
        }
        if (!state.ages) continue;
        const PoseAges ages = state.ages->since(recorded.ages_before);
        if (ages.count() == 0 || ages.count() == recorded.ages_recorded) continue;
        recorded.ages_recorded = ages.count();
        for (const auto& [name, part] : {std::pair{"half", 0.5}, {"most", 0.99}, {"worst", 1.0}}) {
            recorder_->set_fact(prefix_of(one) + "pose-age-" + name + "-ms",
                                number_text(ages.quantile_ms(part), 2));
        }
    }
}

void TouchRecording::release_recorder() {
    if (live_) player_.record_live(0, {});
    live_.reset();
    recorder_.reset();
    if (!finishing_.valid()) felt_frames_.keep(false);
    crash_note_.set_recording({});
}

void TouchRecording::finish(std::chrono::milliseconds for_sums) {
    std::string last;
    if (waiting_) {
        live_->discard();
        last = waiting_->file.string() +
               ": nothing was recorded, because no frame came: check whether the sender runs";
    }
    if (live_ && recorder_) last = finish_both(*recorder_, *live_, for_sums).failure;
    if (!live_ && recorder_) last = recorder_->finish(for_sums).failure;
    if (last.empty() && finishing_.valid()) last = finishing_.get().failure;
    if (failure_.empty()) failure_ = last;
    if (!failure_.empty()) throw InputError(failure_);
}

double TouchRecording::now_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace dibhr
