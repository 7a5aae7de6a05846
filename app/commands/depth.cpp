// `dibhr depth`: depth for a colour video, by an estimator that a person has installed.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <future>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/estimators.hpp"
#include "app/settings/settings.hpp"
#include "app/window/signals.hpp"
#include "core/error.hpp"
#include "core/estimate/depth_cache.hpp"
#include "core/estimate/depth_estimate.hpp"
#include "core/estimate/estimator_command.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestPatience_s = 1e6;

struct DepthOptions {
    EstimateRequest request{};  ///< without the command
    fs::path out{};
    std::string with{};  ///< a command, or the name of an estimator in the settings
    std::string name{};  ///< under which the settings keep the command
    bool view{false};
    bool lists{false};
    bool forgets{false};
};

bool is_command(const std::string& text) {
    return text.find('{') != std::string::npos;
}

/// A command of the settings may be another person's: it runs only after consent here.
Estimator require_consent(const Estimator& estimator) {
    if (Consent().has_agreed_to(estimator.command)) return estimator;
    throw InputError("the settings name the estimator " + estimator.name +
                     ", but nobody on this machine has agreed to run its command, so it was not "
                     "run: give the command with --with, or agree in the window; the command is " +
                     escaped_text(estimator.command));
}

/// Typing a command counts as consent.
void store_consent(const std::string& command) try {
    Consent().agree(command);
} catch (const InputError& error) {
    print_warning(std::string(error.what()) + "; dibhr will ask again");
}

/// As the command line says, else the first of the settings.
Estimator chosen_estimator(const DepthOptions& options, const std::vector<Estimator>& known) {
    if (is_command(options.with)) return {.name = options.name, .command = options.with};
    if (options.with.empty()) {
        if (!known.empty()) return require_consent(known.front());
        throw UsageError("no estimator is known. " + estimator_hint());
    }
    if (const Estimator* const one = estimator_named(known, options.with))
        return require_consent(*one);
    throw UsageError("--with " + in_quotes(options.with) +
                     " is neither a command with {input} or {frames} and {output} nor the name of "
                     "an estimator" +
                     (known.empty() ? "" : " (" + listed(all_names(known)) + ")"));
}

/// Replaces an estimator of the same name.
void keep_estimator(Estimator estimator) {
    if (!is_bare_name(estimator.name))
        throw UsageError("--as " + in_quotes(estimator.name) +
                         " is not a name of letters, digits, - and _");
    Settings settings = load_settings(settings_path());
    std::erase_if(settings.estimators,
                  [&estimator](const Estimator& one) { return one.name == estimator.name; });
    settings.estimators.push_back(std::move(estimator));
    save_settings(settings, settings_path());
}

/// Runs the estimator, shows its progress, and stops it on a signal.
std::optional<DepthEstimate> run_estimator(const EstimateRequest& request) {
    constexpr std::chrono::milliseconds kPause{50};
    ShutdownSignals signals;  // created first: the thread must not receive them
    EstimateWatch watch;
    auto made = std::async(std::launch::async, [&] { return estimate_depth(request, watch); });
    ProgressBar bar(one_line(request.colour.filename().string()));
    while (made.wait_for(kPause) != std::future_status::ready) {
        if (signals.arrived()) watch.stop();
        const EstimateProgress now = watch.progress();
        bar.show(now.share(), in_words(now));
    }
    return made.get();
}

std::string summary_line(const KeptEstimate& kept) {
    const EstimateRecord& record = kept.record;
    if (record.command.empty())
        return one_line(kept.folder.string()) + ": no depth that can be used, " +
               megabytes_text(kept.bytes);
    const std::string all = std::to_string(record.colour.count());
    const std::string frames = record.depth.empty()
                                   ? std::to_string(kept.frames_there) + " of " + all + " frames"
                                   : all + (record.colour.count() == 1 ? " frame" : " frames");
    return one_line(record.colour.file.string()) + ": " + frames + ", " +
           megabytes_text(kept.bytes) + ", by " + one_line(record.command);
}

/// The estimates for `colour`; all where it is empty.
std::vector<KeptEstimate> kept_of(const fs::path& colour) {
    std::vector<KeptEstimate> all = kept_estimates(depth_cache_path());
    std::erase_if(all, [&colour](const KeptEstimate& kept) {
        std::error_code gone;
        const fs::path whole = fs::absolute(colour, gone).lexically_normal();
        return !colour.empty() && kept.record.colour.file.lexically_normal() != whole;
    });
    return all;
}

int list_kept(const fs::path& colour) {
    std::uintmax_t bytes = 0;
    for (const KeptEstimate& kept : kept_of(colour)) {
        std::cout << summary_line(kept) << '\n';
        bytes += kept.bytes;
    }
    std::cout << megabytes_text(bytes) << " in " << one_line(depth_cache_path().string()) << '\n';
    return 0;
}

int forget_kept(const fs::path& colour) {
    std::uintmax_t bytes = 0;
    for (const KeptEstimate& kept : kept_of(colour)) {
        if (forget_estimate(kept))
            bytes += kept.bytes;
        else
            print_warning("another dibhr is making the depth of " +
                          kept.record.colour.file.string() + ": nothing of it is removed");
    }
    std::cout << megabytes_text(bytes) << " removed\n";
    return 0;
}

