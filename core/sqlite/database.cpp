// SQLite's objects with owners. Untrusted files are limited by SQLite's own means:
// sqlite.org/security.html, "untrusted SQLite database files".
#include "core/sqlite/database.hpp"

#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr int kStepsPerCheck = 10'000;  ///< of SQLite's machine

/// Infinity for no number, which a database cannot store.
double storable(double value) noexcept {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

/// The sign of a zero counts, too.
bool are_same(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// A text if the file-size limit is met, which SQLite does not report; else empty.
std::string file_size_limit_met(sqlite3* database) {
    constexpr rlim_t kStep = 32768;  // by which a session's files grow at once, at most
    const char* const file = sqlite3_db_filename(database, "main");
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    if (file == nullptr || limit.rlim_cur == RLIM_INFINITY) return {};
    for (const char* const ending : {"", "-wal", "-shm"}) {
        struct stat found {};
        const bool there = ::stat((std::string(file) + ending).c_str(), &found) == 0;
        if (there && static_cast<rlim_t>(found.st_size) + kStep > limit.rlim_cur) {
            return "the file-size limit of " + std::to_string(limit.rlim_cur) +
                   " bytes is met, see ulimit -f";
        }
    }
    return {};
}

std::string read_only_uri(const std::filesystem::path& file, bool complete) {
    std::error_code gone;  // of the working directory: the name is then taken as it is given
    const std::filesystem::path whole = std::filesystem::absolute(file, gone);
    return "file:" + percent_encoded((gone ? file : whole).string()) + "?mode=ro" +
           (complete ? "&immutable=1" : "");
}

/// The most steps of a query, by the size of the file and its log.
std::uint64_t work_worth(const std::filesystem::path& file) {
    constexpr std::uint64_t kStepsAnyway = 20'000'000;
    constexpr std::uint64_t kStepsPerByte = 100;  // ten times what a session's longest row takes
    return kStepsAnyway + kStepsPerByte * database_bytes(file);
}

int is_work_over(void* checks_left) noexcept {
    std::uint64_t& left = *static_cast<std::uint64_t*>(checks_left);
    if (left == 0) return 1;
    --left;
    return 0;
}

int primary(int code) noexcept {
    return code & 0xff;
}

DatabaseError::Cause cause_of(int code) noexcept {
    using Cause = DatabaseError::Cause;
    switch (code) {
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return Cause::damaged;
        case SQLITE_INTERRUPT:
            return Cause::too_much_work;
        case SQLITE_TOOBIG:
            return Cause::too_long;
        case SQLITE_CANTOPEN:
            return Cause::cannot_open;
        case SQLITE_FULL:
        case SQLITE_IOERR:
            return Cause::disk;
        default:
            return Cause::other;
    }
}

}  // namespace

bool is_database(const std::filesystem::path& file) {
    constexpr std::string_view kMagic = "SQLite format 3";  // SQLite's file format, section 1.3
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(file, unknown)) return false;
    std::array<char, kMagic.size()> head{};
    std::ifstream(file, std::ios::binary).read(head.data(), head.size());
    return std::string_view(head.data(), head.size()) == kMagic;
}

std::uint64_t database_bytes(const std::filesystem::path& file) {
    std::uint64_t total = 0;
    for (const char* const ending : {"", "-wal"}) {
        std::error_code failed;
        const std::uint64_t bytes = std::filesystem::file_size(file.string() + ending, failed);
        if (!failed) total += bytes;
    }
    return total;
}

void remove_database(const std::filesystem::path& file) {
    std::error_code ignored;
    for (const char* const ending : {"", "-wal", "-shm", "-journal"})
        std::filesystem::remove(file.string() + ending, ignored);
}

void SqliteCloser::operator()(sqlite3* database) const noexcept {
    sqlite3_close_v2(database);
}

void SqliteCloser::operator()(sqlite3_stmt* statement) const noexcept {
    sqlite3_finalize(statement);
}

void SqliteCloser::operator()(sqlite3_blob* blob) const noexcept {
    sqlite3_blob_close(blob);
}

