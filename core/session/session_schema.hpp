// The tables of a session file, as SQL.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace dibhr {

/// "dhap": the file says itself what it is (`PRAGMA application_id`).
inline constexpr int kSessionApplicationId = 0x64686170;
/// Counts changes of the tables (`PRAGMA user_version`, and `schema_version` in table session).
inline constexpr int kSessionSchemaVersion = 2;

/// Statements that make the tables of an empty database, and fill those that explain them. Ticks
/// are stored in `tick_data` without what follows from the rest of a row; the view `tick` gives
/// them whole.
[[nodiscard]] std::string session_schema();

/// What is read of a session are tables, so that reading ends; all but the view `tick`.
inline constexpr std::array<std::string_view, 8> kSessionTables{
    "session", "media", "source", "pair", "parameters", "tick_data", "clock", "mark"};

/// The statement that makes that view, as it stands in a session file: a reader refuses any other,
/// so that whoever changes it counts kSessionSchemaVersion up and still knows the one before.
[[nodiscard]] std::string tick_view();

/// Of `tick_data`.
inline constexpr int kTickDataColumns = 27;

/// How `tick_data.state` holds a tick's small facts; the view takes them apart. What is usual comes
/// first and is zero after that: one byte, also with the main button pressed.
namespace tick_state {
inline constexpr int kContact = 0;
inline constexpr int kPrimitive = 1;  // 2 bits
inline constexpr int kButtons = 3;    // 8 bits
inline constexpr int kNoSurface = 11;
inline constexpr int kNotReady = 12;
inline constexpr int kStandIn = 13;
inline constexpr int kFromZero = 14;
inline constexpr int kLetsGo = 15;
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

/// A force that a limit only shortened is stored as its z, and along x and y as whole such parts of
/// a newton by which it is off the direction of what was wanted: 2^60, so that dividing by it loses
/// nothing.
inline constexpr std::int64_t kPartsPerNewton = std::int64_t{1} << 60;

}  // namespace dibhr
