// Bounds by SQLite's own means: sqlite.org/security.html, "untrusted SQLite database files".
#include "core/files/sqlite_bounds.hpp"

#include <sqlite3.h>

#include <system_error>

namespace dibhr {

namespace {

constexpr int kStepsPerLook = 10'000;

}  // namespace

void SqliteBounds::hold(sqlite3* database, int longest_bytes) noexcept {
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_exec(database, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, longest_bytes);
    sqlite3_progress_handler(database, kStepsPerLook, &SqliteBounds::is_work_over, this);
}

void SqliteBounds::allow(std::uint64_t steps) noexcept {
    looks_left_ = steps / kStepsPerLook;
}

int SqliteBounds::is_work_over(void* bounds) noexcept {
    std::uint64_t& left = static_cast<SqliteBounds*>(bounds)->looks_left_;
    if (left == 0) return 1;
    --left;
    return 0;
}

std::uint64_t work_worth(const std::filesystem::path& file) {
    constexpr std::uint64_t kStepsAnyway = 20'000'000;
    constexpr std::uint64_t kStepsPerByte = 100;  // ten times what a session's longest row takes
    std::uint64_t bytes = 0;
    for (const char* const ending : {"", "-wal"}) {
        std::error_code failed;
        const std::uint64_t there = std::filesystem::file_size(file.string() + ending, failed);
        if (!failed) bytes += there;
    }
    return kStepsAnyway + kStepsPerByte * bytes;
}

}  // namespace dibhr
