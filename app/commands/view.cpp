// `dibhr view`: combines the settings file with the command line, and opens the files beside the
// window, which is shown once they are open or take long: a failure is reported in one line.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/kiosk.hpp"
#include "app/commands/opening.hpp"
#include "app/commands/output.hpp"
#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/folder.hpp"
#include "app/viewer/message_log.hpp"
#include "app/viewer/viewer.hpp"
#include "app/window/crash_handler.hpp"
#include "app/window/shutdown_watchdog.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/sources/media.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kLongestRun_s = 1e6;
constexpr std::chrono::milliseconds kLogTimeout{50};

/// On stderr and in the log.
void warn(const std::string& sentence, MessageLog& log) {
    print_warning(sentence);
    log.append("warning", sentence);
}

/// Renames an unreadable settings file, so that saving does not overwrite it. The message about it.
std::string move_damaged_settings(const fs::path& file, const std::string& trouble) {
    const auto numbered = [&file](int number) {
        return file.string() + ".damaged" + (number > 1 ? "-" + std::to_string(number) : "");
    };
    int number = 1;
    std::error_code failed;
    while (fs::exists(numbered(number), failed)) ++number;
    fs::rename(file, numbered(number), failed);
    return trouble +
           (failed ? ". It cannot be moved away: " + failed.message()
                   : ". It is kept as " + numbered(number)) +
           ". The default settings are used.";
}

/// With --stay the window opens even where the file cannot be read.
Settings read_settings(const ViewOptions& options, ViewerParts& parts, MessageLog& log) try {
    std::vector<std::string> warnings;
    Settings settings = load_settings(options.settings_file, warnings);
    for (const std::string& warning : warnings) {
        print_error_line(warning);
        log.append("warning", warning);
    }
    return settings;
} catch (const InputError& error) {
    if (!options.stays) throw;
    parts.damage = move_damaged_settings(options.settings_file, error.what());
    warn(parts.damage, log);
    return {};
}

/// Settings of the command line, which replace those of the settings file.
class GivenSettings {
  public:
    /// Returns a function that stores its argument for that setting.
    template <typename Value>
    [[nodiscard]] auto of(Value Settings::*setting) {
        return [this, setting](const Value& value) {
            given_.push_back([setting, value](Settings& settings) { settings.*setting = value; });
        };
    }

    void apply(Settings& settings) const {
        for (const auto& give : given_) give(settings);
    }

  private:
    std::vector<std::function<void(Settings&)>> given_{};
};

/// The whole command line.
struct ViewCommand {
    ViewOptions options{};
    GivenSettings settings{};
    std::optional<std::pair<int, int>> size{};  ///< of the window
    fs::path log_file{};
};

/// Options on how playback begins.
void add_playing_options(CLI::App& app, ViewCommand& command) {
    ViewOptions& options = command.options;
    add_number_option(app, "--start", 0.0, kLongestRun_s,
                      "Begins so many seconds after the start; beyond the end: with the last frame",
                      [&options](double seconds) { options.open.at_s = seconds; })
        ->type_name("S");
    add_number_option(app, "--end", 0.0, kLongestRun_s,
                      "Ends, or begins again at --start, so many seconds after the start",
                      [&options](double seconds) { options.end_s = seconds; })
        ->type_name("S");
    add_speed_option(app, [&options](double speed) { options.speed = speed; });
    add_on_off_option(app, "--loop",
                      "Starts again at the end; a session stops there unless this is given",
                      options.looping)
        ->default_str("on");
    add_on_off_option(app, "--resume", "Goes on where the video was left the last time",
                      command.settings.of(&Settings::resume))
        ->default_str("off");
    app.add_flag("--pause", options.open.paused, "Begins paused");
    app.add_flag("--full-screen", options.full_screen, "Fills the screen");
    add_kiosk_options(app, options.kiosk);
}

/// A replay has its recorded surface and is not recorded again: refuses other options.
void require_replay_options(const ViewOptions& options) {
    const TouchRequest& touch = options.touch;
    const bool wrong = !options.open.depth.empty() || !options.record.empty() ||
                       touch.changes_surface() || touch.depth != DepthStatement{};
    if (!wrong) return;
    throw UsageError(options.open.colour.string() +
                     " is a session, which is replayed as it was recorded: leave out a depth file, "
                     "--record, --material, --bump, --maps, --raw-depth, --cleaning, --finger, "
                     "--in-betweens and the options that say what depth means");
}

void require_writable_folder(const fs::path& file, const char* option) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder) || ::access(folder.c_str(), W_OK) != 0 ||
        fs::is_directory(file)) {
        throw InputError("cannot write " + file.string() +
                         ": choose a folder that can be written for " + option);
    }
}

