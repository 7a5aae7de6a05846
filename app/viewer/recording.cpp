// The window thread's end of the recorder.
#include "app/viewer/recording.hpp"

#include <map>
#include <thread>
#include <utility>

#include "app/panels/widgets.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "core/video/depth/sidecar.hpp"
#include "core/video/libraries.hpp"
#include "core/video/live/live_name.hpp"
#include "device/device_or_mouse.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/force_devices.hpp"
#include "device/inverse3/inverse3_device.hpp"

namespace dibhr {

namespace {

constexpr const char* kPlainTag = "mark";
constexpr const char* kParticipant = "participant";
constexpr const char* kNote = "note";
/// For the loop to see that it is over: until then ticks may touch what comes.
constexpr std::chrono::milliseconds kLastTicks{100};

/// The one that was asked for; an Inverse3 that touches, by its name.
std::string device_name(const ViewerState& state) {
    const bool inverse3_touches =
        state.touch.inverse3 && state.touch.haptic.hand.which == static_cast<std::uint8_t>(Touching::inverse3);
    return inverse3_touches ? "Haply " + name_of(state.touch.inverse3->status) : state.touch.device.name;
}

/// What is known of a device, and its numbers, under its own name.
template <typename OwnSettings>
void add_facts(std::map<std::string, std::string>& facts, const std::string& device,
               const DeviceState& state, OwnSettings settings) {
    for (const auto& [name, value] : state.facts) facts.emplace(device + "-" + name, value);
    for (const auto& [name, value] : number_facts(settings))
        facts.emplace(device + "-" + name, value);
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

/// What is kept with a recording: versions of program and libraries, files, parameters, device.
std::map<std::string, std::string> session_facts(const ViewerState& state) {
    std::map<std::string, std::string> facts{
        {"program", "dibhr " DIBHR_VERSION},
        {"device", device_name(state)},
        {"device-max-force", number_text(state.touch.device.limits.max_force_newton)},
        {"device-max-stiffness", number_text(state.touch.device.limits.max_stiffness_newton_per_mm)},
        {"device-workspace-mm", number_text(state.touch.device.workspace_mm.x) + " x " +
                                    number_text(state.touch.device.workspace_mm.y) + " x " +
                                    number_text(state.touch.device.workspace_mm.z)},
        {"colour", public_name(state.media.colour_path)},
        {"depth", public_name(state.media.depth_path)},
        {"depth-columns", std::to_string(state.media.depth_columns)},
        {"depth-rows", std::to_string(state.media.depth_rows)},
        {"bump", state.touch.bump_file.string()},
        {"material", state.touch.material.name},
        {"max-force", number_text(state.settings.max_force_newton)},
        {"stability", state.settings.stability ? "on" : "off"},
        {"damping-as-needed", state.settings.damping_as_needed ? "yes" : "no"},
    };
    facts.merge(library_versions());
    visit_touch_entries([&](const auto& entry) {
        facts.emplace(std::string(entry.name), fact_of(entry.of(state.settings.touch)));
    });
    facts.emplace("cleaning", name_of(cleaning_on(state.media, state.settings.cleaning).preset));
    facts.emplace("finger", number_text(finger_mm_on(state.media, state.settings.finger_mm)));
    facts.emplace("surface-version", std::to_string(kSurfaceVersion));
    if (state.touch.falcon)
        add_facts(facts, "falcon", state_of(state.touch.falcon->status), state.settings.falcon);
    if (state.touch.inverse3)
        add_facts(facts, "inverse3", state_of(state.touch.inverse3->status), state.settings.inverse3);
    return facts;
}

/// The video first, whose content the session keeps.
RecorderStatus finish_both(Recorder& recorder, LiveRecorder& live,
                           std::chrono::milliseconds for_sums) {
    live.finish();
    std::vector<SessionMedia> contents;
    for (const FileContent& content : live.contents())
        contents.push_back({content.file, content.bytes, content.sha256, content.head_bytes});
    recorder.media_is_whole(std::move(contents));
    RecorderStatus recorded = recorder.finish(for_sums);
    if (recorded.failure.empty()) recorded.failure = live.failure();
    return recorded;
}

}  // namespace

std::uint32_t ViewerRecording::opened(const MediaDescription& media) {
    opened_.push_back({media});
    const auto number = static_cast<std::uint32_t>(opened_.size());
    if (recorder_) tell_media(number, opened_.back());
    return number;
}

void ViewerRecording::tell_media(std::uint32_t number, const Opened& opened) {
    const MediaDescription& media = opened.media;
    recorder_->media(number, media.colour_path, media.depth_path,
                     media.meaning ? toml_of(media.meaning->statement()) : std::string{},
                     opened.grows);
}

void ViewerRecording::start_live(const std::filesystem::path& file, ViewerState& state) {
    LiveFiles files = live_files_beside(file);
    MediaDescription kept = state.media;
    if (kept.colour_path.empty()) files.colour.clear();
    live_ = std::make_shared<LiveRecorder>(files);
    kept.colour_path = files.colour;
    kept.depth_path = files.depth;
    if (kept.meaning) {  // halves and hues are told apart before they are kept
        kept.meaning->packing.value = DepthPacking::separate;
        kept.meaning->code.value = DepthCode::grey;
    }
    opened_.push_back({std::move(kept), true});
    waiting_ = {file, static_cast<std::uint32_t>(opened_.size())};
    player_.record_live(waiting_->number,
                        [live = live_](const LiveRecord& record) { live->add(record); });
}

/// All that is touched from here on is in the video.
void ViewerRecording::begin_if_there(ViewerState& state) {
    if (!waiting_ || !state.media.playback.live || state.media.playback.live->media != waiting_->number) return;
    start(std::exchange(waiting_, {})->file, state);
}

void ViewerRecording::start(const std::filesystem::path& file, ViewerState& state) {
    TickRecord left_behind;  // of a recording that was stopped
    while (ticks_.pop(left_behind)) continue;
    participant_ = state.touch.session_fields.participant.data();
    note_ = state.touch.session_fields.note.data();
    std::map<std::string, std::string> facts = session_facts(state);
    facts.emplace(kParticipant, participant_);
    facts.emplace(kNote, note_);
    recorder_ = std::make_unique<Recorder>(file, ticks_, facts, &heart_);
    words_.recording(file);
    std::uint32_t number = 0;
    for (const Opened& opened : opened_) tell_media(++number, opened);
    if (!maps_.empty()) recorder_->maps(maps_version_, maps_);
    told_version_ = 0;
    falcon_serial_.clear();
    inverse3_id_.clear();
    ages_told_ = 0;
    ages_before_ = state.touch.inverse3 ? state.touch.inverse3->ages : PoseAges{};
    device_.clear();
    start_ = std::chrono::steady_clock::now();
    state.touch.recording_trouble.clear();
    state.touch.recording.emplace().file = file;
}

std::string ViewerRecording::stop(ViewerState& state, const std::string& reason) {
    take_news(state);  // with what was typed last
    if (std::exchange(waiting_, {})) {
        live_->discard();
        leave();
        return "Nothing was recorded: no frame came";
    }
    if (!recorder_) return {};
    finishing_file_ = state.touch.recording->file;
    if (!reason.empty())
        print_warning(finishing_file_.string() + ": the recording ends here, as " + reason);
    if (live_) {
        finishing_ = std::async(std::launch::async,
                                [recorder = std::move(recorder_), live = std::move(live_)] {
                                    std::this_thread::sleep_for(kLastTicks);
                                    return finish_both(*recorder, *live, Recorder::kPatience);
                                });
        opened_.back().grows = false;
        leave();
        state.touch.recording.reset();
        return "Finishing the recording" + (reason.empty() ? "" : ", as " + reason);
    }
    return told(recorder_->finish(), state);
}

/// Of one that is over.
std::string ViewerRecording::told(const RecorderStatus& recorded, ViewerState& state) {
    if (!recorded.failure.empty()) {
        break_off(state, recorded.failure);
        return {};
    }
    state.touch.recorded_file = finishing_file_;
    leave();
    state.touch.recording.reset();
    state.touch.session_fields.note = {};  // it was about this one
    return "Recorded " + std::to_string(recorded.rows) + " ticks into " +
           state.touch.recorded_file.string();
}

std::optional<std::string> ViewerRecording::take_finished(ViewerState& state) {
    if (!finishing_.valid() ||
        finishing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return told(finishing_.get(), state);
}

void ViewerRecording::break_off(ViewerState& state, const std::string& failure) {
    state.touch.recording_trouble = failure;
    // What is felt from here on nobody could look up: whoever relies on it is to notice.
    state.touch.force_enabled = false;
    state.ui.message = failure + ". The force is off until it is switched on again" +
                    state.keys.in_brackets(Action::toggle_force) + ".";
    if (failure_.empty()) failure_ = failure;
    leave();
    state.touch.recording.reset();
}

void ViewerRecording::hand_over(const HapticSettings& settings,
                                const std::filesystem::path& bump_file) {
    if (!recorder_ || told_version_ == settings.version) return;
    told_version_ = settings.version;
    recorder_->parameters({.version = settings.version,
                           .touch = settings.parameters,
                           .limits = settings.limits,
                           .force_enabled = settings.force_enabled,
                           .bump = {settings.bump ? bump_file : std::filesystem::path{}}});
}

void ViewerRecording::maps(std::uint32_t version, std::vector<SessionMap> maps) {
    maps_version_ = version;
    maps_ = std::move(maps);
    if (recorder_) recorder_->maps(maps_version_, maps_);
}

std::string ViewerRecording::mark(ViewerState& state,
                                  std::chrono::steady_clock::time_point moment) {
    if (!recorder_)
        return "Nothing is recorded that could be marked" +
               state.keys.told(Action::record, " begins");
    const char* typed = state.touch.session_fields.tag.data();
    const std::string tag = *typed == '\0' ? kPlainTag : typed;
    recorder_->mark(tag, {}, moment);
    const std::chrono::duration<double> ago = std::chrono::steady_clock::now() - moment;
    const double t_s = std::max(0.0, now_s() - ago.count());
    state.touch.recording->marks.push_back({t_s, tag, {}});
    return "Marked at " + clock_text(t_s) + ": " + tag;
}

void ViewerRecording::mark(const std::string& tag) {
    if (recorder_) recorder_->mark(tag);
}

void ViewerRecording::take_news(ViewerState& state) {
    begin_if_there(state);
    if (!recorder_) return;
    const auto tell_changed = [this](const char* key, const TextField& field,
                                     std::string& told) {
        if (told == field.data()) return;
        told = field.data();
        recorder_->set_fact(key, told);
    };
    tell_changed(kParticipant, state.touch.session_fields.participant, participant_);
    tell_changed(kNote, state.touch.session_fields.note, note_);
    const std::string serial = state.touch.falcon ? state.touch.falcon->status.serial : std::string{};
    if (!serial.empty() && serial != falcon_serial_) {
        falcon_serial_ = serial;
        recorder_->set_fact("falcon-serial", serial);
    }
    // As the last one that touched, which may not be the one that was asked for.
    if (const std::string device = device_name(state);
        device != device_ && device != state.touch.device.name) {
        device_ = device;
        recorder_->set_fact("device", device);
    }
    const std::string id = state.touch.inverse3 ? state.touch.inverse3->status.id : std::string{};
    if (!id.empty() && id != inverse3_id_) {
        inverse3_id_ = id;
        for (const auto& [name, value] : state_of(state.touch.inverse3->status).facts)
            recorder_->set_fact("inverse3-" + name, value);
    }
    tell_ages(state);
    state.touch.recording->status = recorder_->status();
    state.touch.recording->time_s = now_s();
    std::string failure = state.touch.recording->status.failure;
    if (const std::string of_video = live_ ? live_->failure() : std::string{}; !of_video.empty())
        failure = "Recording the video of what is live stopped: " + of_video;
    if (!failure.empty()) break_off(state, failure);
}

/// Of the poses that the recorded ticks used, while the recording goes on.
void ViewerRecording::tell_ages(const ViewerState& state) {
    if (!state.touch.inverse3) return;
    const PoseAges ages = state.touch.inverse3->ages.since(ages_before_);
    if (ages.count() == 0 || ages.count() == ages_told_) return;
    ages_told_ = ages.count();
    for (const auto& [name, part] : {std::pair{"half", 0.5}, {"most", 0.99}, {"worst", 1.0}}) {
        recorder_->set_fact(std::string("inverse3-pose-age-") + name + "-ms",
                            number_text(ages.quantile_ms(part), 2));
    }
}

void ViewerRecording::leave() {
    if (live_) player_.record_live(0, {});
    live_.reset();
    recorder_.reset();
    words_.recording({});
}

void ViewerRecording::finish(std::chrono::milliseconds for_sums) {
    std::string last;
    if (waiting_) {
        live_->discard();
        last = waiting_->file.string() +
               ": nothing was recorded, as no frame came: see whether its sender sends";
    }
    if (live_ && recorder_) last = finish_both(*recorder_, *live_, for_sums).failure;
    if (!live_ && recorder_) last = recorder_->finish(for_sums).failure;
    if (last.empty() && finishing_.valid()) last = finishing_.get().failure;
    if (failure_.empty()) failure_ = last;
    if (!failure_.empty()) throw InputError(failure_);
}

double ViewerRecording::now_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace dibhr
