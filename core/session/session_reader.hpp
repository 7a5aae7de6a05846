// A session file open for reading, which stays as it is; its errors as sentences.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/sqlite/database.hpp"

namespace dibhr {

/// One session, read while it is recorded or afterwards, by one thread at a time. A file of an
/// earlier schema has the tables and columns of this one in the reader's memory; a file of a later
/// one is read through its own view `tick`. FORMAT.md states the rule.
class SessionReader {
  public:
    /// Throws InputError for a file that is missing, cut short, damaged, no session, or made to
    /// keep a reader busy.
    explicit SessionReader(const std::filesystem::path& file);
    SessionReader(const SessionReader&) = delete;  // its database refers to it
    SessionReader& operator=(const SessionReader&) = delete;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
    enum class Log {
        none,     ///< the recording ended, which merged it
        needed,   ///< the recording goes on, or was broken off
        absent,   ///< likewise, and it is not beside the file: merged by others, or not copied
        foreign,  ///< beside a file whose recording ended: of another file, and not read
    };
    [[nodiscard]] Log log() const noexcept { return log_; }

    /// What a file of another schema does not hold, or holds and this reader does not read: "is of
    /// ...". Empty: it is of this schema.
    [[nodiscard]] const std::string& other_schema() const noexcept { return other_schema_; }

    /// Checks the whole file. Throws InputError when it is damaged.
    void check() const;

    /// The rows of a query; must not outlive this reader. Throws InputError when the file holds no
    /// such tables or columns, and while the rows are read when it is damaged.
    [[nodiscard]] Statement rows(std::string_view sql) const { return {database_, sql}; }

  private:
    /// The state of the log by the file's head. Refuses a file that must not be opened.
    [[nodiscard]] Log log_by_head() const;
    void check_kind() const;
    void read_first_schema();
    void check_view();
    /// Requires ordinary tables: a view could be endless, a hidden column be computed.
    void require_tables(std::span<const std::string_view> names) const;
    /// Tables and columns of the file that this schema lacks, as a list; empty: none.
    [[nodiscard]] std::string unknown_parts() const;
    /// Refuses a foreign or damaged file.
    [[noreturn]] void refuse(const DatabaseError& error) const;
    [[noreturn]] void refuse(const std::string& reason) const;
    [[noreturn]] void refuse_damaged(const std::string& words) const;

    std::filesystem::path file_;
    std::int64_t schema_{0};  ///< `PRAGMA user_version`; before what follows, whose errors name it
    Log log_;
    std::string other_schema_{};
    Database database_;
};

}  // namespace dibhr
