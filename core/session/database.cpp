// SQLite with owners: an open file and a prepared statement, errors as exceptions in plain words.
#include "core/session/database.hpp"

#include <sqlite3.h>

#include <cstdlib>
#include <cstring>

namespace dibhr {

namespace {

// Someone who reads the session while it is recorded may hold it for a moment.
constexpr int kPatience_ms = 2000;

}  // namespace

void Database::Closer::operator()(sqlite3* handle) const noexcept {
    sqlite3_close_v2(handle);
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
    std::int64_t value = 0;
    const auto keep = [](void* to, int columns, char** cells, char**) {
        if (columns > 0 && cells[0] != nullptr) {
            *static_cast<std::int64_t*>(to) = std::strtoll(cells[0], nullptr, 10);
        }
        return 0;
    };
    if (sqlite3_exec(handle_.get(), sql.c_str(), keep, &value, nullptr) != SQLITE_OK) {
        throw DatabaseError(last_error());
    }
    return value;
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

void Statement::Finalizer::operator()(sqlite3_stmt* handle) const noexcept {
    sqlite3_finalize(handle);
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
    sqlite3_stmt* handle = nullptr;
    const int result = sqlite3_prepare_v2(database.handle_.get(), sql.data(),
                                          static_cast<int>(sql.size()), &handle, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK) throw DatabaseError(database.last_error());
}

void Statement::bind(int parameter, double value) noexcept {
    sqlite3_bind_double(handle_.get(), parameter, value);
}

void Statement::bind(int parameter, std::int64_t value) noexcept {
    sqlite3_bind_int64(handle_.get(), parameter, value);
}

void Statement::bind(int parameter, std::string_view value) noexcept {
    sqlite3_bind_text(handle_.get(), parameter, value.data(), static_cast<int>(value.size()),
                      SQLITE_TRANSIENT);
}

void Statement::bind_null(int parameter) noexcept {
    sqlite3_bind_null(handle_.get(), parameter);
}

void Statement::run() {
    const int result = sqlite3_step(handle_.get());
    if (result != SQLITE_DONE && result != SQLITE_ROW) {
        const std::string words = database_.last_error();
        sqlite3_reset(handle_.get());
        throw DatabaseError(words);
    }
    sqlite3_reset(handle_.get());
}

}  // namespace dibhr
