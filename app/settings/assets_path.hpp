// Where the files that come with the program are: beside an installed binary, or in the source
// tree.
#pragma once

#include <filesystem>

namespace dibhr {

/// The folder that holds `sample`, `bump` and the like: `../share/dibhr` of the running program,
/// else the source tree's `assets` it was built from. Throws InputError when neither exists.
[[nodiscard]] std::filesystem::path assets_folder();

/// The built-in sample, a colour file and a depth file. Throws InputError when one is missing.
struct SampleFiles {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
};
[[nodiscard]] SampleFiles sample_files();

}  // namespace dibhr
