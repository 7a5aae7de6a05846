// The viewer's media: opening and showing a video or session, and the files saved beside it.
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/assets_path.hpp"
#include "app/settings/recent_files.hpp"
#include "app/viewer/viewer.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/playing/live_status.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

using std::chrono::steady_clock;

namespace {

constexpr const char* kDesktopAsks = "Choose in the desktop's dialog";

std::string desktop_words(const ViewerState& state) {
    return kDesktopAsks +
           state.keys.key_hint(Action::open_file_in_window, " opens one in this window");
}

/// Pushes a command to open the files; false: too many, or none.
bool take_files(const std::vector<std::filesystem::path>& files, ViewerState& state) {
    const bool one = files.size() == 1;
    if (one && named_firmware(files.front())) {
        state.commands.push(UseFirmware{files.front()});
    } else if (one && files.front().extension() == ".toml") {
        state.commands.push(UseMaterial{files.front().string()});
    } else {
        const auto request = dropped_request(files);
        if (request) state.commands.push(*request);
        return request.has_value();
    }
    return true;
}

/// The file whose levels are depth.
const std::filesystem::path& depth_file(const MediaDescription& media) {
    return media.depth_path.empty() ? media.colour_path : media.depth_path;
}

}  // namespace

void Viewer::take_opened() {
    if (auto opened = opening_.take()) {
        if (opened->media || opened->session) {
            estimating_.withdraw_offer(state_);
            kiosk_passed_ = 0;
        }
        if (opened->media)
            show_media(std::move(opened->media), opened->request, opened->memory,
                       std::move(opened->maps), opened->guide);
        if (opened->session) replay_session(std::move(opened->session), opened->guide);
        if (options_.kiosk && !opened->failure.empty()) {
            print_error_line(opened->failure);
            log_.append("warning", opened->failure);
            pass_over_in_kiosk();
        } else if (opened->is_folder) {
            browsing_.show(opened->request.colour, state_);
        } else if (opened->lacks_depth && estimating_.offer(opened->request.colour, state_)) {
            fill_depth_fields(state_);
        } else if (!opened->failure.empty() && !opened->request.reconnect) {
            state_.ui.message = opened->failure;
            fill_depth_fields(state_);  // the ones in use
        }
        if (state_.ui.depth_question) state_.ui.depth_question->answered = false;  // by a failure
    }
    state_.media.opening = opening_.running();
}

/// What is being opened, from the request until its first frame is there, if that takes long.
std::optional<OpeningShown> Viewer::opening_shown() const {
    if (steady_clock::now() - opening_since_ < kUnnoticedOpening) return std::nullopt;
    if (opening_.running()) return OpeningShown{opening_name_, kReadingFiles};
    const auto& replay = state_.touch.replay;
    const bool has_frames = replay ? replay->tick.surface && replay->playback.failure.empty()
                                   : !state_.media.live && !state_.media.depth_path.empty();
    if (!has_frames || shown_.makes_surface() || !state_.ui.message.empty()) return std::nullopt;
    return OpeningShown{opening_name_, kReadingFirstFrame};
}

void Viewer::take_dropped(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    // A picture dropped on the relief is a recording; dropped on the panels, a bump map.
    const bool over_panels = window_.pointer().position_px.x >= relief_viewport().x;
    if (over_panels && files.size() == 1 && named_picture(files.front())) {
        state_.commands.push(LoadBump{files.front()});
    } else if (!take_files(files, state_)) {
        state_.ui.message =
            "Drop one colour file, a colour and a depth file together, a folder, a session or a "
            "material. A picture that is dropped on the panels becomes a bump map.";
    }
}

Answer Viewer::open_by_dialog() {
    const OpenWith with = state_.settings.open_with;
    const bool of_desktop =
        with == OpenWith::desktop || (with == OpenWith::automatic && has_desktop());
    if (!desktop_.open() && (!of_desktop || state_.ui.dialog.shown)) {
        browsing_.toggle(state_);
        return {};
    }
    if (!desktop_.open()) desktop_.ask(browsing_.first_folder(state_), window_.x11_window());
    return {desktop_words(state_)};
}

