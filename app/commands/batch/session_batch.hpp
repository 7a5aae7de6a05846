// Many sessions by one command: its options, a process for each session, and the summary of all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/batch/kept_work.hpp"
#include "core/session/session.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace dibhr {

/// What the command line says of the sessions, and of the work on many.
struct BatchOptions {
    std::vector<std::filesystem::path> given{};  ///< sessions, and folders of them
    std::filesystem::path out{};                 ///< folder of the results; empty: none is kept
    std::vector<std::filesystem::path> only{};   ///< of them; empty: all
    int jobs{0};                                 ///< processes at a time; 0: one a processor
    bool list{false};                            ///< prints names and files, and does nothing else
    bool again{false};                           ///< also what is done

    /// Several sessions, a folder of them, or results in a folder.
    [[nodiscard]] bool is_batch() const;
    [[nodiscard]] const std::filesystem::path& file() const { return given.front(); }
};

/// The argument SESSION and the options below. `batch` must outlive the parsing of `app`.
/// `out_help`: what --out does.
void add_sessions(CLI::App& app, BatchOptions& batch, const std::string& out_help);
/// --out, --only, --jobs, --list and --again.
void add_batch_options(CLI::App& app, BatchOptions& batch, const std::string& out_help);

/// A cell of the summary.
struct SummaryCell {
    std::string column{};
    std::string value{};
    bool printed{false};  ///< also in the table on standard output
};

/// What a command gives of a session.
struct SessionWork {
    std::vector<SummaryCell> cells{};
    SessionFacts facts{};
    std::string text{};                                        ///< printed before the table
    std::vector<std::string> files{}, warnings{}, failures{};  ///< as in WorkResult
};

/// The file, its duration, its ticks and when it began; the facts.
[[nodiscard]] SessionWork summary_of(const Session& session);

struct SessionBatch {
    std::string command{};  ///< "replay"
    std::string title{};    ///< "Replaying"
    bool table{true};       ///< is printed
    /// Works on one session; `folder`: of the results.
    std::function<SessionWork(const GivenFile& file, const std::filesystem::path& folder,
                              const WorkProgress& progress)>
        work{};
};

/// What was given besides the sessions, where the results go and how many are made at a time: the
/// same text gives the same results.
[[nodiscard]] std::string deciding_options(const CLI::App& app);

/// Works through the sessions, or lists them. Prints what was found wrong, then the table, and
/// writes it with all columns into `COMMAND.csv` of the folder. Returns 1 when anything was wrong.
/// With --only nothing is summed up. Throws UsageError, WorkStopped, InputError.
int run_batch(const CLI::App& app, const SessionBatch& batch, const BatchOptions& options);

}  // namespace dibhr
