// `dibhr replay`: a recorded exploration again, through the same or other algorithms.
#pragma once

#include <filesystem>
#include <vector>

#include "app/settings/command_options.hpp"

namespace dibhr {

struct ReplayOptions {
    std::filesystem::path session{};
    std::vector<Algorithm> algorithms{};  ///< empty: as recorded
    GivenParameters given{};              ///< numbers that beat the recorded ones
    std::filesystem::path bump{};         ///< instead of the recorded one; empty: as recorded
    bool raw_depth{false};                ///< no cleaning, whatever was recorded
    bool any_media{false};                ///< also over files that have changed
    std::filesystem::path csv{};          ///< rows of the one run, "-": standard output; or empty
};

/// Prints whether the runs that change nothing gave the recorded bits, and a table of all runs. 1
/// when those bits differ. Throws InputError and UsageError.
int run_replay(const ReplayOptions& options);

}  // namespace dibhr