/// While the desktop's dialog is open, a notice says so.
void Viewer::take_desktop_answer() {
    const auto answer = desktop_.take();
    if (desktop_.open())
        keep_notice(desktop_words(state_));
    else
        end_notice(kDesktopAsks);
    if (!answer) return;
    if (answer->outcome == FileAnswer::Outcome::unavailable) {
        if (state_.settings.open_with == OpenWith::desktop)
            show_notice("The desktop shows no dialog: this is the window's own");
        if (!state_.ui.dialog.shown) browsing_.toggle(state_);
    } else if (answer->outcome == FileAnswer::Outcome::chosen &&
               !take_files(answer->files, state_)) {
        state_.ui.message = "Choose one file, or a colour and a depth file together.";
    }
}

void Viewer::show_media(std::unique_ptr<Media> media, const OpenRequest& request,
                        const FileMemory& memory, FoundMaps maps, const FoundGuide& guide) {
    lead_.end(state_);
    explaining_.end(state_, camera_);
    if (!request.chosen && !request.reconnect) forget_ruler();
    // A recording's video would lack these frames: end it. A waiting one goes on below.
    const bool live = media->description().live;
    const std::filesystem::path waits =
        live && request.reconnect ? touch_.recording().waiting_file() : std::filesystem::path{};
    if (live && touch_.recording().active_or_waiting()) {
        const std::string ended =
            touch_.recording().stop(request.reconnect ? "the live source changed its form" : "");
        if (waits.empty()) show_notice(ended);  // a waiting recording starts again below
    }
    if (!request.chosen) turned_.reset();
    if (!request.chosen) keep_memory();
    replay_.end(state_);
    if (!request.chosen) forget_relief();
    const MediaDescription before = state_.media;
    state_.media.describe(media->description());
    const MediaDescription& now = state_.media;
    state_.media.opened = request;
    state_.media.opened.request.panel = now.panel;
    state_.media.opened.request.live = media->live();
    state_.media.opened.reconnect = false;
    fill_depth_fields(state_);
    trace_.clear();
    if (request.chosen) keep_panel(depth_file(before));
    ask_depth(request);
    fit_to_media();
    // After a change of the depth options the view stays.
    const bool same_size =
        now.depth_columns == before.depth_columns && now.depth_rows == before.depth_rows;
    if (!request.chosen || !same_size) frame_relief();
    show_title(now.colour_path.empty() ? now.depth_path : now.colour_path);
    // As named; dropped files in the order found: colour, depth.
    keep_recent(request.in_any_order && !request.depth.empty()
                    ? RecentFile{now.colour_path, now.depth_path}
                    : RecentFile{request.colour, request.depth});
    if (!options_.touch.uses_maps())
        maps = {nullptr, "Nothing is painted with --maps off: start dibhr without it"};
    if (options_.touch.uses_maps() && !maps.refusal.empty())
        state_.ui.message = maps.refusal + "\n\nThe recording is touched without touch maps.";
    if (now.live)
        maps = {nullptr,
                "A live source cannot be painted on: there is no file to keep the paint beside"};
    touch_.play(std::move(media),
                painting_.begin(std::move(maps), guide.regions, now, remembered_file(now).empty()));
    guide_.begin(guide, state_);
    if (!waits.empty()) attempt([&] { touch_.recording().start_live(waits); });
    if (request.at_s > 0.0) touch_.player().seek(request.at_s);
    if (request.paused) touch_.player().pause();
    if (!request.chosen && !options_.kiosk) apply_memory(memory, request);
    if (touch_.runs()) return;
    fit_to_media();
    heart_.beat();
    touch_.start();
}

