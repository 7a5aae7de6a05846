// A session file open for reading, which stays as it is; its errors as sentences.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

/// The fact of what could not be read of a damaged session.
inline constexpr const char* kDamageFact = "damage";

/// It is a session's file as far as can be seen, and damaged.
class DamagedSession : public InputError {
  public:
    using InputError::InputError;
};

/// What is done with a damaged session: what can be read of it is, which takes the time to read
/// all of it, or it is refused.
enum class IfDamaged { rescue, refuse };

/// One session, read while it is recorded or afterwards, by one thread at a time. Of a damaged file
/// it has what can be read, as tables of its own; pages that are lost are missing rows. A file of
/// an earlier schema has the tables and columns of this one in the reader's memory; a file of a
/// later one is read through its own view `tick`. FORMAT.md states the rule.
class SessionReader {
  public:
    /// Throws InputError for a file that is missing, no session, made to keep a reader busy, or so
    /// damaged that no tick of it can be read; DamagedSession for one that is to be refused.
    explicit SessionReader(const std::filesystem::path& file,
                           IfDamaged if_damaged = IfDamaged::rescue);
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

    /// Checks the whole file and its log. Throws InputError when they are damaged.
    void check() const;
    /// Checks it, and reads what can be read from now on if it is damaged: true. No statement of
    /// before may be left. Throws InputError when no tick can be read.
    bool rescue_if_damaged();
    [[nodiscard]] bool is_rescued() const noexcept { return rescued_; }
    /// "is cut short (...)", "is damaged"; empty: no damage was met.
    [[nodiscard]] const std::string& damage() const noexcept { return damage_; }

    /// The rows of a query; must not outlive this reader. Throws InputError when the file holds no
    /// such tables or columns, and while the rows are read when it is damaged.
    [[nodiscard]] Statement rows(std::string_view sql) const { return {*database_, sql}; }

  private:
    /// The state of the log by the file's head. Refuses a file that must not be opened.
    [[nodiscard]] Log log_by_head();
    /// In SQLite's words; empty: nothing.
    [[nodiscard]] std::string damage_found() const;
    [[nodiscard]] bool log_has_more_ticks() const;
    void open();
    void rescue();
    /// Of every query.
    [[nodiscard]] Database::ErrorHandler refusal();
    void read_schema();
    void check_kind() const;
    void read_first_schema();
    void check_view();
    void use_own_view();
    /// Requires ordinary tables: a view could be endless, a hidden column be computed.
    void require_tables(std::span<const std::string_view> names) const;
    /// Tables and columns of the file that this schema lacks, as a list; empty: none.
    [[nodiscard]] std::string unknown_parts() const;
    [[nodiscard]] DamagedSession damage_error(const std::string& damage,
                                              const std::string& cause) const;
    /// Refuses a foreign or damaged file.
    [[noreturn]] void refuse(const DatabaseError& error);
    [[noreturn]] void refuse(const std::string& reason) const;

    std::filesystem::path file_;
    std::int64_t schema_{0};  ///< `PRAGMA user_version`; before what follows, whose errors name it
    std::string damage_{}, cause_{};  ///< the cause in SQLite's words
    Log log_;
    bool rescuing_{false};
    bool rescued_{false};
    std::string other_schema_{};
    std::unique_ptr<Database> database_{};
};

}  // namespace dibhr
