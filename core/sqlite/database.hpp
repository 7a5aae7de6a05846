// SQLite with owners: the one connection, the one statement and the one reader of large values;
// errors in plain words.
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

/// What SQLite and the system said, without a file's name: whoever knows the file adds it.
class DatabaseError : public std::runtime_error {
  public:
    enum class Cause {
        other,
        damaged,
        endless,      ///< a question took more work than it may
        too_long,     ///< a value is longer than any may be
        cannot_open,  ///< the file, or its log
    };

    explicit DatabaseError(const std::string& words, Cause cause = Cause::other)
        : std::runtime_error(words), cause_(cause) {}

    [[nodiscard]] Cause cause() const noexcept { return cause_; }

  private:
    Cause cause_;
};

/// Whether a file begins as a database does; false for one that is none or cannot be read.
[[nodiscard]] bool is_database(const std::filesystem::path& file);
/// On the disk, with its log; what is not there counts nothing.
[[nodiscard]] std::uint64_t database_bytes(const std::filesystem::path& file);
/// The file and all that SQLite puts beside it, as far as it is there and can be removed.
void remove_database(const std::filesystem::path& file);

/// Owners' way to let go of what SQLite opened.
struct SqliteCloser {
    void operator()(sqlite3* database) const noexcept;
    void operator()(sqlite3_stmt* statement) const noexcept;
    void operator()(sqlite3_blob* blob) const noexcept;
};
template <typename Handle>
using SqliteHandle = std::unique_ptr<Handle, SqliteCloser>;

/// A write-ahead log after some of it was merged into its file.
struct LogState {
    bool busy{false};        ///< somebody is in the way
    std::int64_t pages{0};   ///< in the log
    std::int64_t merged{0};  ///< of them
};

/// One connection, for one thread at a time. Whatever fails, of its statements too, throws
/// DatabaseError, or what the connection's Refusal makes of it.
class Database {
  public:
    /// Throws, mostly an InputError: the owner's sentence about the file, with the error in it.
    using Refusal = std::function<void(const DatabaseError& error)>;

    /// How long somebody else's transaction is waited for.
    static constexpr int kPatience_ms = 2000;

    /// How a file that anybody may have made is read.
    struct ReadOnly {
        bool complete{false};  ///< no log belongs to it: no file beside it is made or read
        int longest_bytes{0};  ///< as for distrust()
        int patience_ms{kPatience_ms};
    };

    /// Opens an existing file for reading and writing; an empty file is an empty database.
    explicit Database(const std::filesystem::path& file, Refusal refuse = {});
    /// Opens an existing file, which stays as it is.
    Database(const std::filesystem::path& file, const ReadOnly& how, Refusal refuse = {});

    /// From here on the file is taken for anybody's: its tables run nothing, every cell is checked,
    /// no value is longer than that, and a question ends after the work that all of the file and
    /// its log is worth.
    void distrust(int longest_bytes);
    /// Runs statements that give no rows.
    void execute(const std::string& sql) const;
    /// The one number that a question gives.
    [[nodiscard]] std::int64_t number(std::string_view sql) const;
    /// Merges what nobody else still reads and does not wait; `cut`: all of it, and empties the
    /// log.
    LogState merge_log(bool cut);

  private:
    friend class Statement;
    friend class BlobReader;

    void open(const std::string& name, int flags, int patience_ms);
    [[nodiscard]] SqliteHandle<sqlite3_stmt> prepared(std::string_view sql) const;
    /// For one question.
    void allow_work() const;
    /// In words: "disk I/O error (File too large)".
    [[nodiscard]] DatabaseError last_error() const;
    [[noreturn]] void fail(const DatabaseError& error) const;
    [[noreturn]] void fail() const { fail(last_error()); }

    std::filesystem::path file_;
    Refusal refuse_;
    bool writes_{false};
    /// Left to the question being answered, at its work; null: trusted. Outlives the connection.
    std::unique_ptr<std::uint64_t> looks_left_{};
    SqliteHandle<sqlite3> handle_{};
};

/// A value that is stored as a real, also a whole number, where an integer means something else;
/// nothing: NULL.
struct SqlReal {
    std::optional<double> value{};
};

/// What is no text.
struct SqlBytes {
    std::string_view value{};
};

/// A prepared statement; must not outlive its database, which stays in its place. What fails is
/// refused as Database says. Values are bound one after the other, each in the shortest form that
/// gives the same bits again: columns without a type keep them as they are.
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
    /// NULL where it equals what a reader takes instead.
    void bind_unless(double value, double follows) noexcept;
    void bind_unless(std::int64_t value, std::optional<std::int64_t> follows) noexcept;

    /// Runs it once with these values, after those that are bound already, and makes it ready for
    /// the next row.
    template <typename... Values>
    void run(const Values&... values) {
        (bind(values), ...);
        run_once();
    }

    /// Goes to the answer's next row; false after the last one.
    [[nodiscard]] bool next();

    // The answer's columns count from 0.
    [[nodiscard]] int columns() const noexcept;
    [[nodiscard]] std::string name(int column) const;

    // What the row holds.
    [[nodiscard]] Type type(int column) const noexcept;
    [[nodiscard]] bool has(int column) const noexcept { return type(column) != Type::null; }
    [[nodiscard]] double real(int column) const noexcept;
    [[nodiscard]] std::int64_t integer(int column) const noexcept;
    /// Numbers, too, as text.
    [[nodiscard]] std::string text(int column) const;
    /// Of what is no text.
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
