// `dibhr touch`: the core alone, head-less, over a stream of goals.
#pragma once

#include <filesystem>

#include "core/haptics/parameters.hpp"

namespace dibhr {

struct TouchOptions {
    std::filesystem::path depth{};
    std::filesystem::path goals{};
    std::filesystem::path out{"-"};  ///< "-": standard output
    std::filesystem::path bump{};    ///< empty: none
    bool video{false};               ///< frames blended in time; false: the first image
    bool raw_depth{false};           ///< no cleaning
    TouchParameters parameters{};
};

/// Writes one row an update; `out` appears whole or not at all. The exit code; throws InputError.
int run_touch(const TouchOptions& options);

}  // namespace dibhr
