// The files that a command line names: themselves, and those in its folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// What is looked for in folders.
struct SoughtFiles {
    std::string ending{};   ///< of their names, as ".dibhr"
    int application_id{0};  ///< of a database of another name; 0: none is taken
    std::string called{};   ///< "session", for messages
};

/// Sessions, by their names or their content.
[[nodiscard]] SoughtFiles sought_sessions();

/// A file, and the name of what is made of it.
struct GivenFile {
    std::filesystem::path file{};
    /// Its path below the folder that was given, without the ending; of a file that was given its
    /// name. No other file has it, nor is one made in it.
    std::string name{};
};

/// Whether that is a folder, or several files: each has results of its own.
[[nodiscard]] bool are_many(const std::vector<std::filesystem::path>& given);

/// Whether the folder holds, at any depth, a file that is sought.
[[nodiscard]] bool holds_sought(const std::filesystem::path& folder, const SoughtFiles& sought);

/// The files as they were given, and for each folder those in it at any depth, by their paths.
/// Throws InputError for a folder that cannot be listed, or holds none.
[[nodiscard]] std::vector<GivenFile> given_files(const std::vector<std::filesystem::path>& given,
                                                 const SoughtFiles& sought);

}  // namespace dibhr