/// Saves view, relief and position of the shown file, before another one or the program's end.
/// Errors are ignored: nothing important is lost.
void Viewer::keep_memory() try {
    if (remembered_.empty()) return;
    FileMemory memory;
    const Settings& settings = state_.settings;
    const OwnRelief relief{settings.fit_relief, settings.touch.shape.relief_px};
    if (relief == relief_shown_) {  // unchanged, also a value of the command line
        memory.relief_px = read_memory(file_memories_path(), remembered_).relief_px;
    } else if (!relief.fits) {
        memory.relief_px = relief.relief_px;
    }
    Camera whole = camera_;
    whole.reset();
    if (!(camera_.view() == whole.view())) memory.view = text_of(camera_.view());
    constexpr double kNearEnd_s = 2.0;  // a video watched to its end begins anew
    const PlaybackStatus playback = touch_.player().status();
    const double at_s = playback.media_s;
    const bool goes_on = at_s > 0.0 && at_s < playback.duration_s - kNearEnd_s;
    if (goes_on) memory.at_s = at_s;
    save_queue_.add([folder = file_memories_path(), file = remembered_, memory] {
        try {
            dibhr::keep_memory(folder, file, memory);
        } catch (const InputError&) {
        }
    });
} catch (const std::exception&) {
}

void Viewer::apply_memory(const FileMemory& memory, const OpenRequest& request) {
    remembered_ = remembered_file(state_.media);
    Settings& settings = state_.settings;
    if (!remembered_.empty())
        relief_before_ = {settings.fit_relief, settings.touch.shape.relief_px};
    if (memory.relief_px) {
        settings.fit_relief = false;
        settings.touch.shape.relief_px = *memory.relief_px;
        frame_relief();
    }
    relief_shown_ = {settings.fit_relief, settings.touch.shape.relief_px};
    if (const auto view = view_in(memory.view)) camera_.set_view(*view);
    if (settings.resume && memory.at_s > 0.0 && !(request.at_s > 0.0)) {
        touch_.player().seek(memory.at_s);
        show_notice("Goes on where it was left (Home: from the start)");
    }
}

/// Restores the relief settings of before the file that has its own.
void Viewer::forget_relief() {
    if (!relief_before_) return;
    state_.settings.fit_relief = relief_before_->fits;
    state_.settings.touch.shape.relief_px = relief_before_->relief_px;
    relief_before_.reset();
}

/// Its points are of the relief before.
void Viewer::forget_ruler() {
    if (state_.ui.ruler) state_.ui.ruler.emplace();
}

void Viewer::replay_session(std::unique_ptr<OpenedSession> session, const FoundGuide& guide) {
    lead_.end(state_);
    painting_.flush_maps(touch_.recording());
    if (touch_.recording().active_or_waiting()) show_notice(touch_.recording().stop());
    for (const std::string& warning : {session->session.warning(), session->frames.warning})
        if (!warning.empty()) show_notice(capitalised(warning));
    explaining_.end(state_, camera_);
    forget_ruler();
    painting_.end(state_);
    guide_.begin(guide, state_);
    keep_memory();
    remembered_.clear();
    state_.ui.depth_question.reset();
    touch_.stop();  // the force goes to zero; no device is read
    trace_.clear();
    touch_.player().pause();
    show_title(session->session.file());
    keep_recent({session->session.file()});
    replay_.begin(std::move(session), std::exchange(options_.touch.given, {}), state_);
    frame_relief();
}

/// Errors are ignored: in such a home folder, saving the settings reports the error.
void Viewer::keep_recent(const RecentFile& opened) {
    const SampleFiles sample = sample_files();
    const std::filesystem::path history = recent_files_path();
    state_.media.recent = read_recent_files(history);
    if (opened == RecentFile{sample.colour, sample.depth}) return;
    state_.media.recent = with_first(opened, state_.media.recent);
    save_queue_.add([opened, history] {
        try {
            add_recent_file(opened, history);
        } catch (const InputError&) {
        }
    });
}

