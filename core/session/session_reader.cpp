// Opens a session file read-only.
#include "core/session/session_reader.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/session/session_schema.hpp"

namespace dibhr {
namespace {

// The recorder may hold the file for a moment.
constexpr int kPatience_ms = 2000;

constexpr int kLongestValue_bytes = 1 << 20;  ///< longer than anybody would write

/// SQLite's words, which may quote what the file holds.
std::string brief(std::string_view words) {
    constexpr std::size_t kMostLetters = 200;
    return one_line(words, kMostLetters);
}

}  // namespace

SessionReader::SessionReader(const std::filesystem::path& file) : file_(file) {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) {
        throw InputError(file.string() + ": no such file; check its name");
    }
    if (!std::filesystem::is_regular_file(file, failed)) refuse("no ordinary file");
    read_head();
    // Opened as immutable, SQLite makes no files beside it, and reads none.
    const bool complete = log_ != Log::needed;
    const std::string uri = "file:" + percent_encoded(std::filesystem::absolute(file).string()) +
                            "?mode=ro" + (complete ? "&immutable=1" : "");
    sqlite3* opened = nullptr;
    const int result =
        sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) refuse();
    sqlite3_busy_timeout(opened, kPatience_ms);
    bounds_.hold(opened, kLongestValue_bytes);
    check_kind();
    check_tables();
}

void SessionReader::allow_work() const {
    bounds_.allow(work_worth(file_));
}

/// What is read are the tables of a recording and the view that dibhr makes of them: no other that
/// could go on for ever.
void SessionReader::check_tables() const {
    std::string names;
    for (const std::string_view name : session_tables()) {
        names.append(names.empty() ? "('" : ", '").append(name).append("'");
    }
    // A view has no pages of its own, nor has a table that a module makes up; a hidden column may
    // be computed.
    Query tables(*this,
                 "SELECT sum(rootpage > 0) FROM sqlite_master WHERE type = 'table' AND "
                 "name IN " +
                     names + ")");
    Query hidden(*this,
                 "SELECT sum(x.hidden) FROM sqlite_master m, pragma_table_xinfo(m.name) x "
                 "WHERE m.name IN " +
                     names + ")");
    Query view(*this, "SELECT sql FROM sqlite_master WHERE type = 'view' AND name = 'tick'");
    // Recordings of before there were touch maps have no such table.
    Query maps(
        *this,
        "SELECT count(*) FROM sqlite_master WHERE name = 'touch_map' AND NOT (type = 'table' "
        "AND rootpage > 0)");
    const auto count = static_cast<std::int64_t>(session_tables().size());
    if (!maps.next() || maps.integer(0) != 0 || !tables.next() || tables.integer(0) != count ||
        !hidden.next() || hidden.integer(0) != 0 || !view.next() || view.text(0) != tick_view()) {
        refuse("its tables are not those of a recording");
    }
}

/// The head of a file that was closed says how long it is, which is refused when it is shorter, and
/// whether a log belongs to it.
void SessionReader::read_head() {
    // SQLite's file format, section 1.3: the magic string; at 16 the size of a page, 1 for 65536;
    // at 18 and 19 a 2 each for a write-ahead log; at 28 the number of pages, valid if the numbers
    // at 24 and 92 are the same. All big-endian.
    constexpr std::string_view kMagic = "SQLite format 3";
    std::array<unsigned char, 100> head{};
    std::ifstream stream(file_, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), head.size());
    if (!stream.is_open()) throw InputError(file_.string() + ": cannot be read; make it readable");
    // Asked after the head was read: a recording that ends meanwhile has no log any more.
    std::error_code failed;
    const bool logged = std::filesystem::exists(file_.string() + "-wal", failed);
    // SQLite would take the log of an empty file for one that was left behind, and delete it.
    if (stream.gcount() == 0 && logged) {
        throw InputError(file_.string() + ": is empty, and only " + file_.filename().string() +
                         "-wal, the log of its recording, is beside it; copy both again from where "
                         "it was recorded");
    }
    if (stream.gcount() == 0) refuse("it is empty");
    if (!std::equal(kMagic.begin(), kMagic.end(), head.begin())) refuse("no SQLite file");
    const auto number = [&head](std::size_t at, std::size_t bytes) {
        std::uint64_t value = 0;
        for (std::size_t k = at; k < at + bytes; ++k) value = value << 8U | head[k];
        return value;
    };
    const bool by_log = head[18] == 2 && head[19] == 2;
    log_ = !by_log ? (logged ? Log::foreign : Log::none) : logged ? Log::needed : Log::absent;
    if (log_ == Log::needed) return;  // which may hold what the file lacks
    const std::uint64_t page = number(16, 2) == 1 ? 65536 : number(16, 2);
    const std::uint64_t promised = page * number(28, 4);
    const std::uint64_t there = std::filesystem::file_size(file_, failed);
    if (failed || number(24, 4) != number(92, 4) || there >= promised) return;
    throw InputError(file_.string() + ": is cut short (" + std::to_string(there) + " of " +
                     std::to_string(promised) + " bytes); copy it again");
}

