// One table of commands; each entry parses its own options and runs.
#include "app/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string_view>
#include <system_error>

#include "app/commands/bench.hpp"
#include "app/commands/devices.hpp"
#include "app/commands/experiment.hpp"
#include "app/commands/experiment_request.hpp"
#include "app/commands/export.hpp"
#include "app/commands/info.hpp"
#include "app/commands/replay.hpp"
#include "app/commands/report.hpp"
#include "app/commands/touch.hpp"
#include "app/commands/view.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "core/files/error_line.hpp"

namespace dibhr {
namespace {

using Arguments = std::vector<std::string>;

struct Command {
    std::string_view name;
    std::string_view arguments;
    std::string_view summary;
    int (*run)(CLI::App&, const Arguments&);
};

constexpr double kLongestRun_s = 1e6;

/// False when the help was asked for, which is then printed.
bool parse(CLI::App& app, const Arguments& arguments) {
    try {
        app.parse(Arguments(arguments.rbegin(), arguments.rend()));
        return true;
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return false;
    } catch (const CLI::ParseError& error) {
        throw UsageError(std::string(error.what()) + " (see " + app.get_name() + " --help)");
    }
}

/// "1280x800" and nothing else.
std::pair<int, int> parse_size(const std::string& text) {
    std::array<int, 2> size{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t k = 0; k < size.size(); ++k) {
        const auto [stop, error] = std::from_chars(at, end, size[k]);
        const bool ends_well = k == 0 ? stop != end && *stop == 'x' : stop == end;
        if (error != std::errc{} || !ends_well) {
            throw CLI::ValidationError("--size", "'" + text + "' is not a size like 1280x800");
        }
        if (size[k] < kSmallestWindow || size[k] > kLargestWindow) {
            throw CLI::ValidationError("--size", text + " is not in " +
                                                     std::to_string(kSmallestWindow) + " to " +
                                                     std::to_string(kLargestWindow));
        }
        at = stop + 1;
    }
    return {size[0], size[1]};
}

void check_device(const std::string& device) {
    const bool is_goals = device.starts_with("goals:") && device.size() > 6;
    const bool is_chosen = device.starts_with("falcon:") && device.size() > 7;
    if (!is_goals && !is_chosen && device != "auto" && device != "falcon" && device != "mouse") {
        throw CLI::ValidationError(
            "--device",
            "'" + device + "' is none of auto, falcon, falcon:SERIAL, mouse, goals:FILE");
    }
}

/// An option, or an argument, that names a file. `file` must outlive the parsing of `app`.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& file,
                      const std::string& help, const std::string& type = "FILE") {
    return app
        .add_option_function<std::string>(
            name, [&file](const std::string& text) { file = text; }, help)
        ->type_name(type);
}

CLI::Option* add_session(CLI::App& app, std::filesystem::path& file) {
    return add_file(app, "SESSION", file, "A recorded session", "")->required();
}

void add_firmware_option(CLI::App& app, std::filesystem::path& file) {
    add_file(app, "--firmware", file,
             "Firmware for a Falcon that has none; checked, and kept for the next time");
}

int view(CLI::App& app, const Arguments& arguments) {
    ViewRequest request;
    ViewOptions& options = request.options;
    add_file(app, "COLOR", options.colour,
             "Colour video or image, or a recorded session to replay; none: the built-in sample",
             "");
    add_file(app, "DEPTH", options.depth,
             "Depth video or image; none: *color* -> *depth* beside it", "");
    app.add_option_function<std::string>(
           "--device",
           [&options](const std::string& device) {
               check_device(device);
               options.device = device;
           },
           "auto (a Falcon, and the mouse until one is there), falcon, falcon:SERIAL, mouse or "
           "goals:FILE")
        ->type_name("DEVICE")
        ->default_str("auto");
    add_firmware_option(app, options.firmware);
    add_file(app, "--record", options.record,
             "Records every tick into a new session file (.dibhr)");
    add_file(app, "--screenshot", options.screenshot, "Saves the last picture as PNG");
    app.add_option_function<std::string>(
           "--seconds",
           [&options](const std::string& text) {
               options.seconds = parse_number("--seconds", text, 0.0, kLongestRun_s);
           },
           "Leaves after so long")
        ->type_name("S");
    app.add_flag_function(
        "--no-sync", [&options](std::int64_t) { options.sync = false; },
        "Does not wait for the display");
    app.add_option_function<std::string>(
           "--size", [&request](const std::string& text) { request.size = parse_size(text); },
           "Size of the window")
        ->type_name("WxH");
    app.add_flag("--any-media", options.any_media,
                 "Replays a session also over files that have changed since");
    add_touch_options(app, request.touch);
    app.footer(
        "Examples:\n"
        "  dibhr                                  the built-in sample\n"
        "  dibhr color.mp4 depth.mp4 --friction 0.8\n"
        "  dibhr view touch                       a file that is called like a command\n"
        "  dibhr color.mp4 --record mine.dibhr --seconds 20 --screenshot last.png\n"
        "  dibhr mine.dibhr --algorithm pga       what was recorded, through another algorithm");
    if (!parse(app, arguments)) return 0;
    const std::string colour = options.colour.string();
    std::error_code unknown;
    if (colour.find_first_of("./") == std::string::npos && !colour.empty() &&
        !std::filesystem::exists(colour, unknown)) {
        throw UsageError("neither a command nor a file is called '" + colour +
                         "'; see dibhr --help");
    }
    return run_view(request);
}

int touch(CLI::App& app, const Arguments& arguments) {
    TouchOptions options;
    TouchRequest request;
    add_file(app, "--depth", options.depth, "Depth video or image")->required();
    add_file(app, "--goals", options.goals, "Goals, t,x,y,z a row: seconds and grid-space pixels",
             "GOALS.csv")
        ->required();
    add_file(app, "--out", options.out, "One row an update; - is standard output", "OUT.csv")
        ->default_str("-");
    app.add_flag("--video", options.video, "Blends the frames in time; else the first image");
    add_touch_options(app, request);
    app.footer(
        "Examples:\n"
        "  dibhr touch --depth depth.png --goals goals.csv --out touched.csv\n"
        "  dibhr touch --depth depth.mp4 --video --goals goals.csv --friction 0.2 | head");
    if (!parse(app, arguments)) return 0;
    options.bump = request.bump;
    options.raw_depth = request.raw_depth;
    request.given.apply(options.parameters);
    print_warning(roughness_warning(request.given, !options.bump.empty()));
    return run_touch(options);
}

int replay(CLI::App& app, const Arguments& arguments) {
    ReplayOptions options;
    TouchRequest request;
    add_session(app, options.session);
    add_touch_options(app, request);
    app.remove_option(app.get_option("--algorithm"));  // here it may be given several times
    add_algorithms_option(app, options.algorithms);
    add_file(app, "--csv", options.csv, "Writes the rows of one run; - is standard output");
    app.add_flag("--any-media", options.any_media,
                 "Also over a video or bump map that has changed since");
    app.footer(
        "Without --algorithm and other changes, says whether proxies and forces are those of the\n"
        "recording, bit for bit, and ends with 1 if not. What is not given is as recorded.\n\n"
        "Examples:\n"
        "  dibhr replay mine.dibhr\n"
        "  dibhr replay mine.dibhr --algorithm dibhr --algorithm pga --friction 0.2\n"
        "  dibhr replay mine.dibhr --stiffness 1 --csv stiffer.csv");
    if (!parse(app, arguments)) return 0;
    options.given = request.given;
    options.bump = request.bump;
    options.raw_depth = request.raw_depth;
    return run_replay(options);
}

int export_session(CLI::App& app, const Arguments& arguments) {
    ExportOptions options;
    add_session(app, options.session);
    add_file(app, "--csv", options.csv, "One row a tick; - is standard output")->required();
    app.footer(
        "The columns of `dibhr touch` come first; table tick_column of the session explains all.\n"
        "\nExamples:\n"
        "  dibhr export mine.dibhr --csv mine.csv\n"
        "  dibhr export mine.dibhr --csv - | head");
    if (!parse(app, arguments)) return 0;
    return run_export(options);
}

int info(CLI::App& app, const Arguments& arguments) {
    std::vector<std::string> files;
    app.add_option("FILE", files, "Videos, images and session files")->type_name("")->required();
    app.footer("Example:\n  dibhr info color.mp4 depth.mp4 mine.dibhr");
    if (!parse(app, arguments)) return 0;
    return run_info({files.begin(), files.end()});
}

int devices(CLI::App& app, const Arguments& arguments) {
    DevicesRequest request;
    add_firmware_option(app, request.firmware);
    auto* const check = app.add_flag("--check", request.check,
                                     "Leads you through everything that is to be measured on a "
                                     "Falcon, with force only where it says so");
    add_file(app, "--out", request.out, "With --check: the record of what was measured")
        ->default_str("falcon-check-SERIAL-DATE.json")
        ->needs(check);
    app.footer(
        "Ends with 0 when a Falcon can be used, or none is attached and the mouse can be; with 1 "
        "when none of the attached Falcons can be used.\n\nExamples:\n"
        "  dibhr devices\n"
        "  dibhr devices --firmware nvent_firmware.bin\n"
        "  dibhr devices --check");
    if (!parse(app, arguments)) return 0;
    return run_devices(request);
}

int bench(CLI::App& app, const Arguments& arguments) {
    BenchOptions options;
    add_file(app, "--json", options.json, "Writes the numbers as JSON; - is standard output");
    if (!parse(app, arguments)) return 0;
    return run_bench(options);
}

int report(CLI::App& app, const Arguments& arguments) {
    ReportOptions options;
    add_session(app, options.session);
    add_file(app, "--out", options.out, "Folder for report.html, report.json and the pictures",
             "DIR")
        ->required();
    app.footer(
        "The folder is made if it is missing; an earlier report in it is replaced.\n\n"
        "Example:\n"
        "  dibhr report mine.dibhr --out mine-report");
    if (!parse(app, arguments)) return 0;
    return run_report(options);
}

int experiment(CLI::App& app, const Arguments& arguments) {
    ExperimentRequest request;
    add_experiment_options(app, request);
    if (!parse(app, arguments)) return 0;
    return run_experiment(experiment_options(request));
}

constexpr std::array kCommands{
    Command{"view", "[COLOR [DEPTH] | SESSION]", "The viewer; without files, the built-in sample",
            view},
    Command{"touch", "--depth FILE --goals GOALS.csv [--out OUT.csv]",
            "The core alone, head-less, over a stream of goals", touch},
    Command{"experiment", "[linear|circle|human|all|sweep]",
            "The paper's table, all algorithms side by side", experiment},
    Command{"replay", "SESSION [--algorithm NAME]... [--csv FILE]",
            "A recorded exploration through other algorithms", replay},
    Command{"export", "SESSION --csv FILE", "Every tick of a session, one row", export_session},
    Command{"report", "SESSION --out DIR", "Pictures: where people touched, force over time",
            report},
    Command{"info", "FILE...", "What a media or session file holds", info},
    Command{"devices", "[--firmware FILE] [--check [--out FILE]]",
            "What is attached, its state and the next step", devices},
    Command{"bench", "[--json FILE]", "Updates, frame hand-over and loop timing on this machine",
            bench},
};

void print_help() {
    std::cout << "Touch recorded 3D video: colour and depth shown as a moving relief that a hand "
                 "feels.\n\nUsage:\n";
    for (const Command& command : kCommands) {
        constexpr int kUsageWidth = 58;
        const std::string name = command.name == "view" ? "[view]" : std::string(command.name);
        std::cout << "  dibhr " << std::left << std::setw(kUsageWidth)
                  << name + ' ' + std::string(command.arguments) << command.summary << '\n';
    }
    std::cout
        << "\n  dibhr COMMAND --help   the options of a command\n"
           "  dibhr --version        the version\n"
           "\nExamples:\n"
           "  dibhr                                the built-in sample, touched by the mouse\n"
           "  dibhr color.mp4 depth.mp4            a colour and a depth video\n"
           "  dibhr color.mp4                      the depth video beside it is found\n"
           "  dibhr mine.dibhr                     a recorded session moves by itself\n"
           "  dibhr touch --depth depth.png --goals goals.csv --out touched.csv\n"
           "\nEnds with 0 on success, 1 on a failure it explains, 2 on bad usage.\n";
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first == "--help" || first == "-h") {
        print_help();
        return 0;
    }
    if (first == "--version") {
        std::cout << "dibhr " << DIBHR_VERSION << '\n';
        return 0;
    }
    // What is no command is what the viewer, the first of the table, is to show.
    const auto named =
        std::find_if(kCommands.begin(), kCommands.end(),
                     [&first](const Command& command) { return command.name == first; });
    const bool is_named = named != kCommands.end();
    const Command& command = is_named ? *named : kCommands.front();
    CLI::App app(std::string(command.summary), "dibhr " + std::string(command.name));
    return command.run(app, Arguments(arguments.begin() + (is_named ? 1 : 0), arguments.end()));
}

}  // namespace dibhr
