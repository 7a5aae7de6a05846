// The table of commands. A word that is no command is a file for the viewer.
#include "app/commands/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string_view>
#include <system_error>

#include "app/commands/documentation.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/files/terminal.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/video/frames/frame_window.hpp"
#include "device/hand_device.hpp"

namespace dibhr {
namespace {

struct Command {
    std::string_view name;
    std::string_view arguments;
    std::string_view summary;
    int (*run)(CLI::App&, const Arguments&, const PictureHook&);
};

/// A command that opens no window.
template <int (*run)(CLI::App&, const Arguments&)>
int headless(CLI::App& app, const Arguments& arguments, const PictureHook& /*after_picture*/) {
    return run(app, arguments);
}

constexpr std::array kCommands{
    Command{"view", "[COLOR [DEPTH] | SESSION]", "The viewer; without files, the built-in sample",
            run_view},
    Command{"touch", "--depth FILE --goals GOALS.csv [--out OUT.csv]",
            "The core alone, head-less, over a stream of goals", headless<run_touch>},
    Command{"surface", "COLOR [DEPTH] [--time S] --out FILE",
            "The surface as it is felt: .pfm (px), .png (16 bit), .ply or .stl (mm)",
            headless<run_surface>},
    Command{"clip", "COLOR|SESSION [--goals GOALS.csv] --out FILE",
            "A clip whose every picture is drawn, however long it takes", headless<run_clip>},
    Command{"prepare", "RECORDING... [--list] [--empty]",
            "Cleans once, off line, and keeps it for playing at full rate", headless<run_prepare>},
    Command{"depth", "COLOR [--with \"COMMAND {input} {output}\"]",
            "Depth for a colour video, by an estimator you have installed", headless<run_depth>},
    Command{"experiment", "[linear|circle|human|all|sweep]",
            "The paper's table, all algorithms side by side", headless<run_experiment>},
    Command{"replay", "SESSION... [--algorithm NAME]... [--csv FILE]",
            "A recording computed again with other algorithms", headless<run_replay>},
    Command{"export", "SESSION... --csv FILE|--out DIR", "Every tick of a session, one row",
            headless<run_export>},
    Command{"report", "SESSION... --out DIR", "Pictures: where people touched, force over time",
            headless<run_report>},
    Command{"archive", "SESSION|STUDY... --out FOLDER",
            "A folder to publish: data, dictionary, sums", headless<run_archive>},
    Command{"study", "check|plan|run|report|sessions PROTOCOL|FILE...",
            "Do people feel a difference? Conditions, trials, answers, statistics", run_study},
    Command{"info", "FILE...", "What a media or session file holds", headless<run_info>},
    Command{"devices", "[--check] [--simulate DEVICE]",
            "What is attached, its state and the next step", headless<run_devices>},
    Command{"bench", "[--json FILE]", "Updates, frame hand-over and loop timing on this machine",
            headless<run_bench>},
};

/// "1280x800" and nothing else.
std::pair<int, int> parse_size(const std::string& text) {
    std::array<int, 2> size{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t k = 0; k < size.size(); ++k) {
        const auto [stop, error] = std::from_chars(at, end, size[k]);
        const bool ends_well = k == 0 ? stop != end && *stop == 'x' : stop == end;
        if (error != std::errc{} || !ends_well)
            throw CLI::ValidationError("--size", "'" + text + "' is not a size like 1280x800");
        if (size[k] < kSmallestWindow || size[k] > kLargestWindow)
            throw CLI::ValidationError("--size", text + " is not in " +
                                                     std::to_string(kSmallestWindow) + " to " +
                                                     std::to_string(kLargestWindow));
        at = stop + 1;
    }
    return {size[0], size[1]};
}

/// On a terminal, makes the headings of a help text bold.
std::string with_bold_headings(const std::string& help) {
    constexpr std::array<std::string_view, 4> kHeadings{
        "Usage:", "Positionals:", "Options:", "Examples:"};
    std::istringstream lines(help);
    std::string text;
    for (std::string line; std::getline(lines, line); text.append(line).append("\n")) {
        for (const std::string_view heading : kHeadings)
            if (line.starts_with(heading))
                line.replace(0, heading.size(), painted(heading, Paint::heading, STDOUT_FILENO));
    }
    return text;
}

void print_help() {
    std::ostringstream help;
    help << "Touch recorded 3D video: colour and depth shown as a moving relief that a hand "
            "feels.\n\nUsage:\n";
    for (const Command& command : kCommands) {
        constexpr int kUsageWidth = 58;
        const std::string name = command.name == "view" ? "[view]" : std::string(command.name);
        help << "  dibhr " << std::left << std::setw(kUsageWidth)
             << name + ' ' + std::string(command.arguments) << command.summary << '\n';
    }
    help << "\n  dibhr help COMMAND     the options of a command, as dibhr COMMAND --help\n"
            "  dibhr help --man       all of it as a manual page, for man -l -\n"
            "  dibhr completion bash  for that shell, zsh or fish: source it\n"
            "  dibhr --version, -V    the version\n"
            "\nExamples:\n"
            "  dibhr                                the built-in sample, touched by the mouse\n"
            "  dibhr color.mp4 depth.mp4            a colour and a depth video\n"
            "  dibhr color.mp4                      the depth video beside it is found\n"
            "  dibhr mine.dibhr                     a recorded session moves by itself\n"
            "  dibhr touch --depth depth.png --goals goals.csv --out touched.csv\n"
            "\nEnds with 0 on success, 1 on a failure it explains, 2 on bad usage.\n";
    std::cout << with_bold_headings(help.str());
}

const Command* command_named(const std::string& name) {
    const auto* const found = std::ranges::find(kCommands, name, &Command::name);
    return found == kCommands.end() ? nullptr : found;
}

int run_one(const Command& command, const Arguments& arguments,
            const PictureHook& after_picture = {}) {
    CLI::App app(std::string(command.summary), "dibhr " + std::string(command.name));
    return command.run(app, arguments, after_picture);
}

/// Stores the options that a command declares, in place of making a help text.
class OptionCollector : public CLI::Formatter {
  public:
    explicit OptionCollector(DocumentedCommand& into) : into_(into) {}