Database::Database(const std::filesystem::path& file, ErrorHandler refuse)
    : file_(file), on_error_(std::move(refuse)), writes_(true) {
    open(file.string(), SQLITE_OPEN_READWRITE, kBusyTimeout_ms);
}

Database::Database(const std::filesystem::path& file, const ReadOnly& how, ErrorHandler refuse)
    : file_(file), on_error_(std::move(refuse)) {
    open(read_only_uri(file, how.complete), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI,
         how.busy_timeout_ms);
    restrict_untrusted(how.longest_bytes);
}

Database::Database(const Scratch& how, ErrorHandler refuse)
    : file_(how.in_place_of), on_error_(std::move(refuse)), writes_(true) {
    open("", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, kBusyTimeout_ms);
    execute("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");
    restrict_untrusted(how.longest_bytes);
}

void Database::open(const std::string& name, int flags, int busy_timeout_ms) {
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(name.c_str(), &opened, flags, nullptr);
    handle_.reset(opened);
    if (opened == nullptr) fail(DatabaseError(sqlite3_errstr(result)));
    if (result != SQLITE_OK) fail();
    sqlite3_extended_result_codes(opened, 1);
    sqlite3_busy_timeout(opened, busy_timeout_ms);
}

void Database::restrict_untrusted(int longest_bytes) {
    if (!checks_left_) checks_left_ = std::make_unique<std::uint64_t>(0);
    sqlite3* const database = handle_.get();
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_exec(database, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, longest_bytes);
    sqlite3_progress_handler(database, kStepsPerCheck, is_work_over, checks_left_.get());
}

void Database::allow_work() const {
    if (checks_left_) *checks_left_ = work_worth(file_) / kStepsPerCheck;
}

SqliteHandle<sqlite3_stmt> Database::prepared(std::string_view sql) const {
    allow_work();
    sqlite3_stmt* handle = nullptr;
    const int result = sqlite3_prepare_v2(handle_.get(), sql.data(), static_cast<int>(sql.size()),
                                          &handle, nullptr);
    SqliteHandle<sqlite3_stmt> statement(handle);
    if (result != SQLITE_OK) fail();
    return statement;
}