void require_writable_outputs(const ViewOptions& options) {
    if (!options.screenshot.empty()) require_writable_folder(options.screenshot, "--screenshot");
    if (!options.clip.empty()) require_writable_folder(options.clip, "--clip");
    if (options.clip == "-" || (fs::exists(options.clip) && !fs::is_regular_file(options.clip)))
        throw InputError("a clip cannot be written to " + options.clip.string() +
                         ": give --clip the name of a file");
    const auto require_apart = [](const fs::path& one, const fs::path& other, const char* both) {
        if (!one.empty() && whole_path(one) == whole_path(other))
            throw InputError(one.string() + " cannot be both " + both + ": give them two names");
    };
    require_apart(options.clip, options.screenshot, "clip and screenshot");
    if (options.record.empty()) return;
    require_writable_folder(options.record, "--record");
    require_apart(options.record, options.screenshot, "recording and screenshot");
    require_apart(options.record, options.clip, "recording and clip");
    if (fs::exists(options.record))
        throw InputError(options.record.string() +
                         " exists already: move it away or give --record another name");
}

void use_sample_without_file(OpenRequest& open) {
    if (!open.colour.empty()) return;
    const SampleFiles sample = sample_files();
    open.colour = sample.colour;
    open.depth = sample.depth;
}

/// Applies damping, cleaning, relief and pitch of the command line. Raw depth has the paper's
/// relief and pitch.
void apply_surface_options(const TouchRequest& touch, Settings& settings) {
    if (touch.given.gives_damping()) settings.damping_as_needed = false;
    if (touch.preset) settings.cleaning.preset = *touch.preset;
    if (touch.raw_depth) settings.cleaning.preset = CleaningPreset::raw;
    if (touch.finger_mm) settings.finger_mm = *touch.finger_mm;
    if (touch.in_betweens) settings.in_betweens = *touch.in_betweens;
    TouchParameters& parameters = settings.touch;
    const auto take = [&](bool& fits, bool as_auto, double& number) {
        const TouchNumber& row = number_of(number, parameters);
        const bool given = touch.given.value_of(row) != nullptr;
        if (touch.raw_depth && !given) number = row.standard();
        if (touch.raw_depth || given) fits = false;
        if (as_auto) fits = true;
    };
    take(settings.fit_relief, touch.given.fit_relief, parameters.shape.relief_px);
    take(settings.fit_pitch, touch.given.fit_pitch, parameters.coupling.pixel_pitch_mm);
}

/// The material of the command line, else that of the settings.
Material chosen_material(const GivenParameters& given, Settings& settings, MessageLog& log) try {
    if (!given.material && !given.bump.empty()) settings.material.clear();
    Material material;
    if (given.material) {
        material = *given.material;
        settings.material = material.name;
    } else if (!settings.material.empty()) {
        material = material_named(settings.material);
        lay_texture(material, settings.touch);
    }
    return material;
} catch (const InputError& error) {
    warn(error.what(), log);
    settings.material.clear();
    return {};
}

void apply_touch_options(const TouchRequest& touch, ViewerParts& parts, Settings& settings,
                         MessageLog& log) {
    parts.material = chosen_material(touch.given, settings, log);
    parts.bump_file = parts.material.map;
    parts.bump = parts.material.bumps;
    if (!touch.given.bump.empty()) {
        parts.bump_file = touch.given.bump;
        parts.bump = touch.given.read_bumps();
    }
    touch.given.apply(settings.touch);
}

/// Waits for background tasks. False: one still waits for a disk or opens a large file. After a
/// signal the wait is shorter than Ending's timeout.
bool wait_all(const TaskGroup& tasks, ShutdownWatchdog& shutdown) {
    constexpr std::chrono::milliseconds kTimeout{500};
    constexpr std::chrono::milliseconds kTimeoutAtSignal{100};
    shutdown.crash_note().set_activity("waiting for a file");
    return tasks.wait_all(shutdown.requested() ? kTimeoutAtSignal : kTimeout);
}

void add_file_options(CLI::App& app, ViewOptions& options) {
    add_file(app, "COLOR", options.open.colour,
             "Colour video, image or folder of pictures, a camera or stream (v4l2:/dev/video0, "
             "udp://...), or a recorded session to replay; none: the built-in sample",
             "");
    add_file(app, "DEPTH", options.open.depth,
             "Depth video, image or folder, camera or stream; without it: the depth in the "
             "colour's file or folder, or the file beside it that is named depth instead of color",
             "");
    add_device_option(app, options.device);
    add_firmware(app, options.firmware);
    add_file(app, "--record", options.record,
             "Records every tick into a new session file (.dibhr)");
    add_words_option<SurfaceRecording>(
        app, "--record-surface",
        "What a recording stores of the surface that is felt: around the hand, or whole frames",
        [&options](SurfaceRecording how) { options.record_surface = how; });
    add_on_off_option(app, "--record-preview",
                      "Stores with the surface a small colour picture of each second of the video",
                      [&options](bool on) { options.record_preview = on; })
        ->default_str("on");
    add_file(app, "--screenshot", options.screenshot, "Saves the last picture as PNG");
    add_file(app, "--clip", options.clip,
             "Saves what the window shows as MP4, from start to end; the program ends at --end, "
             "unless the video loops");
    app.add_flag_function(
        "--no-panels", [&options](std::int64_t) { options.pictures_of = PictureOf::relief; },
        "--screenshot and --clip show the relief alone");
}

