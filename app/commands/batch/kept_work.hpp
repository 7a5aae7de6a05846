// Work on each of many files, whose results are kept: what is done is not done again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/commands/batch/given_files.hpp"
#include "core/files/json.hpp"

namespace dibhr {

struct WorkResult {
    Json value = Json::object();
    std::vector<std::string> files{};     ///< that were written, below the folder of the results
    std::vector<std::string> warnings{};  ///< sentences, of a file that was worked on
    /// Lines on what was found wrong; of a file that cannot be worked on why, and nothing else.
    std::vector<std::string> failures{};
    bool done{false};  ///< false: passed over
};

/// Called with the share done, in the process of the work. Throws WorkStopped.
using WorkProgress = std::function<void(double)>;

struct KeptWork {
    std::string command{};           ///< "replay": part of the names of what is kept
    std::string options{};           ///< what decides the result besides the file
    std::string title{};             ///< of the progress
    std::filesystem::path folder{};  ///< of the results; made where it is missing
    std::size_t at_once{0};          ///< pieces; 0: one for each processor
    bool again{false};               ///< also what is done
    bool in_scratch{false};          ///< the folder is removed in the end
    /// One file, in a process of its own; what it writes must not depend on others. Throws Error.
    std::function<WorkResult(const GivenFile& file, const WorkProgress& progress)> work{};
};

/// "P07.replay.json": what is kept of a file, below the folder of the results. A result is good for
/// the same command and options, the same version of dibhr and the same content, by time and size,
/// else by its SHA-256.
[[nodiscard]] std::filesystem::path kept_name(const KeptWork& work, const GivenFile& file);

/// The results, in the order of the files, whoever worked on them and when. Throws WorkStopped, and
/// keeps what is done; InputError where nothing can be kept.
[[nodiscard]] std::vector<WorkResult> work_through(const KeptWork& work,
                                                   const std::vector<GivenFile>& files);

}  // namespace dibhr
