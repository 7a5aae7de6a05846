// `dibhr replay`: all runs side by side, in one pass over the session and its video.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "app/commands/batch/session_batch.hpp"
#include "app/commands/batch/stoppable_work.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/frames.hpp"
#include "core/replay/session_replay.hpp"
#include "core/video/formats/libraries.hpp"

namespace dibhr {

namespace {

constexpr std::int64_t kTicksPerStep = 1000;  // of the progress bar

struct ReplayOptions {
    std::vector<Algorithm> algorithms{};  ///< empty: as recorded
    TouchRequest touch{};                 ///< replaces recorded values
    bool any_media{false};                ///< also over files that have changed
    SurfacesFrom surfaces{SurfacesFrom::automatic};
    std::filesystem::path csv{};  ///< rows of the one run, "-": standard output; or empty
};

struct Run {
    std::string name{};
    ParameterChange change{};
    bool as_recorded{true};  ///< nothing was changed: the bits must be the same
    RunComparison comparison{};
};

/// Refuses options that would contradict the session's own depth meaning, relief and pitch.
void refuse_depth_options(const TouchRequest& touch) {
    if (touch.depth != DepthStatement{})
        throw UsageError(
            "a session is replayed with the meaning that its depth had when it was recorded: leave "
            "out --near, --depth-unit and the other options that say what depth means");
    if (touch.given.fit_relief || touch.given.fit_pitch)
        throw UsageError(
            "a session has its own relief and pitch: give --relief or --pixel-pitch a number "
            "instead of auto, or leave the option out");
}

Run make_run(const Session& session, const ReplayOptions& options,
             std::optional<Algorithm> algorithm) {
    Run run;
    run.change = [given = options.touch.given, algorithm](TouchParameters& parameters) {
        if (algorithm) parameters.algorithm = *algorithm;
        given.apply(parameters);
    };
    run.name = algorithm ? name_of(*algorithm) : "";
    run.as_recorded = !options.touch.changes_surface();
    for (const SessionParameters& recorded : session.parameters()) {
        TouchParameters changed = recorded.touch;
        run.change(changed);
        if (!(changed == recorded.touch)) run.as_recorded = false;
        // Without an algorithm of its own, the run is named after those of the recording.
        const std::string name = name_of(recorded.touch.algorithm);
        if (!algorithm && run.name.find(name) == std::string::npos)
            run.name += (run.name.empty() ? "" : "+") + name;
    }
    if (run.as_recorded) run.change = nullptr;  // ranges do not touch what was recorded
    return run;
}

std::vector<Run> make_runs(const Session& session, const ReplayOptions& options) {
    std::vector<Run> runs;
    for (const Algorithm algorithm : options.algorithms)
        runs.push_back(make_run(session, options, algorithm));
    if (runs.empty()) runs.push_back(make_run(session, options, std::nullopt));
    return runs;
}

bool has_bump(const Session& session, const ReplayOptions& options) {
    const auto has_file = [](const SessionParameters& parameters) {
        return !parameters.bump.file.empty();
    };
    return !options.touch.given.bump_file().empty() ||
           std::ranges::any_of(session.parameters(), has_file);
}

SessionFramesOptions frames_options(const Session& session, const ReplayOptions& options) {
    const TouchRequest& touch = options.touch;
    // The ball has one size in a run: from the first pitch and relief.
    TouchParameters parameters;
    if (!session.parameters().empty()) parameters = session.parameters().front().touch;
    touch.given.apply(parameters);
    TouchParameters requested;  // by the command line alone
    for (const auto& [entry, on] : touch.given.switches) entry->in(requested) = on;
    const CleaningOptions requested_cleaning = touch.cleaning(parameters);
    SessionFramesOptions frames{.any_media = options.any_media,
                                .motion = requested.carry,
                                .materials = {.bump = touch.given.bump_file(),
                                              .bump_size_px = parameters.shape.bump_size_px,
                                              .maps = touch.uses_maps()}};
    if (touch.raw_depth || touch.preset) frames.cleaning = requested_cleaning.preset;
    if (touch.finger_mm) frames.finger = requested_cleaning.finger;
    return frames;
}

void replay(const Session& session, RecordedSurfaces& surfaces, std::vector<Run>& runs,
            const std::filesystem::path& csv, const WorkProgress& progress) {
    std::vector<ParameterChange> changes;
    for (const Run& run : runs) changes.push_back(run.change);
    SessionReplay replay(session, surfaces, std::move(changes));
    RowFile rows(csv, {session.file()}, "is the session that is read; give --csv another name");
    rows.text() = kOutputHeader;
    for (std::int64_t done = 0; replay.next(); ++done) {
        const TickRecord& tick = replay.recorded();
        for (std::size_t k = 0; k < runs.size(); ++k)
            runs[k].comparison.add(tick, replay.touch(k), replay.update_us(k),
                                   replay.left_known(k));
        if (rows.has_target()) {
            append_row(rows.text(), {tick.t_s, replay.touch(0),
                                     static_cast<std::int64_t>(replay.update_us(0) * 1e3)});
            rows.rows_done();
        }
        if (done % kTicksPerStep == 0)
            progress(static_cast<double>(done) / static_cast<double>(session.rows()));
    }
    rows.commit();
}

/// "pga: 12 of 5000 updates (0.24 %) may have left what the session stores ...".
std::string left_text(const Run& run) {
    const std::size_t left = run.comparison.left_known();
    const std::size_t updates = std::max<std::size_t>(run.comparison.updates(), 1);
    const double share = 100.0 * static_cast<double>(left) / static_cast<double>(updates);
    std::ostringstream text;
    text << run.name << ": ";
    if (left == 0) {
        text << "no update";
    } else {
        text << left << " of " << updates << " updates (" << number_text(share, 2) << " %)";
    }
    text << " left the surface that the session holds";
    return text.str() + (left == 0 ? "" : "; beyond it the surface is at its lowest level");
}

void print_table(const Session& session, const std::vector<Run>& runs, bool stored) {
    std::cout << session.file().string() << ": " << session.rows() << " ticks in " << std::fixed
              << std::setprecision(3) << session.end_s() - session.begin_s() << " s\n"
              << comparison_heading();
    for (const Run& run : runs) std::cout << run.comparison.table_row(run.name);
    std::cout << "  force turn: how far the force turns from update to update; off: how far from "
                 "the recorded proxy and force;\n  contact: share of all ticks\n";
    for (const Run& run : runs) {
        const std::size_t bounds_met = run.comparison.bounds_met();
        if (bounds_met == 0) continue;
        std::cout << run.name << ": " << bounds_met_text(bounds_met, run.comparison.updates())
                  << '\n';
    }
    if (stored)
        for (const Run& run : runs) std::cout << left_text(run) << '\n';
    for (const Run& run : runs) {
        if (run.as_recorded && !run.comparison.first_difference()) {
            std::cout << run.name << ", as recorded: all " << session.rows()
                      << " proxies and forces are identical, bit for bit\n";
        }
    }
}

std::string text_of(Vec3 v) {
    return '(' + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + ')';
}

/// "; it was recorded with libavcodec 59.37.100, this is 61.3.100": libraries that may decode other
/// depth levels. Empty: no known difference.
std::string library_changes(const Session& session) {
    std::string text;
    for (const auto& [library, version] : library_versions()) {
        const std::string recorded = session.fact(library);
        if (recorded.empty() || recorded == version) continue;
        text.append(text.empty() ? "; it was recorded with " : "; with ").append(library);
        text.append(" ").append(recorded).append(", this is ").append(version);
    }
    return text;
}

std::string difference_of(const Session& session, const Run& run) {
    const auto& [recorded, touch] = *run.comparison.first_difference();
    std::ostringstream text;
    text << session.file().string() << ": " << run.name << " differs from the recording in "
         << run.comparison.differing() << " of " << session.rows() << " ticks, first in tick "
         << session.count_of(recorded.tick) << " at " << recorded.t_s - session.begin_s()
         << " s: proxy " << text_of(touch.proxy.position) << " instead of "
         << text_of(recorded.proxy) << ", force sent " << text_of(touch.sent_force_newton)
         << " instead of " << text_of(recorded.sent_newton);
    if (session.missing() > 0)
        text << "; " << session.missing()
             << " ticks are missing in it, so that it cannot be "
                "replayed exactly";
    text << library_changes(session);
    return text.str();
}

/// A session that was replayed.
struct Replayed {
    explicit Replayed(const std::filesystem::path& file) : session(file) {}

