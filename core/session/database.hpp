// SQLite with owners: an open file and a prepared statement, errors as exceptions in plain words;
// and what brings a session's write-ahead log to the disk from a thread of its own.
#pragma once

#include <concepts>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "core/files/sqlite_bounds.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace dibhr {

/// Owners' way to let go of what SQLite opened.
struct SqliteCloser {
    void operator()(sqlite3* database) const noexcept;
    void operator()(sqlite3_stmt* statement) const noexcept;
};
using SqliteDatabase = std::unique_ptr<sqlite3, SqliteCloser>;
using SqliteStatement = std::unique_ptr<sqlite3_stmt, SqliteCloser>;

/// What SQLite and the system said, without a file's name: whoever knows the file adds it.
class DatabaseError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A write-ahead log after some of it was merged into its file.
struct LogState {
    bool busy{false};        ///< somebody is in the way
    std::int64_t pages{0};   ///< in the log
    std::int64_t merged{0};  ///< of them
};

/// One connection, for one thread at a time.
class Database {
  public:
    /// Opens an existing file for reading and writing; an empty file is an empty database.
    explicit Database(const std::filesystem::path& file);

    /// From here on the file is taken for anybody's (SqliteBounds): its tables run nothing, no
    /// value is longer than that, and a question ends after the work that all of the file is worth.
    void distrust(int longest_bytes);
    /// Runs statements that give no rows; throws DatabaseError.
    void execute(const std::string& sql);
    /// The one number that a question gives; throws DatabaseError.
    [[nodiscard]] std::int64_t number(const std::string& sql);
    /// Merges what nobody else still reads and does not wait; `cut`: all of it, and empties the
    /// log. Throws DatabaseError.
    LogState merge_log(bool cut);
    /// The words for the last failure: "disk I/O error (File too large)".
    [[nodiscard]] std::string last_error() const;

  private:
    friend class Statement;
    friend class Rows;
    [[nodiscard]] SqliteStatement prepared(std::string_view sql);
    void allow_work();

    std::filesystem::path file_;
    std::unique_ptr<SqliteBounds> bounds_{};  ///< null: trusted; outlives the connection
    SqliteDatabase handle_{};
};

/// What a question's row holds. Columns count from 0.
class SqliteRow {
  public:
    [[nodiscard]] bool has(int column) const noexcept;  ///< a value, not NULL
    [[nodiscard]] double real(int column) const noexcept;
    [[nodiscard]] std::int64_t integer(int column) const noexcept;
    /// Numbers, too, as text.
    [[nodiscard]] std::string text(int column) const;
    /// Of what is no text.
    [[nodiscard]] std::string bytes(int column) const;

  protected:
    SqliteRow() = default;
    explicit SqliteRow(SqliteStatement statement) noexcept : statement_(std::move(statement)) {}
    SqliteStatement statement_{};
};

/// The rows of a question, one after the other; must not outlive its database.
class Rows : public SqliteRow {
  public:
    /// Throws DatabaseError, as next() does.
    Rows(Database& database, std::string_view sql);

    /// False after the last row.
    [[nodiscard]] bool next();

  private:
    Database& database_;
};

/// A prepared statement that writes; must not outlive its database. Takes the cells of a row one
/// after the other, each in the shortest form that gives the same bits again: columns without a
/// type keep them as they are.
class Statement {
  public:
    Statement(Database& database, std::string_view sql);

    /// Runs it once with these cells, after those it already has, and makes it ready for the next
    /// row. Throws DatabaseError.
    template <typename... Cells>
    void run(const Cells&... cells) {
        (cell(cells), ...);
        run_once();
    }

    void cell(std::string_view text) noexcept;
    template <std::integral Integer>
    void cell(Integer value) noexcept {
        integer(static_cast<std::int64_t>(value));
    }
    void cell(double value) noexcept;
    /// What is no text.
    void bytes(std::string_view bytes) noexcept;
    /// Nothing: no value.
    void cell(const std::optional<std::int64_t>& value) noexcept;
    /// Also a whole number as a real, where an integer means something else.
    void plain_real(double value) noexcept;
    /// A time as whole nanoseconds, of which its unit has `nanoseconds`.
    void time(double value, double nanoseconds) noexcept;
    /// No value where it equals what the view takes instead.
    void real_unless(double value, double follows) noexcept;
    void integer_unless(std::int64_t value, std::optional<std::int64_t> follows) noexcept;

  private:
    friend class Database;
    void integer(std::int64_t value) noexcept;
    void null() noexcept;
    void run_once();

    Database& database_;
    int cells_{0};  ///< of the row so far
    SqliteStatement handle_{};
};

/// A time in nanoseconds, of which its unit has `nanoseconds`, where the same bits come of them.
[[nodiscard]] std::optional<std::int64_t> whole_nanoseconds(double value,
                                                            double nanoseconds) noexcept;

/// A busy disk takes seconds to flush what was written. A writer that flushes nothing itself has
/// every commit safe from the end of the program at once, and through the keeper from a power cut
/// within some seconds.
class LogKeeper {
  public:
    /// `session`: in write-ahead mode, with its log, and merged by nobody else
    /// (`PRAGMA wal_autocheckpoint = 0`). Throws DatabaseError.
    explicit LogKeeper(const std::filesystem::path& session);
    ~LogKeeper();
    LogKeeper(const LogKeeper&) = delete;
    LogKeeper& operator=(const LogKeeper&) = delete;

    /// Begins a transaction of the one who writes. Waits while the log is being emptied, for 0.15 s
    /// at most. Throws DatabaseError when that fails, or flushing failed.
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
    bool leaving_{false};  // under the mutex, as the rest
    bool wanted_{false};   ///< a pause of the writer
    bool paused_{false};
    /// All of the log may be merged: the next transaction may write over it from its beginning.
    bool may_be_written_over_{false};
    std::string failure_{};
    std::thread thread_{};
};

}  // namespace dibhr
