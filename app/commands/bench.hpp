// `dibhr bench`: updates, frame hand-over and loop timing on this machine.
#pragma once

#include <filesystem>

namespace dibhr {

struct BenchOptions {
    std::filesystem::path json{};  ///< empty: text only; "-": standard output
};

/// Measures and prints. The exit code; throws InputError when the JSON file cannot be written.
int run_bench(const BenchOptions& options);

}  // namespace dibhr