    Session session;
    std::vector<Run> runs{};
    bool stored{false};                      ///< from the surface in the session
    std::vector<std::string> differences{};  ///< of runs as recorded
};

/// Opens the session; its runs are yet to be computed.
std::unique_ptr<Replayed> opened(const std::filesystem::path& file, const ReplayOptions& options) {
    auto replayed = std::make_unique<Replayed>(file);
    replayed->session.rescue_if_damaged();
    if (replayed->session.rows() == 0)
        throw InputError(file.string() + ": holds no tick to replay; record a longer one");
    replayed->runs = make_runs(replayed->session, options);
    return replayed;
}

/// `warn`: called with sentences before it begins; some are empty.
void compute(Replayed& replayed, const ReplayOptions& options,
             const std::function<void(const std::string&)>& warn, const WorkProgress& progress) {
    const Session& session = replayed.session;
    warn(session.warning());
    const SessionSurfaces from =
        open_surfaces(session, frames_options(session, options), options.surfaces);
    replayed.stored = from.stored;
    warn(from.warning);
    warn(roughness_warning(options.touch.given, has_bump(session, options)));
    replay(session, *from.surfaces, replayed.runs, options.csv, progress);
    for (const Run& run : replayed.runs)
        if (run.as_recorded && run.comparison.first_difference())
            replayed.differences.push_back(difference_of(session, run));
}

int replay_one(const std::filesystem::path& file, const ReplayOptions& options) {
    const std::unique_ptr<Replayed> replayed = opened(file, options);
    {
        StoppableWork work("Replaying", options.csv.empty() ? file : options.csv);
        compute(*replayed, options, print_warning, [&work](double share) { work.show(share); });
    }
    if (options.csv != "-") print_table(replayed->session, replayed->runs, replayed->stored);
    std::cout.flush();
    for (const std::string& difference : replayed->differences) print_error_line(difference);
    return replayed->differences.empty() ? 0 : 1;
}

/// Of each run the numbers that are the same whenever and wherever it is computed.
SessionWork replay_in_batch(const GivenFile& file, const ReplayOptions& options,
                            const WorkProgress& progress) {
    const std::unique_ptr<Replayed> replayed = opened(file.file, options);
    SessionWork done = summary_of(replayed->session);
    compute(
        *replayed, options,
        [&done](const std::string& warning) { done.warnings.push_back(warning); }, progress);
    done.failures = replayed->differences;
    for (std::size_t k = 0; k < replayed->runs.size(); ++k) {
        const RunComparison& run = replayed->runs[k].comparison;
        const std::string name =
            options.algorithms.empty() ? "recorded" : name_of(options.algorithms[k]);
        done.cells.push_back({name + "_differs", std::to_string(run.differing()), true});
        done.cells.push_back({name + "_updates", std::to_string(run.updates())});
        done.cells.push_back({name + "_left", std::to_string(run.left_known())});
        done.cells.push_back({name + "_not_caught_up", std::to_string(run.bounds_met())});
        for (const auto& [quantity, value] : run.numbers())
            done.cells.push_back({name + '_' + quantity, number_text(value)});
    }
    done.cells.push_back({"surface_from", replayed->stored ? "session" : "video"});
    return done;
}

}  // namespace

int run_replay(CLI::App& app, const Arguments& arguments) {
    ReplayOptions options;
    BatchOptions batch;
    add_sessions(app, batch,
                 "Folder that keeps each session's numbers, and replay.csv, their summary");
    add_algorithms_option(app, options.algorithms);
    add_touch_options(app, options.touch, "as recorded");
    add_file(app, "--csv", options.csv,
             "Writes the rows of one run of one session; - is standard output");
    app.add_flag("--any-media", options.any_media,
                 "Replays also if the video or the bump map has changed since the recording");
    add_surfaces_option(app, options.surfaces);
    app.footer(
        "Without --algorithm and other changes, says whether proxies and forces are those of the\n"
        "recording, bit for bit, and ends with 1 if not. What is not given is as recorded.\n\n"
        "Examples:\n"
        "  dibhr replay mine.dibhr\n"
        "  dibhr replay mine.dibhr --algorithm dibhr --algorithm pga --friction 0.2\n"
        "  dibhr replay mine.dibhr --stiffness 1 --csv stiffer.csv\n"
        "  dibhr replay recordings --algorithm pga --out replays");
    if (!parse(app, arguments)) return 0;
    if (!options.csv.empty() && options.algorithms.size() > 1)
        throw UsageError("--csv writes the rows of one run: give one --algorithm with it");
    if (!options.csv.empty() && batch.is_batch())
        throw UsageError("--csv writes the rows of one session: give one, and no --out with it");
    refuse_depth_options(options.touch);
    if (!batch.is_batch()) return replay_one(batch.file(), options);
    return run_batch(app,
                     {.command = "replay",
                      .title = "Replaying",
                      .work =
                          [&options](const GivenFile& file, const auto& /*folder*/,
                                     const WorkProgress& progress) {
                              return replay_in_batch(file, options, progress);
                          }},
                     batch);
}

}  // namespace dibhr
