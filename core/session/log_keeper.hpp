// Flushes and merges a session's write-ahead log on a thread of its own.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "core/sqlite/database.hpp"

namespace dibhr {

/// A busy disk takes seconds to flush a file. So the writer flushes nothing itself: every commit
/// survives the end of the program at once, and a power cut after some seconds, by the keeper.
class LogKeeper {
  public:
    /// `session`: in write-ahead mode, with its log, which no other code merges
    /// (`PRAGMA wal_autocheckpoint = 0`). Throws DatabaseError.
    explicit LogKeeper(const std::filesystem::path& session);
    ~LogKeeper();
    LogKeeper(const LogKeeper&) = delete;
    LogKeeper& operator=(const LogKeeper&) = delete;

    /// Begins a transaction of the writer. Waits while the log is being emptied, for 0.15 s at
    /// most. Throws DatabaseError when the transaction cannot begin, or flushing failed.
    void begin(Database& writer);

  private:
    /// Closed with it; -1: none.
    struct Descriptor {
        int number{-1};
        ~Descriptor();
    };

    void run();
    void flush();
    void empty();
    [[nodiscard]] bool log_is_long() const;

    Database database_;
    Descriptor log_{};  ///< the log's file

    std::mutex mutex_{};
    std::condition_variable changed_{};
    bool stopping_{false};         // under the mutex, as the rest
    bool pause_requested_{false};  ///< a pause of the writer
    bool paused_{false};
    /// All of the log may be merged: the next transaction may write over it from its beginning.
    bool may_be_overwritten_{false};
    std::string failure_{};
    std::thread thread_{};
};

}  // namespace dibhr