void Database::execute(const std::string& sql) const {
    allow_work();
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Database::number(std::string_view sql) const {
    Statement question(*this, sql);
    if (!question.next()) fail();
    return question.integer(0);
}

LogState Database::merge_log(bool cut) {
    int pages = 0;
    int merged = 0;
    const int mode = cut ? SQLITE_CHECKPOINT_TRUNCATE : SQLITE_CHECKPOINT_PASSIVE;
    const int result = sqlite3_wal_checkpoint_v2(handle_.get(), nullptr, mode, &pages, &merged);
    const bool busy = primary(result) == SQLITE_BUSY;  // for any reason
    if (result != SQLITE_OK && !busy) fail();
    return {busy, pages, merged};
}

DatabaseError Database::last_error() const {
    const int code = primary(sqlite3_errcode(handle_.get()));
    if (writes_ && code == SQLITE_IOERR) {
        const std::string limit = file_size_limit_met(handle_.get());
        if (!limit.empty()) return DatabaseError(limit, DatabaseError::Cause::disk);
    }
    std::string words = sqlite3_errmsg(handle_.get());
    const int error = writes_ ? sqlite3_system_errno(handle_.get()) : 0;
    if (error != 0) words += std::string(" (") + std::strerror(error) + ")";
    return DatabaseError(words, cause_of(code));
}

void Database::fail(const DatabaseError& error) const {
    if (on_error_) on_error_(error);
    throw error;
}

Statement::Statement(const Database& database, std::string_view sql)
    : database_(database), handle_(database.prepared(sql)) {}

void Statement::bind(std::string_view text) noexcept {
    sqlite3_bind_text(handle_.get(), ++bound_, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
}

void Statement::bind(double value) noexcept {
    constexpr double kShortest = 1e9;  // in five bytes instead of eight
    const auto whole = std::abs(value) < kShortest ? static_cast<std::int64_t>(value) : 0;
    if (are_same(static_cast<double>(whole), value)) {
        bind_integer(whole);
    } else {
        bind(SqlReal{value});
    }
}

void Statement::bind(const std::optional<std::int64_t>& value) noexcept {
    value ? bind_integer(*value) : bind_null();
}

void Statement::bind(const SqlReal& real) noexcept {
    if (real.value)
        sqlite3_bind_double(handle_.get(), ++bound_, storable(*real.value));
    else
        bind_null();
}

void Statement::bind(const SqlBytes& bytes) noexcept {
    sqlite3_bind_blob(handle_.get(), ++bound_, bytes.value.data(),
                      static_cast<int>(bytes.value.size()), SQLITE_TRANSIENT);
}

void Statement::bind_unless(double value, double follows) noexcept {
    are_same(storable(value), follows) ? bind_null() : bind(value);
}

void Statement::bind_unless(std::int64_t value, std::optional<std::int64_t> follows) noexcept {
    value == follows ? bind_null() : bind_integer(value);
}

void Statement::bind_integer(std::int64_t value) noexcept {
    sqlite3_bind_int64(handle_.get(), ++bound_, value);
}

void Statement::bind_null() noexcept {
    sqlite3_bind_null(handle_.get(), ++bound_);
}

void Statement::run_once() {
    bound_ = 0;
    const int result = sqlite3_step(handle_.get());
    if (result == SQLITE_DONE || result == SQLITE_ROW) {
        sqlite3_reset(handle_.get());
        return;
    }
    const DatabaseError error = database_.last_error();
    sqlite3_reset(handle_.get());
    database_.fail(error);
}

bool Statement::next() {
    const int result = sqlite3_step(handle_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) database_.fail();
    return result == SQLITE_ROW;
}

int Statement::columns() const noexcept {
    return sqlite3_column_count(handle_.get());
}

std::string Statement::name(int column) const {
    return sqlite3_column_name(handle_.get(), column);
}

Statement::Type Statement::type(int column) const noexcept {
    switch (sqlite3_column_type(handle_.get(), column)) {
        case SQLITE_INTEGER:
            return Type::integer;
        case SQLITE_FLOAT:
            return Type::real;
        case SQLITE_NULL:
            return Type::null;
        default:
            return Type::text;
    }
}

double Statement::real(int column) const noexcept {
    return sqlite3_column_double(handle_.get(), column);
}

std::int64_t Statement::integer(int column) const noexcept {
    return sqlite3_column_int64(handle_.get(), column);
}

std::string Statement::text(int column) const {
    const unsigned char* const text = sqlite3_column_text(handle_.get(), column);
    const int bytes = sqlite3_column_bytes(handle_.get(), column);
    return text == nullptr ? std::string{} : std::string(text, text + bytes);
}

std::string Statement::bytes(int column) const {
    const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(handle_.get(), column));
    const int count = sqlite3_column_bytes(handle_.get(), column);
    return bytes == nullptr ? std::string{} : std::string(bytes, bytes + count);
}

BlobReader::BlobReader(const Database& database, std::string table, std::string column)
    : database_(database), table_(std::move(table)), column_(std::move(column)) {}

std::size_t BlobReader::open(std::int64_t row) {
    sqlite3_blob* opened = handle_.release();
    const int result = opened == nullptr
                           ? sqlite3_blob_open(database_.handle_.get(), "main", table_.c_str(),
                                               column_.c_str(), row, 0, &opened)
                           : sqlite3_blob_reopen(opened, row);
    handle_.reset(opened);
    if (result != SQLITE_OK) {
        const DatabaseError error = database_.last_error();
        handle_.reset();  // a handle that failed once fails for ever
        database_.fail(error);
    }
    return static_cast<std::size_t>(sqlite3_blob_bytes(handle_.get()));
}

void BlobReader::read(std::span<std::uint8_t> to) const {
    const int result = sqlite3_blob_read(handle_.get(), to.data(), static_cast<int>(to.size()), 0);
    if (result != SQLITE_OK) database_.fail();
}

}  // namespace dibhr