    std::string make_help(const CLI::App* app, std::string /*name*/,
                          CLI::AppFormatMode /*mode*/) const override {
        into_.examples = app->get_footer();
        for (const CLI::Option* const option : app->get_options()) {
            DocumentedOption taken{.argument = option->get_positional() ? option->get_name() : "",
                                   .default_text = option->get_default_str(),
                                   .help = option->get_description(),
                                   .required = option->get_required()};
            for (const std::string& name : option->get_lnames()) taken.names.push_back("--" + name);
            for (const std::string& name : option->get_snames()) taken.names.push_back("-" + name);
            if (option->get_items_expected_max() > 0 && !taken.is_argument())
                taken.type = option->get_type_name();
            into_.options.push_back(std::move(taken));
        }
        return {};
    }

  private:
    DocumentedCommand& into_;
};

std::vector<DocumentedCommand> documented_commands() {
    std::vector<DocumentedCommand> all;
    for (const Command& command : kCommands) {
        all.push_back({.name = std::string(command.name),
                       .arguments = std::string(command.arguments),
                       .summary = std::string(command.summary)});
        CLI::App app(std::string(command.summary), "dibhr " + std::string(command.name));
        app.formatter(std::make_shared<OptionCollector>(all.back()));
        command.run(app, {"--help"}, {});
    }
    return all;
}

int run_completion(const Arguments& arguments) {
    if (arguments.size() != 1)
        throw UsageError("completion is for one shell: dibhr completion bash, zsh or fish");
    std::cout << completion_for(arguments.front(), documented_commands());
    return 0;
}

/// `dibhr help`, `dibhr help COMMAND`, the keys, and the manual page.
int run_help(const Arguments& about) {
    if (about.empty()) {
        print_help();
        return 0;
    }
    if (about.front() == "--man") {
        std::cout << man_page(documented_commands());
        return 0;
    }
    if (about.front() == "keys") {
        std::cout << keys_help(KeyTable(load_settings(settings_path()).keys));
        return 0;
    }
    if (const Command* const command = command_named(about.front()))
        return run_one(*command, {"--help"});
    throw UsageError("no command is called " + in_quotes(about.front()) +
                     command_suggestion(about.front()) + " (see dibhr --help)");
}

/// Names the first word that looks like an option and is none, with the nearest option. Else empty.
std::string unknown_option(const CLI::App& app, const Arguments& arguments) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& argument : arguments) {
        const std::string word = argument.substr(0, argument.find('='));
        const bool known = std::ranges::find(names, word) != names.end();
        if (word.size() > 2 && word.starts_with("--") && !known)
            return "there is no option " + one_line(word) + did_you_mean(word, names);
    }
    return {};
}