void require_options(const DepthOptions& options) {
    const bool keeps = options.lists || options.forgets;
    if (options.request.colour.empty() && !keeps)
        throw UsageError("COLOR is required: the video to make depth for (see dibhr depth --help)");
    if (!options.name.empty() && !is_command(options.with))
        throw UsageError("--as names the command of --with: give that, too");
}

int open_viewer(const fs::path& colour, const fs::path& depth) {
    CLI::App app("", "dibhr view");
    return run_view(app, {colour.string(), depth.string()}, {});
}

int make_depth(const DepthOptions& options) {
    const Estimator estimator =
        chosen_estimator(options, load_settings(settings_path()).estimators);
    EstimateRequest request = options.request;
    request.command = estimator.command;
    request.cache = depth_cache_path();
    request.meaning.fill_in(estimator.meaning);
    if (is_command(options.with)) store_consent(estimator.command);
    if (!options.name.empty()) {
        Estimator kept = estimator;
        kept.meaning = request.meaning;
        keep_estimator(kept);
    }
    const auto made = run_estimator(request);
    if (!made) {
        print_error_line(EstimatorCommand(request.command).takes_frames()
                             ? "cancelled: what is done is kept; run it again to go on from there"
                             : "cancelled: nothing is kept, as it takes {input} and no {frames}");
        return kInterrupted;
    }
    const fs::path depth =
        options.out.empty() ? made->depth : copy_depth(*made, request.colour, options.out);
    std::cout << one_line(depth.string()) << '\n';
    if (options.view) return open_viewer(request.colour, depth);
    return 0;
}

}  // namespace

int run_depth(CLI::App& app, const Arguments& arguments) {
    DepthOptions options;
    add_file(app, "COLOR", options.request.colour, "Colour video, picture or folder of pictures",
             "");
    app.add_option("--with", options.with,
                   "The estimator: a command, started without a shell, with {input} (the file) or "
                   "{frames} (a folder of its frames, as PNG) and {output} (a folder to fill; "
                   "{output.mp4}: a file); or its NAME in the table [estimators] of the settings; "
                   "else the first one there")
        ->type_name("COMMAND");
    app.add_option("--as", options.name, "Keeps the command in the settings under that name")
        ->type_name("NAME");
    add_file(app, "--out", options.out,
             "Copies the depth to this file, whose name ends in .mkv (for a picture .png), or into "
             "this folder as NAME_depth.mkv; beside the colour file dibhr finds it by itself",
             "FILE");
    app.add_flag("--view", options.view, "Opens both in the viewer");
    app.add_flag("--again", options.request.again,
                 "Makes the depth anew, also where it is kept already");
    add_number_option(app, "--patience", 1.0, kLongestPatience_s,
                      "Ends an estimator that writes and prints nothing for so many seconds",
                      [&options](double seconds) { options.request.timeout_s = seconds; })
        ->type_name("S")
        ->default_str("600");
    app.add_flag("--list", options.lists, "Lists the depth that is kept: of COLOR, or all");
    app.add_flag("--forget", options.forgets, "Removes the depth that is kept: of COLOR, or all");
    add_level_options(app, options.request.meaning);
    app.footer(
        "The depth is kept by the content of the video and the command: the second time it is "
        "there "
        "at once.\nCtrl+C ends the estimator; with {frames} the next run goes on with the frames "
        "that are missing.\nUnless --depth-unit says otherwise, its numbers are relative, and "
        "bright is near.\n\n"
        "Examples:\n"
        "  dibhr depth clip.mp4 --with \"env -C ~/Depth-Anything-V2 python run.py --encoder vits "
        "--img-path {frames} --outdir {output} --pred-only --grayscale\" --as depth-anything\n"
        "  dibhr depth clip.mp4 --with \"env -C ~/Video-Depth-Anything python run.py --encoder "
        "vits --input_video {input} --output_dir {output} --save_npz\" --as video-depth\n"
        "  dibhr depth clip.mp4 --with \"env -C ~/MiDaS python run.py --input_path {frames} "
        "--output_path {output} --grayscale\" --as midas\n"
        "  dibhr depth clip.mp4 --with \"depth-pro-run -i {frames} -o {output} --skip-display\" "
        "--depth-unit m --as depth-pro\n"
        "  dibhr depth clip.mp4 --with \"env -C ~/Marigold python script/depth/run.py "
        "--input_rgb_dir {frames} --output_dir {output}\" --near dark --as marigold\n"
        "  dibhr depth clip.mp4 --with \"env -C ~/DepthCrafter python run.py --video-path {input} "
        "--save-folder {output} --process-length -1\" --as depth-crafter\n"
        "  dibhr depth clip.mp4 --view                    by the first of [estimators]\n"
        "  dibhr depth clip.mp4 --with midas --out .      clip_depth.mkv\n"
        "  dibhr depth --list");
    if (!parse(app, arguments)) return 0;
    require_options(options);
    if (options.lists) return list_kept(options.request.colour);
    if (options.forgets) return forget_kept(options.request.colour);
    return make_depth(options);
}

}  // namespace dibhr
