// The tables of a session file, as SQL.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/sqlite/application_ids.hpp"

namespace dibhr {

/// Counts changes of the tables (`PRAGMA user_version`, and `schema_version` in table session).
/// FORMAT.md states every schema that there was, and what a change must keep.
inline constexpr int kSessionSchemaVersion = 4;
/// The schema that had a table `tick`, and neither parameters nor files.
inline constexpr int kFirstSessionSchema = 1;

/// The size of a page in a recorded file [bytes].
inline constexpr int kSessionPageBytes = 16384;
/// Longer than any value of a recording [bytes].
inline constexpr int kLongestSessionValue_bytes = 1 << 20;

/// Statements that make the tables of an empty database, and fill the explaining ones. A value of a
/// tick that follows from the rest of its row is not stored in `tick_data`; the view `tick`
/// computes it.
[[nodiscard]] std::string session_schema();

/// A column of the view `tick`, as table tick_column explains it.
struct TickColumn {
    std::string name{}, unit{}, meaning{};
};

/// In the order of the view.
[[nodiscard]] std::vector<TickColumn> tick_columns();

/// The tables that are read of a session, besides the view `tick`.
inline constexpr std::array<std::string_view, 8> kSessionTables{
    "session", "media", "source", "pair", "parameters", "tick_data", "clock", "mark"};

/// The tables that are read of a file of the first schema.
inline constexpr std::array<std::string_view, 2> kFirstSessionTables{"session", "tick"};

/// Statements for a connection to a file of the first schema. They make the view `tick` over the
/// file's table, and the other tables of kSessionTables without rows, in the connection's memory.
[[nodiscard]] std::string first_schema_as_this_one();

/// The statement of the view `tick`; by default as it is stored in a session file.
[[nodiscard]] std::string tick_view(std::string_view create = "CREATE VIEW");

/// In all files of that schema ticks are coded as tick_view() reads them.
[[nodiscard]] constexpr bool has_one_view(std::int64_t schema) noexcept {
    return schema >= 3 && schema <= kSessionSchemaVersion;
}

/// Whether `sql` is the statement of the view `tick` in a file of this schema: tick_view(),
/// or that of a dibhr that coded its ticks otherwise. A reader takes no other: a change needs a
/// higher kSessionSchemaVersion, and the statement before it a line in is_tick_view().
[[nodiscard]] bool is_tick_view(const std::string& sql);

/// The number of columns of `tick_data`.
inline constexpr int kTickDataColumns = 27;

/// The bits of `tick_data.state`, which the view separates. Frequent values are in the low bits, so
/// that the state usually fits in a byte, also with the main button pressed.
namespace tick_state {
inline constexpr int kContact = 0;
inline constexpr int kPrimitive = 1;  // 2 bits
inline constexpr int kButtons = 3;    // 8 bits
inline constexpr int kNoSurface = 11;
inline constexpr int kNotReady = 12;
inline constexpr int kMouseFallback = 13;
inline constexpr int kFromZero = 14;
inline constexpr int kReleasesContact = 15;
inline constexpr int kRefused = 16;
inline constexpr int kCut = 17;  // 3 bits
// Not in the view: scripts depend on its columns.
inline constexpr int kCatchingUp = 20;
inline constexpr int kGliding = 21;
inline constexpr int kStandstill = 22;
inline constexpr int kMotionUnknown = 23;
}  // namespace tick_state

/// A time is stored in whole nanoseconds where they give the same bits again, divided by this.
inline constexpr double kNanosecondsPerSecond = 1e9;
inline constexpr double kNanosecondsPerMicrosecond = 1e3;

/// A force that a limit only shortened is stored as its z, and for x and y as its distance from the
/// direction of the wanted force, in whole parts of a newton: 2^60, so that the division loses no
/// bit.
inline constexpr std::int64_t kPartsPerNewton = std::int64_t{1} << 60;

}  // namespace dibhr
