// `dibhr prepare`: cleans recordings once, off line, and keeps their surface for playing.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/given_media.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "app/window/signals.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/playing/prepared_cache.hpp"

namespace dibhr {
namespace {

constexpr double kMostGigabytes = 1e6;

struct PrepareOptions {
    std::vector<std::string> recordings{};
    std::filesystem::path depth{};  ///< of the one recording; empty: found beside it
    std::uintmax_t most_bytes{kMostPreparedBytes};
    bool again{false};
    bool lists{false};
    bool empties{false};
    bool must_be_sure{false};
    TouchRequest touch{};
    TouchParameters parameters{};
};

std::string summary_line(const KeptRecording& kept) {
    if (!kept.record)
        return one_line(kept.folder.string()) + ": not finished, " + megabytes_text(kept.bytes);
    const PreparedRecord& record = *kept.record;
    const std::string file = record.sources.empty() ? kept.folder.string()
                                                    : record.sources.front().content.file.string();
    return one_line(file) + ": " + std::to_string(record.frames) + " frames of " +
           size_text(record.columns, record.rows) + ", " + clock_text(record.duration_s) +
           ", cleaning " + record.cleaning + ", " + megabytes_text(kept.bytes) +
           (kept.is_current ? "" : "; made by another version, which is not used");
}

int list_kept() {
    std::uintmax_t bytes = 0;
    for (const KeptRecording& kept : kept_recordings(prepared_cache_path())) {
        std::cout << summary_line(kept) << '\n';
        bytes += kept.bytes;
    }
    std::cout << megabytes_text(bytes) << " in " << one_line(prepared_cache_path().string())
              << '\n';
    return 0;
}

int empty_cache() {
    std::uintmax_t bytes = 0;
    for (const KeptRecording& kept : kept_recordings(prepared_cache_path())) {
        if (forget_recording(kept))
            bytes += kept.bytes;
        else
            print_warning("another dibhr is preparing " + shown(kept.folder) +
                          ": it is not removed");
    }
    std::cout << megabytes_text(bytes) << " removed\n";
    return 0;
}

/// False: Ctrl+C came.
bool prepare_one(const PrepareOptions& options, const std::string& recording,
                 ShutdownSignals& signals) {
    TouchParameters parameters = options.parameters;
    auto media = open_given(recording, options.depth, options.touch, options.must_be_sure, false,
                            parameters);
    std::optional<Prepared> made;
    {
        const std::string name = one_line(std::filesystem::path(recording).filename().string());
        ProgressBar bar("Preparing " + name);
        const PrepareRequest request{
            .cache = prepared_cache_path(),
            .cleaning = options.touch.cleaning(parameters, media->description()),
            .most_bytes = options.most_bytes,
            .again = options.again,
            .progress = [&](double share) {
                bar.show(share);
                return !signals.arrived();
            }};
        made = prepare(std::move(media), request);
    }
    if (!made) return false;
    std::cout << one_line(recording) << ": " << made->frames
              << (made->frames == 1 ? " frame" : " frames")
              << (made->was_kept ? " prepared before, " : " prepared, ")
              << megabytes_text(made->bytes) << '\n';
    if (made->removed > 0)
        std::cout << made->removed
                  << (made->removed == 1 ? " recording that was" : " recordings that were")
                  << " used longest ago made room for it\n";
    return true;
}

int prepare_all(const PrepareOptions& options) {
    ShutdownSignals signals;
    for (const std::string& recording : options.recordings) {
        if (prepare_one(options, recording, signals)) continue;
        print_error_line("cancelled: nothing is kept of " + recording);
        return kInterrupted;
    }
    return 0;
}

}  // namespace

int run_prepare(CLI::App& app, const Arguments& arguments) {
    PrepareOptions options;
    app.add_option("RECORDING", options.recordings,
                   "Colour videos or folders with their depth beside them, or depth alone")
        ->type_name("");
    add_file(app, "--depth", options.depth, "The depth of the one recording, else found beside it");
    app.add_flag("--again", options.again, "Cleans again, also what is kept already");
    app.add_flag("--list", options.lists, "Lists what is kept, the one used last first");
    app.add_flag("--empty", options.empties, "Removes all that is kept");
    add_number_option(app, "--most", 0.001, kMostGigabytes,
                      "Keeps at most so many gigabytes: those used longest ago go first",
                      [&options](double gigabytes) {
                          options.most_bytes = static_cast<std::uintmax_t>(1e9 * gigabytes);
                      })
        ->type_name("GB")
        ->default_str("20");
    add_shape_options(app, options.touch);
    add_sure_option(app, options.must_be_sure);
    app.footer(
        "The surface is kept by the content of the recording, its cleaning, and the version of "
        "dibhr, below XDG_CACHE_HOME.\nOpened with the same cleaning, the recording plays from it "
        "and feels the same, bit for bit.\n\n"
        "Examples:\n"
        "  dibhr prepare color.mp4\n"
        "  dibhr prepare take1_color.mp4 take2_color.mp4 --cleaning sensor\n"
        "  dibhr prepare --list");
    if (!parse(app, arguments)) return 0;
    if (options.lists) return list_kept();
    if (options.empties) return empty_cache();
    if (options.recordings.empty())
        throw UsageError("RECORDING is required: what to prepare (see dibhr prepare --help)");
    if (options.recordings.size() > 1 && !options.depth.empty())
        throw UsageError("--depth is of one recording: give one RECORDING with it");
    options.touch.given.apply(options.parameters);
    return prepare_all(options);
}

}  // namespace dibhr
