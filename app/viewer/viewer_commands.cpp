// The commands of panels and keys, which the viewer performs after the picture.
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>

#include "app/panels/commands.hpp"
#include "app/viewer/viewer.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {

void Viewer::carry_out_commands() {
    if (state_.touch.replay) replay_.follow_panels(state_);
    if (const auto notice = browsing_.advance(state_)) tell(*notice);
    const Overloaded carry_out{
        [this](Action action) { perform_after_picture(action); },
        [this](const OpenRequest& request) { open(request); },
        [this](const DepthStatement& said) { open_again(said); },
        [this](DepthWish wish) {
            attempt([&] {
                if (const auto made = estimating_.perform(wish, state_)) open(*made);
            });
        },
        [this](const TypedFile& entered) { browsing_.enter(entered, state_.ui.dialog); },
        [this](SaveSidecar) { attempt([this] { tell(save_sidecar()); }); },
        [this](const LoadBump& bump) { load_bump(bump.file); },
        [this](const UseMaterial& material) { take_material(material.name); },
        [this](const KeepMaterial& material) { keep_material(material.name); },
        [this](const UseFirmware& firmware) {
            attempt([&] { tell(touch_.use_firmware(firmware.file)); });
        },
        [this](AnswerDoubts answer) { take_word(answer.agreed); },
        [this](RemovePaint) { painting_.remove_all(state_, touch_.player()); },
        [this](MarkMoment mark) { tell(touch_.recording().mark(state_.keys, mark.at)); },
        [this](ReplayAsRecorded) { replay_.put_back(state_); },
        [this](LeaveReplay) {
            const MediaDescription& video = state_.media;
            open({video.colour_path, video.depth_path});
        },
        [this](const ReadFolder& wanted) { browsing_.go_to(wanted.folder, state_.ui.dialog); },
        [this](const CompleteTyped& line) { browsing_.complete(line.typed, state_.ui.dialog); },
        [this](const MakeReport& report) { make_report(report.session); }};
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
            return tell(window_.full_screen() ? "Full screen" : "Full screen off");
        case Action::take_screenshot:
            return screenshots_.ask(PictureOf::window);
        case Action::take_screenshot_of_relief:
            return screenshots_.ask(PictureOf::relief);
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
void Viewer::take_word(bool agreed) {
    const std::vector<Doubt> doubts = std::exchange(state_.ui.doubts, {});
    if (!agreed) return keeper_.forget(doubts);
    copy_doubted(doubts, options_.in_file, state_.settings);
    lasting_.add([doubts] { Consent().agree(doubts); });
}

void Viewer::start_or_stop_recording() {
    TouchRecording& recording = touch_.recording();
    if (state_.touch.replay) {
        tell("A replay is not recorded: open a video to touch");
    } else if (recording.asked_for()) {
        painting_.hand_over(recording);
        tell(recording.stop());
    } else if (recording.finishing()) {
        tell("Still finishing the last recording");
    } else if (!touch_.may_record()) {
        state_.commands.push(Action::record);  // try again after the next picture
    } else {
        attempt([&] {
            const std::string file = new_file_name("dibhr");
            state_.media.live ? recording.start_live(file) : recording.start(file);
            state_.ui.show_session = true;
            tell("Recording into " + file);
        });
    }
}

void Viewer::start_or_stop_clip(PictureOf of) {
    if (clip_.stopped()) {
        tell("Still finishing the last clip");
    } else if (clip_.active()) {
        clip_.stop();
        tell("Finishing the clip");
    } else {
        attempt([&] {
            clip_.start(picture_name(state_) + ".mp4", ClipName::stands_beside, of);
            state_.ui.notice_until_s = 0.0;  // no notice: it would be in the clip
        });
    }
}

void Viewer::load_bump(const std::filesystem::path& file) {
    attempt([&] {
        TouchState& touch = state_.touch;
        touch.bump = file.empty() ? nullptr : std::make_shared<const BumpMap>(read_bump_map(file));
        touch.bump_file = file;
        if (touch.bump) make_felt(state_.settings.touch);
    });
}

void Viewer::take_material(const std::string& name) {
    if (state_.touch.replay) {
        tell(
            "A replay is felt as it was recorded: press \"Touch this video\" on the Replay panel "
            "to choose a material");
        return;
    }
    attempt([&] {
        Material material = material_called(name);
        lay(material, state_.settings.touch);
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
        tell("Kept as " + save_material(material).string());
        state_.ui.materials = material_names();
        state_.ui.fields.material = {};
        take_material(name);
    });
}

void Viewer::make_report(const std::filesystem::path& session) {
    attempt([&] {
        const bool begun = reporting_.start(std::filesystem::absolute(session));
        tell(begun ? "Making the report" : "Still making the last report");
    });
}

void Viewer::take_report() {
    attempt([this] {
        const auto page = reporting_.take();
        if (!page) return;
        tell("Report: " + page->string());
        show_in_browser(*page);
    });
}

}  // namespace dibhr
