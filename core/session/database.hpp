// SQLite with owners: an open file and a prepared statement, errors as exceptions in plain words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace dibhr {

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
    struct Closer {
        void operator()(sqlite3* handle) const noexcept;
    };
    std::unique_ptr<sqlite3, Closer> handle_{};
};

/// A prepared statement; must not outlive its database. Parameters count from 1.
class Statement {
  public:
    Statement(Database& database, std::string_view sql);

    void bind(int parameter, double value) noexcept;
    void bind(int parameter, std::int64_t value) noexcept;
    void bind(int parameter, std::string_view value) noexcept;
    void bind_null(int parameter) noexcept;
    /// Runs it once and makes it ready to run again; throws DatabaseError.
    void run();

  private:
    struct Finalizer {
        void operator()(sqlite3_stmt* handle) const noexcept;
    };
    Database& database_;
    std::unique_ptr<sqlite3_stmt, Finalizer> handle_{};
};

}  // namespace dibhr
