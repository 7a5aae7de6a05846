// Opens a session file read-only.
#include "core/session/session_reader.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/session/session_schema.hpp"

namespace dibhr {
namespace {

constexpr int kLongestValue_bytes = 1 << 20;  ///< longer than any real value

/// SQLite's message on one short line: it may quote the file's content.
std::string brief(std::string_view words) {
    constexpr std::size_t kMostLetters = 200;
    return one_line(words, kMostLetters);
}

}  // namespace

SessionReader::SessionReader(const std::filesystem::path& file)
    : file_(file),
      log_(log_by_head()),
      database_(file, {.complete = log_ != Log::needed, .longest_bytes = kLongestValue_bytes},
                [this](const DatabaseError& error) { refuse(error); }) {
    check_kind();
    check_tables();
}

/// Requires the tables of a recording and dibhr's own view over them: any other could be endless.
void SessionReader::check_tables() const {
    std::string names;
    for (const std::string_view name : kSessionTables)
        names.append(names.empty() ? "('" : ", '").append(name).append("'");
    // A view has no pages of its own, nor has a table that a module makes up; a hidden column may
    // be computed. Recordings of before there were touch maps have no such table.
    const bool plain =
        database_.number(
            "SELECT count(*) FROM sqlite_master WHERE name = 'touch_map' AND NOT "
            "(type = 'table' AND rootpage > 0)") == 0 &&
        database_.number(
            "SELECT sum(rootpage > 0) FROM sqlite_master WHERE type = 'table' AND name IN " +
            names + ")") == std::ssize(kSessionTables) &&
        database_.number(
            "SELECT sum(x.hidden) FROM sqlite_master m, pragma_table_xinfo(m.name) x "
            "WHERE m.name IN " +
            names + ")") == 0;
    Statement view = rows("SELECT sql FROM sqlite_master WHERE type = 'view' AND name = 'tick'");
    if (!plain || !view.next() || view.text(0) != tick_view())
        refuse("its tables are not those of a recording");
}

/// The head of a closed file holds its length, and whether a log belongs to it. Refuses a shorter
/// file.
SessionReader::Log SessionReader::log_by_head() const {
    std::error_code failed;
    if (!std::filesystem::exists(file_, failed))
        throw InputError(file_.string() + ": no such file; check its name");
    if (!std::filesystem::is_regular_file(file_, failed)) refuse("no ordinary file");
    // SQLite's file format, section 1.3: at 16 the size of a page, 1 for 65536; at 18 and 19 a 2
    // each for a write-ahead log; at 28 the number of pages, valid if the numbers at 24 and 92 are
    // the same. All big-endian.
    std::array<unsigned char, 100> head{};
    std::ifstream stream(file_, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), head.size());
    if (!stream.is_open()) throw InputError(file_.string() + ": cannot be read; make it readable");
    // Checked after the head was read: a recording that ends meanwhile has no log any more.
    const bool logged = std::filesystem::exists(file_.string() + "-wal", failed);
    // SQLite would delete the log of an empty file as a leftover.
    if (stream.gcount() == 0 && logged)
        throw InputError(file_.string() + ": is empty, and only " + file_.filename().string() +
                         "-wal, the log of its recording, is beside it; copy both again from where "
                         "it was recorded");
    if (stream.gcount() == 0) refuse("it is empty");
    if (!is_database(file_)) refuse("no SQLite file");
    const auto number = [&head](std::size_t at, std::size_t bytes) {
        std::uint64_t value = 0;
        for (std::size_t k = at; k < at + bytes; ++k) value = value << 8U | head[k];
        return value;
    };
    const bool by_log = head[18] == 2 && head[19] == 2;
    if (by_log && logged) return Log::needed;  // which may hold what the file lacks
    const Log log = by_log ? Log::absent : logged ? Log::foreign : Log::none;
    const std::uint64_t page = number(16, 2) == 1 ? 65536 : number(16, 2);
    const std::uint64_t promised = page * number(28, 4);
    const std::uint64_t there = std::filesystem::file_size(file_, failed);
    if (failed || number(24, 4) != number(92, 4) || there >= promised) return log;
    throw InputError(file_.string() + ": is cut short (" + std::to_string(there) + " of " +
                     std::to_string(promised) + " bytes); copy it again");
}

void SessionReader::check_kind() const {
    const std::int64_t application = database_.number("PRAGMA application_id");
    if (application == 0 && database_.number("SELECT count(*) FROM sqlite_master") == 0) {
        std::error_code failed;
        const std::string log = file_.filename().string() + "-wal";
        if (log_ == Log::absent)
            throw InputError(file_.string() +
                             ": its recording was broken off, and all of it is in " + log +
                             ", which is not here; copy both files");
        if (std::filesystem::exists(file_.string() + "-wal", failed))
            throw InputError(file_.string() +
                             ": its recording was broken off before anything was "
                             "written, also into " +
                             log + "; record it again");
    }
    if (application != kSessionApplicationId) refuse("another program's database");
    const std::int64_t version = database_.number("PRAGMA user_version");
    if (version == kSessionSchemaVersion) return;
    const bool newer = version > kSessionSchemaVersion;
    throw InputError(file_.string() + ": was recorded by " + (newer ? "a newer" : "an older") +
                     " dibhr (format " + std::to_string(version) + ", this one reads " +
                     std::to_string(kSessionSchemaVersion) + "); " +
                     (newer ? "update dibhr" : "record it again"));
}

void SessionReader::check() const {
    Statement checked = rows("PRAGMA quick_check(1)");
    const std::string words = checked.next() ? checked.text(0) : "";
    if (words != "ok") refuse_damaged(words.substr(words.rfind('\n') + 1));
}

void SessionReader::refuse(const DatabaseError& error) const {
    using Cause = DatabaseError::Cause;
    const std::string words = error.what();
    if (error.cause() == Cause::damaged) refuse_damaged(words);
    if (error.cause() == Cause::too_much_work) refuse("reading it would not end");
    if (error.cause() == Cause::too_long) refuse("it holds a value of more than a megabyte");
    if (error.cause() == Cause::cannot_open)
        throw InputError(file_.string() +
                         ": its recording was broken off, and its log cannot be opened; copy both, "
                         "the file and " +
                         file_.filename().string() + "-wal, into a folder that can be written to");
    refuse(words);
}

void SessionReader::refuse(const std::string& reason) const {
    throw InputError(file_.string() + ": is no session that can be read (" + brief(reason) +
                     "); choose a file that dibhr recorded");
}

void SessionReader::refuse_damaged(const std::string& words) const {
    throw InputError(file_.string() + ": is damaged (" + brief(words) +
                     "); copy it again, or save what is left with sqlite3's .recover");
}

}  // namespace dibhr