void Viewer::show_title(const std::filesystem::path& file) {
    window_.set_title(shown_name(file) + " - dibhr");
}

/// Saves the panel's depth choices for the file that they made the depth.
void Viewer::keep_panel(const std::filesystem::path& depth_before) {
    save_queue_.add([folder = depth_choices_path(), depth_before, depth = depth_file(state_.media),
                     panel = state_.media.opened.request.panel] {
        if (depth != depth_before) keep_choice(folder, depth_before, {});
        keep_choice(folder, depth, panel);
    });
}

/// Opens the same files at the same moment, with the panel's new depth choices in place of the old.
void Viewer::open_again(const DepthStatement& panel) {
    DepthRequest request = state_.media.opened.request;
    request.panel = panel;
    open_again(std::move(request));
}

/// The same with all statements on the depth; those of the panel are kept.
void Viewer::open_again(DepthRequest statements) {
    OpenRequest request = state_.media.opened;
    request.request = std::move(statements);
    request.request.find_out = true;
    request.request.panel_is_whole = true;
    request.chosen = true;
    request.at_s = state_.media.playback.media_s;
    request.paused = !state_.media.playback.playing;
    open(request);
}

/// Asks what the depth of the opened files means, where that is not sure. From now on no force is
/// sent until a person has answered.
void Viewer::ask_depth(const OpenRequest& request) {
    state_.ui.depth_question.reset();
    const std::string doubt = doubt_about(state_.media);
    if (doubt.empty() || request.chosen || request.reconnect) return;
    if (!options_.asks_nobody()) {
        state_.ui.depth_question = question_on(state_.media);
        state_.touch.depth_in_question = state_.ui.depth_question.has_value();
        if (touch_.runs()) touch_.publish();
    } else if (touch_.runs()) {  // of files of the command line it was said before
        print_error_line(doubt);
        log_.append("warning", doubt);
    }
}

void Viewer::answer_depth(const AnswerDepth& answer) {
    std::optional<DepthQuestion>& question = state_.ui.depth_question;
    if (!question || question->answered) return;
    if (!answer.alternative) {
        question.reset();
        return show_notice("Goes on with 1 and keeps nothing" +
                           state_.keys.key_hint(Action::turn_depth, " turns near and far") +
                           "; the Video panel has the rest");
    }
    if (opening_.running()) return show_notice("Still opening the last files");
    const DepthStatement& right = question->alternatives[*answer.alternative].statement;
    if (question->for_folder)
        save_queue_.add([folder = depth_choices_path(), file = depth_file(state_.media), right] {
            keep_folder_choice(folder, file, right);
        });
    question->answered = true;
    DepthStatement panel = right;
    panel.fill_in(state_.media.opened.request.panel);
    open_again(panel);
}

/// Turns near and far of the open depth, and again back to what was before. Also against the
/// command line, which was there first.
Answer Viewer::turn_depth() {
    if (state_.touch.replay) return {"A replay is felt as it was recorded: nothing is turned"};
    const MediaState& media = state_.media;
    if (media.depth_path.empty()) return {"Nothing is open"};
    if (!media.meaning)
        return {"The depth is as the file has it (--raw-depth): start dibhr without it to turn it"};
    if (opening_.running()) return {"Still opening the last files"};
    const DepthRequest& now = media.opened.request;
    if (turned_ && turned_->panel == now.panel) {
        open_again(std::exchange(turned_, {})->before);
        return {"Near and far as before"};
    }
    DepthRequest request = now;
    const DepthStatement turned = turned_near_and_far(*media.meaning);
    request.panel = turned;
    request.panel.fill_in(now.panel);
    const auto forget_turned = [](const char* /*name*/, const auto& fact, auto& given) {
        if (fact) given.reset();
    };
    visit_facts(turned, request.command_line, forget_turned);
    turned_ = TurnedDepth{request.panel, now};
    open_again(std::move(request));
    return {"Near and far turned: near is " + std::string(name_of(*turned.near)) +
            (media.meaning->unit.value == DepthUnit::levels ? "" : ", no distances") +
            state_.keys.key_hint(Action::turn_depth, " turns them back")};
}

