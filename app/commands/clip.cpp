// `dibhr clip`: a clip that is drawn off line, every picture of it, however long that takes.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/given_media.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "app/viewer/input.hpp"
#include "app/viewer/offline_clip.hpp"
#include "app/window/signals.hpp"
#include "core/clip/clip_file.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/playing/transport.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

constexpr double kLongest_s = 1e6;
constexpr double kMostPicturesPerS = 240.0;

struct ClipOptions {
    fs::path colour{};  ///< or a session
    fs::path depth{};   ///< empty: found beside the colour file
    fs::path goals{};   ///< empty: nobody touches
    fs::path out{};
    std::optional<std::pair<int, int>> size{};
    double pictures_per_s{30.0};
    double start_s{0.0};
    std::optional<double> end_s{};
    double speed{1.0};
    ClipLook look{};
    bool any_media{false};
    SurfacesFrom surfaces{SurfacesFrom::automatic};
    bool must_be_sure{false};
    TouchRequest touch{};
};

/// What a clip is drawn of.
struct ClipScene {
    std::unique_ptr<ClipMotion> motion{};
    int columns{0}, rows{0};  ///< of the depth
    double end_s{0.0};        ///< of the motion; 0: a still picture that nobody touches
    std::vector<fs::path> files{};
};

void require_session_options(const ClipOptions& options) {
    const TouchRequest& touch = options.touch;
    if (options.depth.empty() && options.goals.empty() && !touch.changes_surface() &&
        touch.depth == DepthStatement{})
        return;
    throw UsageError(options.colour.string() +
                     " is a session, whose hand and surface are as recorded: leave out a depth "
                     "file, --goals, --material, --bump, --maps, --raw-depth, --cleaning, "
                     "--finger, --in-betweens and the options that say what depth means");
}

ClipScene open_session(const ClipOptions& options) {
    require_session_options(options);
    std::unique_ptr<OpenedSession> opened;
    {
        const WorkingLine line("Opening " + one_line(options.colour.string()));
        opened =
            std::make_unique<OpenedSession>(options.colour, options.any_media, options.surfaces);
    }
    print_warning(opened->session.warning());
    print_warning(opened->frames.warning);
    auto motion =
        std::make_unique<SessionMotion>(std::move(opened), options.touch.given, options.start_s);
    const MediaDescription& media = motion->description();
    ClipScene scene{.columns = media.depth_columns,
                    .rows = media.depth_rows,
                    .end_s = motion->duration_s(),
                    .files = {options.colour, media.colour_path, media.depth_path}};
    scene.motion = std::move(motion);
    return scene;
}

ClipScene open_recording(const ClipOptions& options) {
    std::vector<TimedGoal> goals;  // first: most faults of the file are reported at once
    if (!options.goals.empty()) goals = read_goals(options.goals);
    TouchParameters parameters;
    options.touch.given.apply(parameters);
    auto media = open_given(options.colour, options.depth, options.touch, options.must_be_sure,
                            true, parameters);
    const MediaDescription description = media->description();
    if (description.live)
        throw InputError(options.colour.string() +
                         " is live: record it, and give the recording in its place");
    const MotionRequest moving =
        motion_request(parameters.carry, options.touch.in_betweens.value_or(InBetweens::automatic));
    if (moving.any()) print_warning(motion_trouble(description));
    auto timeline = std::make_unique<DepthTimeline>(std::move(media), DepthTimeline::Wanted::all,
                                                    options.touch.cleaning(parameters, description),
                                                    moving, options.touch.read_maps(description));
    auto motion = std::make_unique<GoalMotion>(std::move(timeline), parameters,
                                               options.touch.given.read_bumps(), std::move(goals));
    const double end_s = options.goals.empty() ? description.duration_s : motion->goals_end_s();
    ClipScene scene{.columns = description.depth_columns,
                    .rows = description.depth_rows,
                    .end_s = end_s,
                    .files = {description.colour_path, description.depth_path, options.goals,
                              options.touch.given.bump_file()}};
    scene.motion = std::move(motion);
    return scene;
}

/// The number of pictures until the clip's end.
std::int64_t count_pictures(const ClipOptions& options, const ClipScene& scene) {
    constexpr double kRoundOff = 1e-6;  // of a picture
    const double end_s = options.end_s.value_or(scene.end_s);
    const double step_s = options.speed / options.pictures_per_s;
    const double pictures = std::ceil((end_s - options.start_s) / step_s - kRoundOff);
    if (pictures >= 1.0) return static_cast<std::int64_t>(pictures);
    if (!(scene.end_s > 0.0))
        throw InputError(options.colour.string() +
                         " is a still picture: say with --end S how long the clip shows it, or "
                         "give --goals");
    throw InputError(options.colour.string() + " lasts " + short_text(scene.end_s) +
                     " s: give --start less than that, or a later --end");
}

