// SQLite's objects with owners: the one connection, the one statement and the one reader of large
// values; errors as text.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_blob;
struct sqlite3_stmt;

namespace dibhr {

/// The message of SQLite or the system, without a file's name, which the caller adds.
class DatabaseError : public std::runtime_error {
  public:
    enum class Cause {
        other,
        damaged,
        too_much_work,  ///< a query took more steps than its limit
        too_long,       ///< a value is longer than the limit
        cannot_open,    ///< the file, or its log
        disk,           ///< it is full, or fails
    };

    explicit DatabaseError(const std::string& words, Cause cause = Cause::other)
        : std::runtime_error(words), cause_(cause) {}

    [[nodiscard]] Cause cause() const noexcept { return cause_; }

  private:
    Cause cause_;
};

/// Whether a file begins as a database does; false also for one that cannot be read.
[[nodiscard]] bool is_database(const std::filesystem::path& file);
/// The bytes on the disk of a database and its log; a missing file counts 0.
[[nodiscard]] std::uint64_t database_bytes(const std::filesystem::path& file);
/// Removes the file and all that SQLite puts beside it, as far as possible.
void remove_database(const std::filesystem::path& file);

/// The deleter of SQLite's objects.
struct SqliteCloser {
    void operator()(sqlite3* database) const noexcept;
    void operator()(sqlite3_stmt* statement) const noexcept;
    void operator()(sqlite3_blob* blob) const noexcept;
};
template <typename Handle>
using SqliteHandle = std::unique_ptr<Handle, SqliteCloser>;

/// The state of a write-ahead log after a merge into its file.
struct LogState {
    bool busy{false};        ///< another connection uses the log
    std::int64_t pages{0};   ///< in the log
    std::int64_t merged{0};  ///< pages of them in the file
};

/// One connection, for one thread at a time. Every failure, of its statements too, throws
/// DatabaseError, or the exception of the connection's ErrorHandler.
class Database {
  public:
    /// Throws the owner's exception, mostly an InputError with the file and the error.
    using ErrorHandler = std::function<void(const DatabaseError& error)>;

    /// How long a call waits for another connection's transaction.
    static constexpr int kBusyTimeout_ms = 2000;

    /// Options to read a file from an unknown source.
    struct ReadOnly {
        bool complete{false};  ///< no log belongs to it: no file beside it is made or read
        int longest_bytes{0};  ///< as for restrict_untrusted()
        int busy_timeout_ms{kBusyTimeout_ms};
    };

    /// A database of its own, empty, on the disk only as far as its memory is too small for it.
    struct Scratch {
        std::filesystem::path in_place_of{};  ///< the size of that file limits a query's steps
        int longest_bytes{0};                 ///< as for restrict_untrusted()
    };

    /// Opens an existing file for reading and writing; an empty file is an empty database.
    explicit Database(const std::filesystem::path& file, ErrorHandler refuse = {});
    /// Opens an existing file, which stays as it is.
    Database(const std::filesystem::path& file, const ReadOnly& how, ErrorHandler refuse = {});
    explicit Database(const Scratch& how, ErrorHandler refuse = {});

    /// Treats the file as untrusted from now on: its tables run no code, every cell is checked, no
    /// value is longer than `longest_bytes`, and the steps of a query are limited by the size of
    /// the file and its log.
    void restrict_untrusted(int longest_bytes);
    /// Runs statements that give no rows.
    void execute(const std::string& sql) const;
    /// The number that is the result of a query.
    [[nodiscard]] std::int64_t number(std::string_view sql) const;
    /// Merges the pages that no other connection reads, without waiting; `cut`: all pages, and
    /// empties the log.
    LogState merge_log(bool cut);

  private:
    friend class Statement;
    friend class BlobReader;

    void open(const std::string& name, int flags, int busy_timeout_ms);
    [[nodiscard]] SqliteHandle<sqlite3_stmt> prepared(std::string_view sql) const;
    /// Sets the step limit of the next query.
    void allow_work() const;
    /// As text: "disk I/O error (File too large)".
    [[nodiscard]] DatabaseError last_error() const;
    [[noreturn]] void fail(const DatabaseError& error) const;
    [[noreturn]] void fail() const { fail(last_error()); }

    std::filesystem::path file_;
    ErrorHandler on_error_;
    bool writes_{false};
    /// Checks left to the running query; null: trusted, no limit. Outlives the connection.
    std::unique_ptr<std::uint64_t> checks_left_{};
    SqliteHandle<sqlite3> handle_{};
};

/// A value that is stored as a real even if it is a whole number: an integer in that column means
/// something else. Nothing: NULL.
struct SqlReal {
    std::optional<double> value{};
};

/// Bytes that are no text.
struct SqlBytes {
    std::string_view value{};
};

/// A prepared statement; must not outlive its database, which must not be moved. A failure throws
/// as Database does. Values are bound one after the other, each in the shortest form that gives the
/// same bits again: columns without a type keep them as they are.
class Statement {
  public:
    enum class Type { null, integer, real, text };  ///< text: also bytes

    Statement(const Database& database, std::string_view sql);

    void bind(std::string_view text) noexcept;
    template <std::integral Integer>
    void bind(Integer value) noexcept {
        bind_integer(static_cast<std::int64_t>(value));
    }
    /// Not a number becomes infinity: a database has no such thing.
    void bind(double value) noexcept;
    /// Nothing: NULL.
    void bind(const std::optional<std::int64_t>& value) noexcept;
    void bind(const SqlReal& real) noexcept;
    void bind(const SqlBytes& bytes) noexcept;
    template <typename First, typename Second, typename... More>
    void bind(const First& first, const Second& second, const More&... more) {
        bind(first);
        bind(second, more...);
    }
    /// NULL where the value equals `follows`, which the reader computes.
    void bind_unless(double value, double follows) noexcept;
    void bind_unless(std::int64_t value, std::optional<std::int64_t> follows) noexcept;

    /// Runs it once with these values, after those that are bound already, and makes it ready for
    /// the next row.
    template <typename... Values>
    void run(const Values&... values) {
        (bind(values), ...);
        run_once();
    }

    /// Goes to the next row of the result; false after the last one.
    [[nodiscard]] bool next();

    // Columns of the result count from 0.
    [[nodiscard]] int columns() const noexcept;
    [[nodiscard]] std::string name(int column) const;

    // The values of the row.
    [[nodiscard]] Type type(int column) const noexcept;
    [[nodiscard]] bool has(int column) const noexcept { return type(column) != Type::null; }
    [[nodiscard]] double real(int column) const noexcept;
    [[nodiscard]] std::int64_t integer(int column) const noexcept;
    /// Numbers, too, as text.
    [[nodiscard]] std::string text(int column) const;
    /// Bytes that are no text.
    [[nodiscard]] std::string bytes(int column) const;

  private:
    void bind_integer(std::int64_t value) noexcept;
    void bind_null() noexcept;
    void run_once();

    const Database& database_;
    int bound_{0};  ///< values so far
    SqliteHandle<sqlite3_stmt> handle_;
};

/// The values of one column of a table, row by row, each read only as far as it is wanted; must not
/// outlive its database.
class BlobReader {
  public:
    BlobReader(const Database& database, std::string table, std::string column);

    /// Goes to that row: how many bytes its value has.
    [[nodiscard]] std::size_t open(std::int64_t row);
    /// The value's first bytes; `to` is no longer than that.
    void read(std::span<std::uint8_t> to) const;

  private:
    const Database& database_;
    std::string table_, column_;
    SqliteHandle<sqlite3_blob> handle_{};
};

}  // namespace dibhr
