// Names in an archive, and its manifest.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace dibhr {

inline constexpr const char* kManifest = "manifest.sha256";
inline constexpr const char* kParticipants = "participants.tsv";
inline constexpr const char* kSources = "sourcedata";
inline constexpr const char* kSessionEnding = ".dibhr";
inline constexpr const char* kTouchTask = "touch";  ///< of a session
inline constexpr const char* kStudyTask = "study";

/// Gives every participant a name of its own: "sub-P07" for "P-07".
class ParticipantNames {
  public:
    /// The same one for the same label; empty: the session has none.
    [[nodiscard]] std::string name_of(const std::string& label);
    [[nodiscard]] const std::map<std::string, std::string>& all() const noexcept { return names_; }

  private:
    std::map<std::string, std::string> names_{};  ///< by label
};

/// "sub-P07_task-touch_run-001".
[[nodiscard]] std::string run_name(const std::string& participant, std::string_view task,
                                   std::size_t run);

/// A file of a participant's folder for behaviour: "sub-P07/beh/sub-P07_..._ticks.csv".
[[nodiscard]] std::filesystem::path table_of(const std::string& participant, const std::string& run,
                                             std::string_view what);

/// The name as it can stand in a manifest and on every file system; where `taken` has it, with a
/// number before its ending.
template <typename Taken>
[[nodiscard]] std::string free_name(const std::filesystem::path& wanted, const Taken& taken);
[[nodiscard]] std::string plain_name(std::string name);

/// Sums by the names of files, relative to the archive.
using Manifest = std::map<std::string, std::string>;

/// In the format of `sha256sum`.
[[nodiscard]] std::string manifest_text(const Manifest& manifest);
/// A line that is none is left out. Throws InputError when there is no manifest.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& archive);

template <typename Taken>
std::string free_name(const std::filesystem::path& wanted, const Taken& taken) {
    const std::filesystem::path path = wanted.lexically_normal();
    const std::filesystem::path last = path.has_filename() ? path : path.parent_path();
    std::string name = plain_name(last.filename().string());
    if (name.empty() || name == "." || name == "..") name = "unnamed";
    const std::filesystem::path first = name;
    for (int number = 2; taken(name); ++number)
        name = first.stem().string() + "-" + std::to_string(number) + first.extension().string();
    return name;
}

}  // namespace dibhr