/// Names all options that are needed and were not given, where CLI11 names the first. Empty: none.
std::string missing_options(const CLI::App& app) {
    std::vector<std::string> missing;
    for (const CLI::Option* const option : app.get_options())
        if (option->get_required() && option->count() == 0) missing.push_back(option->get_name());
    if (missing.size() < 2) return {};
    return listed(missing, " and ") + " are required";
}

/// The words for which the command has no place. Empty: there are none.
std::string words_too_many(const CLI::App& app) {
    std::vector<std::string> words = app.remaining();
    if (words.empty()) return {};
    for (std::string& word : words) word = in_quotes(word);
    std::vector<std::string> places;
    for (const CLI::Option* const option : app.get_options())
        if (option->get_positional()) places.push_back(option->get_name(true));
    return "no place for " + listed(words) + ": this command takes " +
           (places.empty() ? "no files" : listed(places, " ")) + ", and options";
}

}  // namespace

std::string command_suggestion(const std::string& word) {
    return did_you_mean(word, all_names(kCommands));
}

bool parse(CLI::App& app, const Arguments& arguments) {
    try {
        app.parse(Arguments(arguments.rbegin(), arguments.rend()));
        return true;
    } catch (const CLI::CallForHelp&) {
        std::cout << with_bold_headings(app.help());
        return false;
    } catch (const CLI::ParseError& error) {
        std::string problem = unknown_option(app, arguments);
        if (problem.empty()) problem = words_too_many(app);
        if (problem.empty() &&
            error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError))
            problem = missing_options(app);
        if (problem.empty()) problem = error.what();
        throw UsageError(problem + " (see " + app.get_name() + " --help)");
    }
}

CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& file,
                      const std::string& help, const std::string& type) {
    return app
        .add_option_function<std::string>(
            name, [&file](const std::string& text) { file = text; }, help)
        ->type_name(type);
}

CLI::Option* add_surfaces_option(CLI::App& app, SurfacesFrom& from) {
    return add_words_option<SurfacesFrom>(
        app, "--surface-from",
        "Where a replay's surface comes from; auto: the video if it is there, unchanged and "
        "cleaned as it was, else the session",
        [&from](SurfacesFrom word) { from = word; });
}

CLI::Option* add_firmware(CLI::App& app, std::filesystem::path& file) {
    return add_file(app, "--firmware", file,
                    "Firmware for a Falcon that has none; checked, and kept for the next time");
}

CLI::Option* add_size_option(CLI::App& app, std::optional<std::pair<int, int>>& size,
                             const std::string& help) {
    return app
        .add_option_function<std::string>(
            "--size", [&size](const std::string& text) { size = parse_size(text); }, help)
        ->type_name("WxH");
}

CLI::Option* add_speed_option(CLI::App& app, const std::function<void(double)>& set) {
    return add_number_option(app, "--speed", kSlowestSpeed, kFastestSpeed,
                             "Speed, as a multiple of the speed of the video", set)
        ->type_name("X")
        ->default_str("1");
}

CLI::Option* add_device_option(CLI::App& app, std::string& device) {
    return app
        .add_option_function<std::string>(
            "--device",
            [&device](const std::string& name) {
                if (!names_device(name))
                    throw CLI::ValidationError("--device",
                                               "'" + name + "' is none of " + device_names());
                device = name;
            },
            device_names(meaning_of_auto()))
        ->type_name("DEVICE")
        ->default_str("auto");
}

int run_command_line(const Arguments& arguments, const PictureHook& after_picture) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first == "--help" || first == "-h") {
        print_help();
        return 0;
    }
    if (first == "help") return run_help(Arguments(arguments.begin() + 1, arguments.end()));
    if (first == "completion") return run_completion({arguments.begin() + 1, arguments.end()});
    if (first == "--version" || first == "-V") {
        std::cout << "dibhr " << DIBHR_VERSION << '\n';
        return 0;
    }
    // A word that is no command is a file for the viewer, the first command of the table.
    if (const Command* const command = command_named(first))
        return run_one(*command, Arguments(arguments.begin() + 1, arguments.end()), after_picture);
    return run_one(kCommands.front(), arguments, after_picture);
}

}  // namespace dibhr