/// False: Ctrl+C came, and nothing was written.
bool draw_clip(const ClipOptions& options, ClipScene& scene, std::int64_t pictures) {
    ShutdownSignals signals;
    ClipPainter painter(options.look, scene.columns, scene.rows,
                        scene.motion->parameters().shape.relief_px);
    ClipFile file(options.out, ClipNameConflict::replaces);
    ProgressBar bar("Drawing " + one_line(options.out.filename().string()));
    for (std::int64_t k = 0; k < pictures; ++k) {
        const double shown_s = static_cast<double>(k) / options.pictures_per_s;
        scene.motion->advance_to(options.start_s + shown_s * options.speed);
        file.add(painter.picture(*scene.motion, shown_s), shown_s);
        if (signals.arrived()) return false;
        bar.show(static_cast<double>(k + 1) / static_cast<double>(pictures),
                 std::to_string(k + 1) + " of " + std::to_string(pictures) + " pictures");
    }
    file.finish(static_cast<double>(pictures) / options.pictures_per_s, ClipEnd::indexed);
    return true;
}

int make_clip(const ClipOptions& options) {
    if (options.out == "-" || fs::is_directory(options.out))
        throw UsageError("a clip cannot be written to " + options.out.string() +
                         ": give --out the name of a file");
    ClipScene scene =
        is_session_file(options.colour) ? open_session(options) : open_recording(options);
    refuse_overwriting(options.out, scene.files,
                       "is also read by this command; give --out another name");
    const std::int64_t pictures = count_pictures(options, scene);
    const bool whole = draw_clip(options, scene, pictures);
    print_warning(scene.motion->trouble());
    if (!whole) {
        print_error_line("cancelled: " + options.out.string() + " was not written");
        return kInterrupted;
    }
    std::cout << one_line(options.out.string()) << ": " << pictures
              << (pictures == 1 ? " picture of " : " pictures of ")
              << size_text(options.look.size_px.x, options.look.size_px.y) << ", "
              << short_text(static_cast<double>(pictures) / options.pictures_per_s) << " s\n";
    return 0;
}

void add_look_options(CLI::App& app, ClipOptions& options) {
    add_size_option(app, options.size, "Size of the pictures")->default_str("1280x800");
    add_number_option(app, "--fps", 0.1, kMostPicturesPerS, "Pictures a second",
                      [&options](double rate) { options.pictures_per_s = rate; })
        ->type_name("N")
        ->default_str("30");
    app.add_option_function<std::string>(
           "--view",
           [&look = options.look](const std::string& text) {
               look.straight = text == "straight";
               if (look.straight) return;
               look.view = view_in(text);
               if (!look.view)
                   throw CLI::ValidationError(
                       "--view",
                       in_quotes(text) + " is neither straight nor a view that the window copied");
           },
           "straight: as the recording camera saw it; or a view that was copied in the window; "
           "without this option the whole relief from the side")
        ->type_name("VIEW");
    add_words_option<Theme>(app, "--theme", "Colour of the wall behind the relief",
                            [&options](Theme theme) { options.look.theme = theme; });
}

void add_time_options(CLI::App& app, ClipOptions& options) {
    add_number_option(app, "--start", 0.0, kLongest_s,
                      "Begins so many seconds after the start; what moves before is computed, too",
                      [&options](double seconds) { options.start_s = seconds; })
        ->type_name("S")
        ->default_str("0");
    add_number_option(app, "--end", 0.0, kLongest_s,
                      "Ends so many seconds after the start; without this option with the goals, "
                      "the session or the video, of which goals and video repeat",
                      [&options](double seconds) { options.end_s = seconds; })
        ->type_name("S");
    add_speed_option(app, [&options](double speed) { options.speed = speed; });
}

}  // namespace

int run_clip(CLI::App& app, const Arguments& arguments) {
    ClipOptions options;
    add_file(app, "COLOR", options.colour,
             "Colour video, image or folder, depth alone, or a recorded session", "")
        ->required();
    add_file(app, "DEPTH", options.depth, "Depth video, image or folder; else found beside COLOR",
             "");
    add_file(app, "--goals", options.goals,
             "The hand's goals, t,x,y,z a row: seconds and grid-space pixels; an update a row, as "
             "touch has it. A session brings its own hand",
             "GOALS.csv");
    add_file(app, "--out", options.out, "The clip, as MP4")->required();
    add_look_options(app, options);
    add_time_options(app, options);
    app.add_flag("--any-media", options.any_media,
                 "Draws a session also over files that have changed since");
    add_surfaces_option(app, options.surfaces);
    add_touch_options(app, options.touch);
    add_sure_option(app, options.must_be_sure);
    add_in_betweens_option(app, options.touch);
    app.footer(
        "Every picture is drawn, however long it takes, so that a slow machine makes the same clip "
        "as a quick one. Needs a display, real or virtual (xvfb-run).\n\n"
        "Examples:\n"
        "  dibhr clip mine.dibhr --out mine.mp4\n"
        "  dibhr clip mine.dibhr --algorithm pga --start 10 --end 20 --fps 60 --out pga.mp4\n"
        "  dibhr clip color.mp4 depth.mp4 --goals goals.csv --size 1920x1080 --out touched.mp4");
    if (!parse(app, arguments)) return 0;
    if (options.end_s && *options.end_s <= options.start_s)
        throw UsageError("--end " + short_text(*options.end_s) + " is not after --start " +
                         short_text(options.start_s) + ": give a later one");
    if (options.size) options.look.size_px = {options.size->first, options.size->second};
    if (options.touch.given.material) options.look.surface = options.touch.given.material->look;
    print_warning(roughness_warning(options.touch.given, !options.touch.given.bump_file().empty()));
    return make_clip(options);
}

}  // namespace dibhr
