// SQLite with owners, and the keeper of its write-ahead log.
#include "core/session/database.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>

#include "core/session/tick_record.hpp"

namespace dibhr {

namespace {

// Someone who reads the session while it is recorded may hold it for a moment.
constexpr int kPatience_ms = 2000;

/// What of it is recorded: a database has no such thing as "no number".
double recordable(double value) noexcept {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

constexpr auto kBetweenFlushes = std::chrono::seconds(1);
constexpr auto kLongestPause = std::chrono::milliseconds(150);
constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr off_t kLongLog = off_t{4} << 20;  // [bytes]

[[noreturn]] void throw_system_error(const char* what) {
    throw DatabaseError(std::string(what) + " (" + std::strerror(errno) + ")");
}

/// SQLite does not tell that a file may not grow.
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

}  // namespace

void SqliteCloser::operator()(sqlite3* database) const noexcept {
    sqlite3_close_v2(database);
}

void SqliteCloser::operator()(sqlite3_stmt* statement) const noexcept {
    sqlite3_finalize(statement);
}

Database::Database(const std::filesystem::path& file) : file_(file) {
    sqlite3* handle = nullptr;
    const int result = sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr);
    handle_.reset(handle);
    if (result != SQLITE_OK) {
        throw DatabaseError(handle == nullptr ? sqlite3_errstr(result) : last_error());
    }
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, kPatience_ms);
}

void Database::distrust(int longest_bytes) {
    bounds_ = std::make_unique<SqliteBounds>();
    bounds_->hold(handle_.get(), longest_bytes);
}

void Database::allow_work() {
    if (bounds_) bounds_->allow(work_worth(file_));
}

SqliteStatement Database::prepared(std::string_view sql) {
    allow_work();
    sqlite3_stmt* handle = nullptr;
    const int result = sqlite3_prepare_v2(handle_.get(), sql.data(), static_cast<int>(sql.size()),
                                          &handle, nullptr);
    SqliteStatement statement(handle);
    if (result != SQLITE_OK) throw DatabaseError(last_error());
    return statement;
}

void Database::execute(const std::string& sql) {
    allow_work();
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
    if ((sqlite3_errcode(handle_.get()) & 0xff) == SQLITE_IOERR) {
        if (std::string limit = file_size_limit_met(handle_.get()); !limit.empty()) return limit;
    }
    std::string words = sqlite3_errmsg(handle_.get());
    const int error = sqlite3_system_errno(handle_.get());
    if (error != 0) words += std::string(" (") + std::strerror(error) + ")";
    return words;
}

bool SqliteRow::has(int column) const noexcept {
    return sqlite3_column_type(statement_.get(), column) != SQLITE_NULL;
}

double SqliteRow::real(int column) const noexcept {
    return sqlite3_column_double(statement_.get(), column);
}

std::int64_t SqliteRow::integer(int column) const noexcept {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteRow::text(int column) const {
    const unsigned char* const text = sqlite3_column_text(statement_.get(), column);
    const int bytes = sqlite3_column_bytes(statement_.get(), column);
    return text == nullptr ? std::string{} : std::string(text, text + bytes);
}

std::string SqliteRow::bytes(int column) const {
    const auto* const bytes =
        static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int count = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr ? std::string{} : std::string(bytes, bytes + count);
}

Rows::Rows(Database& database, std::string_view sql)
    : SqliteRow(database.prepared(sql)), database_(database) {}

bool Rows::next() {
    const int result = sqlite3_step(statement_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) throw DatabaseError(database_.last_error());
    return result == SQLITE_ROW;
}

Statement::Statement(Database& database, std::string_view sql)
    : database_(database), handle_(database.prepared(sql)) {}

void Statement::cell(std::string_view text) noexcept {
    sqlite3_bind_text(handle_.get(), ++cells_, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
}

void Statement::bytes(std::string_view bytes) noexcept {
    sqlite3_bind_blob(handle_.get(), ++cells_, bytes.data(), static_cast<int>(bytes.size()),
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

LogKeeper::Descriptor::~Descriptor() {
    if (number >= 0) ::close(number);
}

LogKeeper::LogKeeper(const std::filesystem::path& session) try : database_(session) {
    database_.execute("PRAGMA busy_timeout = 0; PRAGMA synchronous = NORMAL");
    database_.execute("SELECT count(*) FROM session");  // only now it knows of the log
    log_.number = ::open((session.string() + "-wal").c_str(), O_RDONLY | O_CLOEXEC);
    if (log_.number < 0) throw_system_error("its log cannot be opened");
    thread_ = std::thread([this] { run(); });
} catch (const std::system_error& error) {
    throw DatabaseError(error.what());
}

LogKeeper::~LogKeeper() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LogKeeper::begin(Database& writer) {
    std::unique_lock lock(mutex_);
    if (wanted_) {
        paused_ = true;
        changed_.notify_all();
        changed_.wait_for(lock, kLongestPause, [this] { return !wanted_; });
        paused_ = wanted_ = false;
    }
    if (!failure_.empty()) throw DatabaseError(failure_);
    // Before a log is written over, its new beginning is flushed: a power cut must not leave the
    // old one with some of the old pages. Otherwise no transaction waits for the disk.
    writer.execute(may_be_written_over_ ? "PRAGMA synchronous = NORMAL; BEGIN IMMEDIATE"
                                        : "PRAGMA synchronous = OFF; BEGIN IMMEDIATE");
}

void LogKeeper::run() {
    pthread_setname_np(pthread_self(), "dibhr-log");
    std::unique_lock lock(mutex_);
    while (failure_.empty() &&
           !changed_.wait_for(lock, kBetweenFlushes, [this] { return leaving_; })) {
        lock.unlock();
        std::string failure;
        try {
            flush();
            if (log_is_long()) empty();
        } catch (const DatabaseError& error) {
            failure = error.what();
        }
        lock.lock();
        failure_ = failure;
    }
}

void LogKeeper::flush() {
    if (::fdatasync(log_.number) == 0 || errno == EINVAL) return;  // or there is no such thing
    throw_system_error("it cannot be flushed to the disk");
}

/// Most of the log is merged into the file while the writer goes on, the rest in a pause of it.
void LogKeeper::empty() {
    {
        const std::lock_guard lock(mutex_);
        may_be_written_over_ = true;
    }
    database_.merge_log(false);
    std::unique_lock lock(mutex_);
    wanted_ = true;
    changed_.wait_for(lock, kPatience, [this] { return paused_ || leaving_; });
    if (paused_) {
        lock.unlock();
        const LogState state = database_.merge_log(false);
        lock.lock();
        // Nothing is left to be merged or flushed: cutting waits for no disk.
        const bool all = !state.busy && state.merged == state.pages;
        if (paused_ && all) may_be_written_over_ = database_.merge_log(true).busy;
    }
    wanted_ = false;
    changed_.notify_all();
}

bool LogKeeper::log_is_long() const {
    struct stat log {};
    return ::fstat(log_.number, &log) == 0 && log.st_size >= kLongLog;
}

}  // namespace dibhr
