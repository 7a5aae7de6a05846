// `dibhr touch`: reads, computes and formats block by block, so that times include nothing else and
// memory does not grow with the goals.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/goal_run.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/playing/depth_timeline.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {
namespace {

constexpr std::size_t kBlockRows = 4096;

struct TouchOptions {
    std::filesystem::path depth{};
    std::filesystem::path colour{};  ///< for what moves; empty: none
    std::filesystem::path goals{};
    std::filesystem::path out{"-"};  ///< "-": standard output
    bool video{false};               ///< frames blended in time; false: the first image
    bool must_be_sure{false};        ///< --sure
    TouchRequest touch{};
    TouchParameters parameters{};
};

GoalRun opened_run(const TouchOptions& options) {
    TouchParameters parameters = options.parameters;
    const DepthRequest request = options.touch.depth_request();
    std::unique_ptr<Media> media;
    {
        const WorkingLine line("Opening " + one_line(options.depth.string()));
        media = options.colour.empty() ? open_depth(options.depth, request)
                                       : open_media(options.colour, options.depth, request);
    }
    print_warning(media->description().notice);
    report_doubt(media->description(), options.must_be_sure);
    const MotionRequest motion =
        motion_request(parameters.carry, options.touch.in_betweens.value_or(InBetweens::automatic));
    if (options.video && motion.any()) print_warning(motion_trouble(media->description()));
    options.touch.given.fit(media->description(), options.touch.raw_depth, parameters);
    const CleaningOptions cleaning = options.touch.cleaning(parameters, media->description());
    if (cleaning.preset == CleaningPreset::own && cleaning.own.colour_edges &&
        options.colour.empty())
        print_warning(shown(options.depth) +
                      " asks for silhouettes at the colour's edges, but touch looks at no "
                      "colour without --color: its silhouettes are those of the depth alone");
    const bool densifies =
        plan_of(cleaning, {}, 0, media->description().sparse_share.has_value()).steps.densify;
    if (densifies && options.colour.empty())
        print_warning(shown(options.depth) +
                      " is sparse, and touch looks at no colour without --color: its edges are "
                      "those of the depth alone");
    std::shared_ptr<const TouchMaps> maps = options.touch.read_maps(media->description());
    using Wanted = DepthTimeline::Wanted;
    return {std::make_unique<DepthTimeline>(std::move(media),
                                            options.video ? Wanted::all : Wanted::first, cleaning,
                                            motion, std::move(maps)),
            parameters, options.touch.given.read_bumps()};
}

void touch_all(const TouchOptions& options) {
    GoalReader reader(options.goals);
    std::vector<TimedGoal> goals;
    reader.next(kBlockRows, goals);  // first: most faults of the file are reported at once
    GoalRun run = opened_run(options);
    RowFile out(options.out,
                {options.depth, options.colour, options.goals, options.touch.given.bump_file()},
                "is also read by this command; give --out another name");
    std::vector<OutputRow> rows;
    rows.reserve(kBlockRows);
    out.text() = kOutputHeader;
    std::size_t updates = 0;
    std::size_t bounds_met = 0;
    {
        ProgressBar bar("Touching");
        do {
            rows.clear();
            for (const TimedGoal& goal : goals) {
                const Touch& touch = run.update(goal.t_s, goal.goal_in_grid);
                rows.push_back({goal.t_s, touch, run.update_time().count()});
            }
            updates += rows.size();
            for (const OutputRow& row : rows) {
                append_row(out.text(), row);
                if (row.touch.proxy.bound_met) ++bounds_met;
            }
            out.rows_done();
            bar.show(reader.share_read(), std::to_string(updates) + " updates");
        } while (reader.next(kBlockRows, goals));
        out.commit();
    }
    print_warning(run.trouble());
    if (bounds_met > 0) print_error_line(bounds_met_text(bounds_met, updates));
}

/// Warns of switches that need a moving video, where the media is a still picture.
void warn_of_motion(const TouchOptions& options) {
    const auto warn = [](std::string_view name) {
        print_warning("--" + std::string(name) +
                      " on changes nothing on a still picture; give --video");
    };
    for (const TouchSwitch& entry : touch_switches())
        if (entry.needs_motion && entry.of(options.parameters)) warn(entry.name);
    if (options.touch.in_betweens == InBetweens::on) warn("in-betweens");
}

}  // namespace

int run_touch(CLI::App& app, const Arguments& arguments) {
    TouchOptions options;
    add_file(app, "--depth", options.depth, "Depth video or image")->required();
    add_file(app, "--goals", options.goals, "Goals, t,x,y,z a row: seconds and grid-space pixels",
             "GOALS.csv")
        ->required();
    add_file(app, "--out", options.out, "One row for each update; - is standard output", "OUT.csv")
        ->default_str("-");
    app.add_flag(
        "--video", options.video,
        "Touches the whole video, its frames blended in time; without this option the first image");
    add_file(app, "--color", options.colour,
             "Colour of the same view: touch finds in it what moves, and where silhouettes are",
             "FILE");
    add_touch_options(app, options.touch);
    add_sure_option(app, options.must_be_sure);
    add_decoder_option(app, options.touch.decoder);
    add_in_betweens_option(app, options.touch);
    app.footer(
        "Examples:\n"
        "  dibhr touch --depth depth.png --goals goals.csv --out touched.csv\n"
        "  dibhr touch --depth depth.mp4 --video --goals goals.csv --friction 0.2 | head\n"
        "  dibhr touch --depth depth.mp4 --video --color color.mp4 --carry on --goals goals.csv");
    if (!parse(app, arguments)) return 0;
    options.touch.given.apply(options.parameters);
    if (!options.video) warn_of_motion(options);
    print_warning(roughness_warning(options.touch.given, !options.touch.given.bump_file().empty()));
    touch_all(options);
    return 0;
}

}  // namespace dibhr