void SessionReader::check_kind() const {
    const auto number = [this](const char* question) {
        Query query(*this, question);
        return query.next() ? query.integer(0) : 0;
    };
    const std::int64_t application = number("PRAGMA application_id");
    if (application == 0 && number("SELECT count(*) FROM sqlite_master") == 0) {
        std::error_code failed;
        const std::string log = file_.filename().string() + "-wal";
        if (log_ == Log::absent) {
            throw InputError(file_.string() +
                             ": its recording was broken off, and all of it is "
                             "in " +
                             log + ", which is not here; copy both files");
        }
        if (std::filesystem::exists(file_.string() + "-wal", failed)) {
            throw InputError(file_.string() +
                             ": its recording was broken off before anything was "
                             "written, also into " +
                             log + "; record it again");
        }
    }
    if (application != kSessionApplicationId) {
        refuse("another program's database");
    }
    const std::int64_t version = number("PRAGMA user_version");
    if (version == kSessionSchemaVersion) return;
    const bool newer = version > kSessionSchemaVersion;
    throw InputError(file_.string() + ": was recorded by " + (newer ? "a newer" : "an older") +
                     " dibhr (format " + std::to_string(version) + ", this one reads " +
                     std::to_string(kSessionSchemaVersion) + "); " +
                     (newer ? "update dibhr" : "record it again"));
}

void SessionReader::check() const {
    Query query(*this, "PRAGMA quick_check(1)");
    const std::string words = query.next() ? query.text(0) : "";
    if (words != "ok") refuse_damaged(words.substr(words.rfind('\n') + 1));
}

void SessionReader::refuse() const {
    const int code = sqlite3_errcode(database_.get());
    const std::string words = sqlite3_errmsg(database_.get());
    if (code == SQLITE_CORRUPT) refuse_damaged(words);
    if (code == SQLITE_INTERRUPT) refuse("reading it would not end");
    if (code == SQLITE_TOOBIG) refuse("it holds a value of more than a megabyte");
    if (code == SQLITE_CANTOPEN) {
        throw InputError(file_.string() +
                         ": its recording was broken off, and its log cannot be opened; copy both, "
                         "the file and " +
                         file_.filename().string() + "-wal, into a folder that can be written to");
    }
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

SessionReader::Query::Query(const SessionReader& reader, const std::string& sql) : reader_(reader) {
    reader.allow_work();
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(reader.database_.get(), sql.c_str(), -1, &prepared, nullptr) !=
        SQLITE_OK) {
        reader.refuse();
    }
    statement_.reset(prepared);
}

bool SessionReader::Query::next() {
    const int result = sqlite3_step(statement_.get());
    if (result == SQLITE_ROW) return true;
    if (result != SQLITE_DONE) reader_.refuse();
    return false;
}

SessionReader::Kind SessionReader::Query::kind(int column) const noexcept {
    switch (sqlite3_column_type(statement_.get(), column)) {
        case SQLITE_INTEGER:
            return Kind::integer;
        case SQLITE_FLOAT:
            return Kind::real;
        case SQLITE_NULL:
            return Kind::nothing;
        default:
            return Kind::text;
    }
}

int SessionReader::Query::columns() const noexcept {
    return sqlite3_column_count(statement_.get());
}

std::string SessionReader::Query::name(int column) const {
    return sqlite3_column_name(statement_.get(), column);
}

}  // namespace dibhr