/// Options on appearance, sound, settings file and log of the window.
void add_window_options(CLI::App& app, ViewCommand& command) {
    GivenSettings& given = command.settings;
    add_size_option(app, command.size, "Size of the window");
    add_number_option(app, "--ui-scale", kSmallestUi, kLargestUi,
                      "Size of text and panels; 1: as on an ordinary display",
                      given.of(&Settings::ui_scale))
        ->type_name("X");
    add_words_option<Theme>(app, "--theme", "Colours of the window", given.of(&Settings::theme));
    app.add_option_function<std::string>(
           "--screenshot-name",
           [give = given.of(&Settings::screenshot_name)](const std::string& text) {
               const NamePattern pattern{text};
               const std::string lacking = problem_of(pattern);
               if (!lacking.empty())
                   throw CLI::ValidationError("--screenshot-name", in_quotes(text) + " " + lacking);
               give(pattern);
           },
           "How pictures and clips are named, without the ending: %Y %m %d %H %M %S, {file}, "
           "{time} and {frame} of the video; a folder may stand before it")
        ->type_name("PATTERN")
        ->default_str(NamePattern{}.text);
    add_file(app, "--settings", command.options.settings_file,
             "Reads and keeps the settings in this file, in place of ~/.config/dibhr/settings.toml "
             "(below XDG_CONFIG_HOME, if that is set); if the file does not exist yet, it begins "
             "with the defaults");
    add_file(app, "--log-file", command.log_file,
             "Appends every notice, message, error and late tick to this file, with its time");
    add_words_option<OpenWith>(
        app, "--open-dialog",
        "Dialog in which files are chosen: auto (the desktop's where there is a desktop), desktop, "
        "window (the window's own, with pairs and previews)",
        given.of(&Settings::open_with));
    add_flag_of(app, "--mute", given.of(&Settings::mute), "Touch makes no sound");
    add_flag_of(app, "--speak", given.of(&Settings::speak),
                "Speaks what is touched, messages, captions (speech-dispatcher)");
    add_on_off_option(app, "--outlines",
                      "Outlines of regions (NAME_regions.toml) are felt as ridges",
                      given.of(&Settings::outlines))
        ->default_str("off");
    add_on_off_option(app, "--game-pad", "Game pads rumble with what is touched",
                      given.of(&Settings::game_pad))
        ->default_str("on");
}

void add_view_options(CLI::App& app, ViewCommand& command) {
    ViewOptions& options = command.options;
    add_file_options(app, options);
    add_number_option(app, "--seconds", 0.0, kLongestRun_s,
                      "Ends the program after so many seconds",
                      [&options](double seconds) { options.seconds = seconds; })
        ->type_name("S");
    add_playing_options(app, command);
    app.add_flag("--stay", options.stays,
                 "If a file cannot be opened, says so in the window and stays open (for a start by "
                 "the desktop)");
    app.add_flag_function(
        "--no-sync", [&options](std::int64_t) { options.sync = false; },
        "Does not wait for the display");
    add_window_options(app, command);
    app.add_flag("--any-media", options.any_media,
                 "Replays a session also over files that have changed since");
    add_surfaces_option(app, options.surfaces);
    add_touch_options(app, options.touch);
    add_sure_option(app, options.must_be_sure);
    add_decoder_option(app, options.touch.decoder);
    add_in_betweens_option(app, options.touch);
    add_on_off_option(app, "--stability",
                      "on: damps as much as the device needs, and takes out the energy that "
                      "rendering creates; off: for experiments that must not have this",
                      command.settings.of(&Settings::stability))
        ->default_str("on");
    app.footer(
        "Examples:\n"
        "  dibhr                                  the built-in sample\n"
        "  dibhr color.mp4 depth.mp4 --friction 0.8\n"
        "  dibhr v4l2:/dev/video4 v4l2:/dev/video2   two cameras, colour and depth\n"
        "  dibhr udp://127.0.0.1:5000 --packing left-right   a stream of both\n"
        "  dibhr --material bark                  the sample, covered with it\n"
        "  dibhr view touch                       a file that is called like a command\n"
        "  dibhr color.mp4 --record mine.dibhr --seconds 20 --screenshot last.png\n"
        "  dibhr color.mp4 --start 12.5 --pause   one moment of it\n"
        "  dibhr mine.dibhr --algorithm pga       what was recorded, through another algorithm\n"
        "Keys: dibhr help keys");
}

