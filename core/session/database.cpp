// SQLite with owners: an open file and a prepared statement, errors as exceptions in plain words.
#include "core/session/database.hpp"

#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/session/tick_record.hpp"

namespace dibhr {

namespace {

// Someone who reads the session while it is recorded may hold it for a moment.
constexpr int kPatience_ms = 2000;

/// What of it is recorded: a database has no such thing as "no number".
double recordable(double value) noexcept {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

}  // namespace

void SqliteCloser::operator()(sqlite3* database) const noexcept {
    sqlite3_close_v2(database);
}

void SqliteCloser::operator()(sqlite3_stmt* statement) const noexcept {
    sqlite3_finalize(statement);
}

Database::Database(const std::filesystem::path& file) {
    sqlite3* handle = nullptr;
    const int result = sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK) {
        throw DatabaseError(handle == nullptr ? sqlite3_errstr(result) : last_error());
    }
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, kPatience_ms);
}

void Database::execute(const std::string& sql) {
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
        throw DatabaseError(last_error());
    }
}

std::int64_t Database::number(const std::string& sql) {
    const Statement question(*this, sql);
    if (sqlite3_step(question.handle_.get()) != SQLITE_ROW) throw DatabaseError(last_error());
    return sqlite3_column_int64(question.handle_.get(), 0);
}

LogState Database::merge_log(bool cut) {
    int pages = 0;
    int merged = 0;
    const int mode = cut ? SQLITE_CHECKPOINT_TRUNCATE : SQLITE_CHECKPOINT_PASSIVE;
    const int result = sqlite3_wal_checkpoint_v2(handle_.get(), nullptr, mode, &pages, &merged);
    const bool busy = (result & 0xff) == SQLITE_BUSY;  // whatever keeps it busy
    if (result != SQLITE_OK && !busy) throw DatabaseError(last_error());
    return {busy, pages, merged};
}

std::string Database::last_error() const {
    std::string words = sqlite3_errmsg(handle_.get());
    const int error = sqlite3_system_errno(handle_.get());
    if (error != 0) words += std::string(" (") + std::strerror(error) + ")";
    return words;
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
    sqlite3_stmt* handle = nullptr;
    const int result = sqlite3_prepare_v2(database.handle_.get(), sql.data(),
                                          static_cast<int>(sql.size()), &handle, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK) throw DatabaseError(database.last_error());
}

void Statement::cell(std::string_view text) noexcept {
    sqlite3_bind_text(handle_.get(), ++cells_, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
}

void Statement::cell(double value) noexcept {
    constexpr double kShortest = 1e9;  // in five bytes instead of eight
    const auto whole = std::abs(value) < kShortest ? static_cast<std::int64_t>(value) : 0;
    if (same_bits(static_cast<double>(whole), value)) {
        integer(whole);
    } else {
        plain_real(value);
    }
}

void Statement::cell(const std::optional<std::int64_t>& value) noexcept {
    value ? integer(*value) : null();
}

void Statement::plain_real(double value) noexcept {
    sqlite3_bind_double(handle_.get(), ++cells_, recordable(value));
}

void Statement::time(double value, double nanoseconds) noexcept {
    const auto whole = whole_nanoseconds(value, nanoseconds);
    whole ? integer(*whole) : plain_real(value);
}

void Statement::real_unless(double value, double follows) noexcept {
    same_bits(recordable(value), follows) ? null() : cell(value);
}

void Statement::integer_unless(std::int64_t value, std::optional<std::int64_t> follows) noexcept {
    value == follows ? null() : integer(value);
}

void Statement::integer(std::int64_t value) noexcept {
    sqlite3_bind_int64(handle_.get(), ++cells_, value);
}

void Statement::null() noexcept {
    sqlite3_bind_null(handle_.get(), ++cells_);
}

void Statement::run_once() {
    cells_ = 0;
    const int result = sqlite3_step(handle_.get());
    const std::string words =
        result == SQLITE_DONE || result == SQLITE_ROW ? "" : database_.last_error();
    sqlite3_reset(handle_.get());
    if (!words.empty()) throw DatabaseError(words);
}

std::optional<std::int64_t> whole_nanoseconds(double value, double nanoseconds) noexcept {
    constexpr double kMost = 9e15;  // beyond, a real has no whole nanoseconds
    const double count = std::round(value * nanoseconds);
    const auto whole = std::abs(count) < kMost ? static_cast<std::int64_t>(count) : 0;
    if (!same_bits(static_cast<double>(whole) / nanoseconds, value)) return std::nullopt;
    return whole;
}

}  // namespace dibhr
