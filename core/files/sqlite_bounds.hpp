// What keeps a database that anybody may have made from running anything, or for ever.
#pragma once

#include <cstdint>
#include <filesystem>

struct sqlite3;

namespace dibhr {

/// On one connection, which it outlives, in one place.
class SqliteBounds {
  public:
    SqliteBounds() = default;
    SqliteBounds(const SqliteBounds&) = delete;
    SqliteBounds& operator=(const SqliteBounds&) = delete;

    /// From here on its tables run nothing, every cell is checked, no value is longer than that,
    /// and a question ends with SQLITE_INTERRUPT after as many steps as are allowed: none yet.
    void hold(sqlite3* database, int longest_bytes) noexcept;
    /// The next question may take so many steps of SQLite's machine.
    void allow(std::uint64_t steps) noexcept;

  private:
    static int is_work_over(void* bounds) noexcept;

    std::uint64_t looks_left_{0};  ///< at the work of the question being answered
};

/// Steps that a question about this file and its log may take at most, as all that they can hold is
/// worth.
[[nodiscard]] std::uint64_t work_worth(const std::filesystem::path& file);

}  // namespace dibhr
