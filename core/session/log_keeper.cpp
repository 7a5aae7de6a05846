// Flushes and merges a session's write-ahead log beside its writer.
#include "core/session/log_keeper.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>

namespace dibhr {

namespace {

constexpr auto kBetweenFlushes = std::chrono::seconds(1);
constexpr auto kLongestPause = std::chrono::milliseconds(150);
constexpr auto kPauseTimeout = std::chrono::milliseconds(500);
constexpr off_t kLongLog = off_t{4} << 20;  // [bytes]

[[noreturn]] void throw_system_error(const char* what) {
    throw DatabaseError(std::string(what) + " (" + std::strerror(errno) + ")");
}

}  // namespace

LogKeeper::Descriptor::~Descriptor() {
    if (number >= 0) ::close(number);
}

LogKeeper::LogKeeper(const std::filesystem::path& session) try : database_(session) {
    database_.execute("PRAGMA busy_timeout = 0; PRAGMA synchronous = NORMAL");
    database_.execute("SELECT count(*) FROM session");  // only now SQLite has opened the log
    log_.number = ::open((session.string() + "-wal").c_str(), O_RDONLY | O_CLOEXEC);
    if (log_.number < 0) throw_system_error("its log cannot be opened");
    thread_ = std::thread([this] { run(); });
} catch (const std::system_error& error) {
    throw DatabaseError(error.what());
}

LogKeeper::~LogKeeper() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LogKeeper::begin(Database& writer) {
    std::unique_lock lock(mutex_);
    if (pause_requested_) {
        paused_ = true;
        changed_.notify_all();
        changed_.wait_for(lock, kLongestPause, [this] { return !pause_requested_; });
        paused_ = pause_requested_ = false;
    }
    if (!failure_.empty()) throw DatabaseError(failure_);
    // Before the log is overwritten its new beginning is flushed: a power cut must not leave the
    // old beginning with some of the old pages. No other transaction waits for the disk.
    writer.execute(may_be_overwritten_ ? "PRAGMA synchronous = NORMAL; BEGIN IMMEDIATE"
                                       : "PRAGMA synchronous = OFF; BEGIN IMMEDIATE");
}

void LogKeeper::run() {
    pthread_setname_np(pthread_self(), "dibhr-log");
    std::unique_lock lock(mutex_);
    while (failure_.empty() &&
           !changed_.wait_for(lock, kBetweenFlushes, [this] { return stopping_; })) {
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
    if (::fdatasync(log_.number) == 0 || errno == EINVAL) return;  // EINVAL: not flushable
    throw_system_error("it cannot be flushed to the disk");
}

/// Most of the log is merged into the file while the writer goes on, the rest in a pause of it.
void LogKeeper::empty() {
    {
        const std::lock_guard lock(mutex_);
        may_be_overwritten_ = true;
    }
    database_.merge_log(false);
    std::unique_lock lock(mutex_);
    pause_requested_ = true;
    changed_.wait_for(lock, kPauseTimeout, [this] { return paused_ || stopping_; });
    if (paused_) {
        lock.unlock();
        const LogState state = database_.merge_log(false);
        lock.lock();
        // Nothing is left to be merged or flushed: cutting waits for no disk.
        const bool all = !state.busy && state.merged == state.pages;
        if (paused_ && all) may_be_overwritten_ = database_.merge_log(true).busy;
    }
    pause_requested_ = false;
    changed_.notify_all();
}

bool LogKeeper::log_is_long() const {
    struct stat log {};
    return ::fstat(log_.number, &log) == 0 && log.st_size >= kLongLog;
}

}  // namespace dibhr
