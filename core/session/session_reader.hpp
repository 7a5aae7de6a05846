// A session file open for reading, which stays as it is: SQLite with owners and errors in plain
// words.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace dibhr {

/// One session, read while it is recorded or afterwards, by one thread at a time.
class SessionReader {
  public:
    /// Throws InputError for a file that is missing, no ordinary file or no database.
    explicit SessionReader(const std::filesystem::path& file);

    class Query;

  private:
    [[noreturn]] void refuse(const std::string& reason) const;

    struct Closer {
        void operator()(sqlite3* database) const noexcept;
    };
    std::filesystem::path file_;
    std::unique_ptr<sqlite3, Closer> database_{};
};

/// The rows of a question, one after the other; must not outlive its reader. Columns count from 0.
class SessionReader::Query {
  public:
    /// Throws InputError when the file holds no such tables or columns.
    Query(const SessionReader& reader, const std::string& sql);

    /// False after the last row. Throws InputError for a damaged file.
    [[nodiscard]] bool next();
    [[nodiscard]] double real(int column) const noexcept;
    [[nodiscard]] long long integer(int column) const noexcept;
    [[nodiscard]] std::string text(int column) const;

  private:
    struct Finalizer {
        void operator()(sqlite3_stmt* statement) const noexcept;
    };
    const SessionReader& reader_;
    std::unique_ptr<sqlite3_stmt, Finalizer> statement_{};
};

}  // namespace dibhr
