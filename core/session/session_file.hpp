// The session file's tables: made once, filled tick by tick, within transactions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/session/database.hpp"
#include "core/session/recorder.hpp"

namespace dibhr {

/// "dhap": the file says itself what it is (`PRAGMA application_id`).
inline constexpr int kSessionApplicationId = 0x64686170;
/// Counts changes of the tables (`PRAGMA user_version`, and `schema_version` in table session).
inline constexpr int kSessionSchemaVersion = 1;

using SessionFacts = std::map<std::string, std::string>;

/// A session file open for writing. Tables:
/// - session(key, value): the facts, and schema_version, row_count, dropped_count, complete
/// - tick: one row per tick, columns as in the output rows and a few more
/// - tick_column(name, unit, meaning): what the columns of tick hold
/// - cut(code, name): why a force was cut
/// One thread at a time. Every call but the constructor throws DatabaseError.
class SessionFile {
  public:
    /// Makes the file and its tables. Throws InputError, and leaves nothing behind, when that
    /// fails; an existing file is never touched.
    SessionFile(const std::filesystem::path& file, const SessionFacts& facts);
    SessionFile(const SessionFile&) = delete;  // the statements refer to the database beside them
    SessionFile& operator=(const SessionFile&) = delete;

    void begin();
    void add(const TickRecord& record);
    /// Also notices when the file is gone from its place.
    void commit();
    void set_fact(const std::string& key, const std::string& value);
    /// Moves what is in the write-ahead log into the file, so that one file remains after closing.
    void merge_log();

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// On the disk, log included.
    [[nodiscard]] std::uint64_t bytes() const;

  private:
    std::filesystem::path path_;
    Database database_;
    Statement insert_tick_;
    Statement insert_fact_;
};

}  // namespace dibhr