/// Throws UsageError for options that conflict.
void check_options(ViewOptions& options) {
    const std::string colour = options.open.colour.string();
    std::error_code unknown;
    if (colour.find_first_of("./") == std::string::npos && !colour.empty() &&
        !fs::exists(colour, unknown) && !is_live(colour)) {
        throw UsageError("neither a command nor a file is called '" + colour + "'" +
                         command_suggestion(colour) + " (see dibhr --help)");
    }
    if (options.end_s && *options.end_s <= options.open.at_s)
        throw UsageError("--end " + short_text(*options.end_s) + " is not after --start " +
                         short_text(options.open.at_s) + ": give a later one");
    if (!options.clip.empty() && options.end_s && !options.looping) options.looping = false;
    if (is_session_file(options.open.colour)) require_replay_options(options);
}

/// The settings of the file, replaced by those of the command line.
void combine_settings(ViewCommand& command, ViewerParts& parts, MessageLog& log) {
    ViewOptions& options = command.options;
    options.in_file = options.settings = read_settings(options, parts, log);
    Settings& settings = options.settings;
    if (moves_hand(options.device)) options.unsafe_settings = Consent().replace_unsafe(settings);
    warn(warning_text(options.unsafe_settings, options.settings_file), log);
    apply_touch_options(options.touch, parts, settings, log);
    command.settings.apply(settings);
    options.size_given = command.size.has_value();
    if (command.size) std::tie(settings.width, settings.height) = *command.size;
    apply_surface_options(options.touch, settings);
    drop_changed(options.unsafe_settings, settings);  // by the command line
    apply_kiosk(options, settings);
}

/// Opens the named files beside the window, and runs the window until it is closed. An error of the
/// files or the device comes before one of the display.
void run_window(ViewCommand& command, OpeningWindow::Time begin, ShutdownWatchdog& shutdown,
                TaskGroup& tasks, MessageLog& log) {
    ViewOptions& options = command.options;
    ViewerParts parts;
    combine_settings(command, parts, log);
    options.open.request = options.touch.depth_request();
    require_writable_outputs(options);
    if (!is_session_file(options.open.colour)) use_sample_without_file(options.open);
    BackgroundTask<OpenedFiles> opening(tasks);
    opening.start([options] { return open_files(options); });
    shutdown.crash_note().set_activity("opening the window");
    std::exception_ptr no_window;
    const auto window = open_window(options, begin, no_window);
    shutdown.crash_note().set_activity("opening the files");
    auto files = wait_for_files(opening, window.get(), shutdown);
    if (!files) return;
    if (!files->doubt.empty()) log.append("warning", files->doubt);
    for (const std::string& warning : files->warnings) warn(warning, log);
    if (!files->trouble.empty()) print_error_line(files->trouble);
    parts.files = std::move(*files);
    parts.hand = make_hand_device(options.device, {options.settings.devices, options.firmware});
    if (no_window) std::rethrow_exception(no_window);
    shutdown.crash_note().set_activity("opening the window");
    Viewer viewer(options, *window, std::move(parts), shutdown, tasks, log);
    viewer.run();
}

}  // namespace

int run_view(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture) {
    const auto begin = std::chrono::steady_clock::now();
    ViewCommand command;
    ViewOptions& options = command.options;
    options.after_picture = after_picture;
    add_view_options(app, command);
    if (!parse(app, arguments)) return 0;
    options.start_given = app.get_option("--start")->count() > 0;
    check_options(options);
    CrashNote crash_note;
    const CrashHandler crash(crash_note, &Guardian::alarm);
    ShutdownWatchdog shutdown(crash_note);
    options.settings_file = whole_path(options.settings_file);
    TaskGroup tasks;
    MessageLog log(command.log_file.empty() ? fs::path() : whole_path(command.log_file), tasks);
    log.append("begin", std::string("dibhr ") + DIBHR_VERSION);
    try {
        run_window(command, begin, shutdown, tasks, log);
    } catch (const Error& error) {
        log.append("error", error.what());
        log.finish(kLogTimeout);
        if (wait_all(tasks, shutdown)) throw;
        print_error_line(error.what());
        _exit(EXIT_FAILURE);
    }
    log.finish(kLogTimeout);
    // No destructor and no exit() handler: they would free what a background task still uses. All
    // files are saved, and the device is closed.
    if (!wait_all(tasks, shutdown)) _exit(EXIT_SUCCESS);
    return 0;
}

}  // namespace dibhr
