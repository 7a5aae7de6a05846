// Brings a session's write-ahead log to the disk, and empties it, from a thread of its own.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/session/database.hpp"

namespace dibhr {

/// A busy disk takes seconds to flush what was written. A writer that flushes nothing itself
/// (`PRAGMA synchronous = OFF; PRAGMA wal_autocheckpoint = 0`) has every commit safe from the end
/// of the program at once, and through the keeper from a power cut within some seconds.
class LogKeeper {
  public:
    /// `session`: in write-ahead mode, with its log. Throws DatabaseError.
    explicit LogKeeper(const std::filesystem::path& session);
    ~LogKeeper();
    LogKeeper(const LogKeeper&) = delete;
    LogKeeper& operator=(const LogKeeper&) = delete;

    /// To be called by the writer between two transactions. Waits while the log is being emptied,
    /// for 0.2 s at most.
    void between_transactions();

  private:
    void run();
    void keep();
    void empty();
    void checkpoint(const char* mode) noexcept;

    Database database_;
    int log_;  ///< the log's file, for flushing; -1: there is none

    std::mutex mutex_{};
    std::condition_variable changed_{};
    bool leaving_{false};  // under the mutex, as the next two
    bool wanted_{false};   ///< a pause of the writer
    bool paused_{false};
    std::thread thread_{};
};

}  // namespace dibhr
