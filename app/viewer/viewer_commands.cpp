// The commands of panels and keys, which the viewer performs after the picture.
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>

#include "app/panels/commands.hpp"
#include "app/viewer/viewer.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {

namespace {

constexpr const char* kMakingReport = "Making the report";

}  // namespace

void Viewer::carry_out_commands() {
    if (state_.touch.replay) replay_.follow_panels(state_);
    if (const auto notice = browsing_.advance(state_)) show_notice(*notice);
    const Overloaded carry_out{
        [this](Action action) { perform_after_picture(action); },
        [this](const OpenRequest& request) { open(request); },
        [this](const DepthStatement& said) { open_again(said); },
        [this](DepthOfferCommand command) {
            attempt([&] {
                if (const auto made = estimating_.perform(command, state_)) open(*made);
            });
        },
        [this](const TypedFile& entered) { browsing_.enter(entered, state_.ui.dialog); },
        [this](SaveSidecar) { attempt([this] { show_notice(save_sidecar()); }); },
        [this](const LoadBump& bump) { load_bump(bump.file); },
        [this](const UseMaterial& material) { use_material(material.name); },
        [this](const KeepMaterial& material) { keep_material(material.name); },
        [this](const UseFirmware& firmware) {
            attempt([&] { show_notice(touch_.use_firmware(firmware.file)); });
        },
        [this](AgreeToDevice agreed) { touch_.agree_to(agreed.kind, agreed.offer); },
        [this](AnswerUnsafeSettings answer) { answer_unsafe_settings(answer.agreed); },
        [this](const AnswerDepth& answer) { answer_depth(answer); },
        [this](RemovePaint) { painting_.remove_all(state_, touch_.player()); },
        [this](MarkMoment mark) { show_notice(touch_.recording().mark(state_.keys, mark.at)); },
        [this](ReplayAsRecorded) { replay_.restore_recorded(state_); },
        [this](LeaveReplay) {
            const MediaDescription& video = state_.media;
            open({video.colour_path, video.depth_path});
        },
        [this](const ReadFolder& wanted) { browsing_.go_to(wanted.folder, state_.ui.dialog); },
        [this](const CompleteTyped& line) { browsing_.complete(line.typed, state_.ui.dialog); },
        [this](KioskCommand command) { perform_in_kiosk(command); },
        [this](const MakeReport& report) { make_report(report.session); },
        [this](SkipLead) { lead_.end(state_); },
        [this](PrepareRecording) { preparing_.begin_or_cancel(state_); }};
    begin_next_recording();
    for (const WindowCommand& command : state_.commands.take()) std::visit(carry_out, command);
}

/// Performs an action, with the part that perform() leaves for after the picture.
void Viewer::perform_after_picture(Action action) {
    switch (action) {
        case Action::record:
            return start_or_stop_recording();
        case Action::reset_view:
            return frame_relief();
        case Action::toggle_full_screen:
            window_.toggle_full_screen();
            return show_notice(window_.full_screen() ? "Full screen" : "Full screen off");
        case Action::take_screenshot:
            return screenshots_.request(PictureOf::window);
        case Action::take_screenshot_of_relief:
            return screenshots_.request(PictureOf::relief);
        case Action::take_clip:
            return start_or_stop_clip(PictureOf::window);
        case Action::take_clip_of_relief:
            return start_or_stop_clip(PictureOf::relief);
        case Action::quit:
            return window_.close();
        default:
            return perform(action);
    }
}

/// The user's answer about settings that protect the hand less.
void Viewer::answer_unsafe_settings(bool agreed) {
    const std::vector<UnsafeSetting> unsafe_settings = std::exchange(state_.ui.unsafe_settings, {});
    if (!agreed) return settings_saver_.use_defaults(unsafe_settings);
    copy_unsafe(unsafe_settings, options_.in_file, state_.settings);
    save_queue_.add([unsafe_settings] { Consent().agree(unsafe_settings); });
}

