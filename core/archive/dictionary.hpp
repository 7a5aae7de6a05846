// The sidecars of tables: what their columns mean, and how the values came about.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/json.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// Where the rows of a table come from.
struct TableSource {
    std::string file{};  ///< of the archive
    int trial{-1};       ///< of a study file, from 0; -1: the file is a session
};

/// Members of a sidecar by the names of columns are objects with a Description; the others state
/// facts.
inline constexpr const char* kDescription = "Description";
// Facts that the check reads.
inline constexpr const char* kSource = "Source";
inline constexpr const char* kTrial = "Trial";
inline constexpr const char* kRuns = "Runs";

/// A member for a column.
[[nodiscard]] Json column(const std::string& meaning, const std::string& unit = {});
/// The members that say where the rows come from. `task`: of the file's name.
void add_source(Json& json, const char* task, const TableSource& source);

[[nodiscard]] Json tick_dictionary(const Session& session, const TableSource& source);
[[nodiscard]] Json mark_dictionary(const Session& session, const TableSource& source);
[[nodiscard]] Json media_dictionary();

/// Writes rows, or nothing where they are empty, and the sidecar beside them. Throws InputError.
void write_table(const std::filesystem::path& archive, const std::filesystem::path& table,
                 std::string_view rows, const Json& dictionary);

/// "P07_ticks.json" of "P07_ticks.csv".
[[nodiscard]] std::filesystem::path sidecar_of(std::filesystem::path table);

}  // namespace dibhr
