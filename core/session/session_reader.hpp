// A session file open for reading, which stays as it is: SQLite with owners and errors in plain
// words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/files/sqlite_bounds.hpp"
#include "core/session/database.hpp"

namespace dibhr {

/// One session, read while it is recorded or afterwards, by one thread at a time.
class SessionReader {
  public:
    /// Throws InputError for a file that is missing, cut short, damaged, no session of this
    /// version, or made to keep a reader busy.
    explicit SessionReader(const std::filesystem::path& file);
    SessionReader(const SessionReader&) = delete;  // its database knows it by its address
    SessionReader& operator=(const SessionReader&) = delete;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
    enum class Log {
        none,     ///< the recording ended, which merged it
        needed,   ///< the recording goes on, or was broken off
        absent,   ///< likewise, and it is not beside the file: merged by others, or not copied
        foreign,  ///< beside a file whose recording ended: another one's, and not read
    };
    [[nodiscard]] Log log() const noexcept { return log_; }

    /// Looks through the whole file. Throws InputError when it is damaged.
    void check() const;

    class Query;
    enum class Kind { nothing, integer, real, text };

  private:
    void read_head();
    void check_kind() const;
    void check_tables() const;
    /// For one question: as many steps as all that the file can hold are worth.
    void allow_work() const;
    /// Foreign, or damaged: by what SQLite said last.
    [[noreturn]] void refuse() const;
    [[noreturn]] void refuse(const std::string& reason) const;
    [[noreturn]] void refuse_damaged(const std::string& words) const;

    std::filesystem::path file_;
    Log log_{Log::none};
    /// So that nothing of the file decides what is done with it, or for how long.
    mutable SqliteBounds bounds_{};
    SqliteDatabase database_{};
};

/// The rows of a question, one after the other; must not outlive its reader.
class SessionReader::Query : public SqliteRow {
  public:
    /// Throws InputError when the file holds no such tables or columns.
    Query(const SessionReader& reader, const std::string& sql);

    /// False after the last row. Throws InputError for a damaged file.
    [[nodiscard]] bool next();
    [[nodiscard]] Kind kind(int column) const noexcept;

    [[nodiscard]] int columns() const noexcept;
    [[nodiscard]] std::string name(int column) const;

  private:
    const SessionReader& reader_;
};

}  // namespace dibhr