void Viewer::start_or_stop_recording() {
    TouchRecording& recording = touch_.recording();
    if (state_.touch.replay) {
        show_notice("A replay is not recorded: open a video to touch");
    } else if (recording.active_or_waiting()) {
        painting_.flush_maps(recording);
        show_notice(recording.stop());
        state_.ui.show_session = true;
    } else {
        record_next_ = !record_next_;  // pressed twice: as if it had not been
        if (recording.finishing())
            show_notice(record_next_ ? "Finishing the last recording: the next one begins after it"
                                     : "No other recording begins");
        begin_next_recording();
    }
}

/// Once the last one is finished, where that was asked for meanwhile.
void Viewer::begin_next_recording() {
    TouchRecording& recording = touch_.recording();
    if (state_.touch.replay) record_next_ = false;
    if (!record_next_ || recording.finishing() || !touch_.may_record()) return;
    record_next_ = false;
    attempt([&] {
        const std::string file = new_file_name("dibhr");
        state_.media.live ? recording.start_live(file) : recording.start(file);
        show_notice("Recording into " + file);
    });
}

void Viewer::start_or_stop_clip(PictureOf of) {
    if (clip_.stopped()) {
        show_notice("Still finishing the last clip");
    } else if (clip_.active()) {
        clip_.stop();
        show_notice("Finishing the clip");
    } else {
        attempt([&] {
            clip_.start(picture_name(state_) + ".mp4", ClipNameConflict::adds_number, of);
            state_.ui.notice_until_s = 0.0;  // no notice: it would be in the clip
        });
    }
}

void Viewer::load_bump(const std::filesystem::path& file) {
    attempt([&] {
        TouchState& touch = state_.touch;
        touch.bump = file.empty() ? nullptr : std::make_shared<const BumpMap>(read_bump_map(file));
        touch.bump_file = file;
        if (touch.bump) ensure_roughness(state_.settings.touch);
    });
}

void Viewer::use_material(const std::string& name) {
    if (state_.touch.replay) {
        show_notice(
            "A replay is felt as it was recorded: press \"Touch this video\" on the Replay panel "
            "to choose a material");
        return;
    }
    attempt([&] {
        Material material = material_named(name);
        apply_material(material, state_.settings.touch);
        state_.touch.bump = material.bumps;
        state_.touch.bump_file = material.map;
        state_.settings.material = material.name.empty() ? std::string{} : name;
        state_.touch.material = std::move(material);
    });
}

void Viewer::keep_material(const std::string& name) {
    attempt([&] {
        const TouchState& touch = state_.touch;
        Material material = material_of(state_.settings.touch, touch.bump_file, touch.bump,
                                        state_.media.depth_columns);
        material.name = name;
        material.sound = touch.material.sound;
        material.look = touch.material.look;
        show_notice("Kept as " + save_material(material).string());
        painting_.forget_tints();
        state_.ui.materials = material_names();
        state_.ui.fields.material = {};
        use_material(name);
    });
}

void Viewer::make_report(const std::filesystem::path& session) {
    attempt([&] {
        const bool begun = reporting_.start(std::filesystem::absolute(session));
        if (!begun) return show_notice("Still making the last report");
        state_.ui.report = {.session = session, .being_made = true};
    });
}

/// The prepared recording is opened again, to play from its surface.
void Viewer::take_prepared() {
    const auto end = preparing_.poll(state_);
    if (!end) return;
    if (!end->failure.empty()) {
        state_.ui.message = end->failure;
    } else if (!end->made) {
        show_notice("Cancelled: nothing is kept");
    } else {
        show_notice("Prepared: plays at its own rate from now on");
        if (preparing_.shows_prepared(state_)) open_again(state_.media.opened.request.panel);
    }
}

void Viewer::take_report() {
    ReportShown& report = state_.ui.report;
    if (!report.being_made) return;
    keep_notice(kMakingReport);
    attempt([&] {
        const auto page = reporting_.take();
        if (!page) return;
        constexpr double kReadPath_s = 20.0;
        show_notice("Report: " + page->string(), kReadPath_s);
        report.page = *page;
        show_in_browser(*page);
    });
    report.being_made = reporting_.running();
    if (!report.being_made) end_notice(kMakingReport);
}

}  // namespace dibhr