/// Reopens a live source that now sends another size or kind of picture.
void Viewer::follow_live() {
    const auto& live = state_.media.playback.live;
    if (!live || state_.touch.replay) return;
    log_.append_if_changed("live", signal_in_words(*live));
    if (!live->format_changed || live->opened != touch_.media_number() || opening_.running())
        return;
    OpenRequest request = state_.media.opened;
    request.request.live = nullptr;
    request.reconnect = true;
    open(request);
}

/// Opens after the writes so far, so that the file's memory is read as saved.
void Viewer::open(const OpenRequest& request) {
    const bool begun = opening_.start([request, remembered = save_queue_.done_so_far()] {
        if (remembered.valid()) remembered.wait();
        return try_open(request);
    });
    if (!begun) return show_notice("Still opening the last files");
    opening_name_ = shown_name(request.colour.empty() ? request.depth : request.colour);
    opening_since_ = steady_clock::now();
}

std::string Viewer::save_sidecar() {
    if (state_.media.live)
        throw InputError("a live source has no sidecar: what you choose is kept for its name");
    if (!state_.media.meaning) throw InputError("nothing is known of this depth: it is shown raw");
    const std::filesystem::path& file = depth_file(state_.media);
    DepthStatement all = state_.media.meaning->statement();
    const CleaningOptions& cleaning = state_.settings.cleaning;
    if (cleaning.preset != CleaningPreset::automatic)
        all.cleaning = CleaningChoice{cleaning.preset, cleaning.own};
    all.finger_mm = finger_mm_on(state_.media, state_.settings.finger_mm);
    DepthRequest& request = state_.media.opened.request;
    write_sidecar(file, all);
    request.panel = {};  // these are in the sidecar now
    merge_by_priority({{Origin::command_line, request.command_line}, {Origin::sidecar, all}},
                      *state_.media.meaning);
    fill_depth_fields(state_);
    keep_choice(depth_choices_path(), file, {});
    return "Saved " + sidecar_of(file).string();
}

Settings Viewer::settings_to_save() const {
    Settings settings = replay_.settings_to_save(state_);
    const TouchParameters& before = options_.settings.touch;
    if (relief_before_) {
        settings.fit_relief = relief_before_->fits;
        settings.touch.shape.relief_px = relief_before_->relief_px;
    }
    if (settings.fit_relief) settings.touch.shape.relief_px = before.shape.relief_px;
    const Material& material = state_.touch.material;
    if (material.bumps && has_texture(material, settings.touch)) {  // its file has them
        settings.touch.shape.roughness_px = before.shape.roughness_px;
        settings.touch.shape.bump_size_px = before.shape.bump_size_px;
    }
    if (settings.fit_pitch) settings.touch.coupling.pixel_pitch_mm = before.coupling.pixel_pitch_mm;
    return settings;
}

void Viewer::fit_to_media() {
    Settings& settings = state_.settings;
    const bool keeps_texture = has_texture(state_.touch.material, settings.touch);
    const Fit fit = fit_of(state_.media);
    if (settings.fit_relief) settings.touch.shape.relief_px = fit.relief_px;
    if (settings.fit_pitch) settings.touch.coupling.pixel_pitch_mm = fit.pixel_pitch_mm;
    // The pixel pitch may have changed.
    if (keeps_texture) lay_texture(state_.touch.material, settings.touch);
    keep_in_range(settings.touch);
}

void Viewer::frame_relief() {
    explaining_.keep_camera();
    camera_.frame_relief(state_.media.depth_columns, state_.media.depth_rows,
                         state_.settings.touch.shape.relief_px);
}

}  // namespace dibhr
