// Judges which results are good, lets processes make the others, and reads them all.
#include "app/commands/batch/kept_work.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <system_error>

#include "app/commands/batch/stoppable_work.hpp"
#include "app/commands/batch/worker_processes.hpp"
#include "app/commands/output.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/output_file.hpp"
#include "core/files/text_file.hpp"
#include "core/files/write_failure.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

constexpr int kCannotKeep = 3;  // what a process ends with whose result cannot be written

/// The file, and the log of a recording that goes on or was broken off.
std::vector<fs::path> parts_of(const fs::path& file) {
    std::error_code missing;
    const fs::path log = file.string() + "-wal";
    return fs::exists(log, missing) ? std::vector{file, log} : std::vector{file};
}

Json sizes_and_times(const fs::path& file) {
    return json_list(parts_of(file), [](const fs::path& part) {
        struct stat found {};
        if (::stat(part.c_str(), &found) != 0) return Json();
        constexpr std::int64_t kNanoseconds = 1'000'000'000;
        return Json{{"bytes", found.st_size},
                    {"changed_ns",
                     std::int64_t{found.st_mtim.tv_sec} * kNanoseconds + found.st_mtim.tv_nsec}};
    });
}

Json sums_of(const fs::path& file) {
    return json_list(parts_of(file), [](const fs::path& part) {
        try {
            return Json(sha256_of_file(part));
        } catch (const std::exception&) {
            return Json();  // the work says why it cannot be read
        }
    });
}

/// What decides the result, but for the content.
Json identity_of(const KeptWork& work, const GivenFile& file) {
    return {{"program", "dibhr " DIBHR_VERSION},
            {"command", work.command},
            {"options", work.options},
            {"file", file.file.string()}};
}

fs::path state_file(const KeptWork& work, const GivenFile& file) {
    return work.folder / kept_name(work, file);
}

/// Nothing: there is none, or not of this work.
std::optional<Json> state_of(const KeptWork& work, const GivenFile& file) {
    try {
        const std::optional<std::string> text = small_text_in(state_file(work, file));
        Json state = text ? parsed_json(*text) : Json();
        if (state.is_object() && state.value("of", Json()) == identity_of(work, file)) return state;
    } catch (const std::exception&) {  // not one of ours: it is made again
    }
    return std::nullopt;
}

bool has_content(const Json& state, const fs::path& file) {
    if (state.value("content", Json()) == sizes_and_times(file)) return true;
    return state.value("sha256", Json()) == sums_of(file);
}

bool is_done(const KeptWork& work, const GivenFile& file) {
    const std::optional<Json> state = state_of(work, file);
    if (!state || !state->value("done", false) || !has_content(*state, file.file)) return false;
    return std::ranges::all_of(state->value("files", std::vector<std::string>()),
                               [&work](const std::string& name) {
                                   std::error_code missing;
                                   return fs::exists(work.folder / name, missing);
                               });
}

void keep(const KeptWork& work, const GivenFile& file, Json state, const WorkResult& result) {
    state["done"] = result.done;
    state["files"] = result.files;
    state["warnings"] = result.warnings;
    state["failures"] = result.failures;
    state["value"] = result.value;
    write_file(state_file(work, file), json_line(state) + '\n');
}

Json begun_state(const KeptWork& work, const GivenFile& file) {
    return {{"of", identity_of(work, file)},
            {"content", sizes_and_times(file.file)},
            {"sha256", sums_of(file.file)}};
}

/// In the process of the work.
int work_on(const KeptWork& work, const GivenFile& file, ShutdownSignals& signals) {
    const Json state = begun_state(work, file);
    WorkResult result;
    try {
        result = work.work(file, [&signals](double) {
            if (signals.arrived()) throw WorkStopped("");
        });
        result.done = true;
    } catch (const WorkStopped&) {
        return 1;
    } catch (const std::bad_alloc&) {
        result = {.failures = {file.file.string() + ": there is not enough memory for it; give "
                                                    "--jobs 1, or close other programs"}};
    } catch (const std::exception& error) {
        result = {.failures = {error.what()}};
    }
    try {
        keep(work, file, state, result);
    } catch (const InputError&) {
        return kCannotKeep;
    }
    return 0;
}

void make_folders_of(const KeptWork& work, const std::vector<GivenFile>& files) {
    std::error_code failed;
    make_folders(work.folder, failed);
    for (const GivenFile& file : files)
        if (!failed) make_folders(state_file(work, file).parent_path(), failed);
    if (failed)
        throw InputError(work.folder.string() + ": " +
                         write_failure(failed.value(), "cannot take the results"));
}

/// Runs what is not done.
void run_all(const KeptWork& work, const std::vector<GivenFile>& files,
             const std::vector<std::size_t>& wanted) {
    const auto file_of = [&](std::size_t piece) -> const GivenFile& {
        return files[wanted[piece]];
    };
    ShutdownSignals signals;
    ProgressBar bar(work.title);
    std::size_t done = files.size() - wanted.size();
    std::string cannot_keep;
    const auto ended = [&](std::size_t piece, const ChildEnd& end) {
        ++done;
        bar.show(static_cast<double>(done) / static_cast<double>(files.size()),
                 std::to_string(done) + " of " + std::to_string(files.size()));
        const GivenFile& file = file_of(piece);
        if (end.exit_code == kCannotKeep) cannot_keep = state_file(work, file).string();
        if (end.signal == 0) return;
        const std::string why = file.file.string() + ": the work on it " + in_words(end) +
                                "; copy the file again, or report it";
        keep(work, file, begun_state(work, file), {.failures = {why}});
    };
    const bool all = run_in_processes(
        {.count = wanted.size(),
         .at_once = work.at_once == 0 ? usable_processors() : work.at_once,
         .work = [&](std::size_t piece) { return work_on(work, file_of(piece), signals); },
         .ended = ended},
        signals);
    if (!all)
        throw WorkStopped("stopped with " + std::to_string(done) + " of " +
                          std::to_string(files.size()) + " done; " +
                          (work.in_scratch ? "with --out DIR they are kept"
                                           : "the same command goes on with the others"));
    if (!cannot_keep.empty())
        throw InputError(cannot_keep +
                         ": cannot be written; make room for it, and start the same command again");
}

}  // namespace

fs::path kept_name(const KeptWork& work, const GivenFile& file) {
    return file.name + '.' + work.command + ".json";
}

std::vector<WorkResult> work_through(const KeptWork& work, const std::vector<GivenFile>& files) {
    make_folders_of(work, files);
    std::vector<std::size_t> wanted;
    for (std::size_t k = 0; k < files.size(); ++k)
        if (work.again || !is_done(work, files[k])) wanted.push_back(k);
    run_all(work, files, wanted);
    std::vector<WorkResult> results;
    for (const GivenFile& file : files) {
        const Json state = state_of(work, file).value_or(Json::object());
        results.push_back({.value = state.value("value", Json::object()),
                           .files = state.value("files", std::vector<std::string>()),
                           .warnings = state.value("warnings", std::vector<std::string>()),
                           .failures = state.value("failures", std::vector<std::string>()),
                           .done = state.value("done", false)});
        WorkResult& result = results.back();
        if (!result.done && result.failures.empty())
            result.failures.push_back(file.file.string() +
                                      ": has no result; start the same command again");
    }
    return results;
}

}  // namespace dibhr
