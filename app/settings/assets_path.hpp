// Where the files that come with the program are: beside an installed binary, or in the source
// tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// The built-in sample, a colour file and a depth file. Throws InputError when one is missing.
struct SampleFiles {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
};
[[nodiscard]] SampleFiles sample_files();

/// The materials that come with the program. Throws InputError when its files are missing.
[[nodiscard]] std::filesystem::path shipped_materials_folder();

/// The studies that come with the program. Throws InputError when its files are missing.
[[nodiscard]] std::filesystem::path shipped_studies_folder();

/// A file for /etc/security/limits.d that grants real-time priority. Throws InputError when the
/// program's files are missing.
[[nodiscard]] std::filesystem::path shipped_limits_file();

/// The names, in order and without ending, of the TOML files in a folder of materials or studies;
/// none where it cannot be read.
[[nodiscard]] std::vector<std::string> toml_names_in(const std::filesystem::path& folder);

}  // namespace dibhr
