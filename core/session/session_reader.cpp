// Opens a session file read-only.
#include "core/session/session_reader.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/session/session_rescue.hpp"
#include "core/session/session_schema.hpp"
#include "core/sqlite/database_log.hpp"

namespace dibhr {
namespace {

/// SQLite's message on one short line: it may quote the file's content.
std::string brief(std::string_view words) {
    constexpr std::size_t kMostLetters = 200;
    return one_line(words, kMostLetters);
}

}  // namespace

SessionReader::SessionReader(const std::filesystem::path& file, IfDamaged if_damaged)
    : file_(file), log_(log_by_head()) {
    if (damage_.empty()) {
        try {
            open();
            return;
        } catch (const InputError&) {
            if (damage_.empty()) throw;
        }
    }
    if (if_damaged == IfDamaged::refuse) throw damage_error(damage_, cause_);
    rescue();
}

void SessionReader::open() {
    const Database::ReadOnly how{.complete = log_ != Log::needed,
                                 .longest_bytes = kLongestSessionValue_bytes};
    database_ = std::make_unique<Database>(file_, how, refusal());
    check_kind();
    read_schema();
}

void SessionReader::read_schema() {
    schema_ = database_->number("PRAGMA user_version");
    if (schema_ < kFirstSessionSchema)
        refuse("its format has the number " + std::to_string(schema_));
    if (schema_ == kFirstSessionSchema)
        read_first_schema();
    else
        check_view();
}

Database::ErrorHandler SessionReader::refusal() {
    return [this](const DatabaseError& error) { refuse(error); };
}

void SessionReader::rescue() {
    const std::string damage = damage_;
    const std::string cause = cause_;
    struct Guard {
        bool& is_set;
        ~Guard() { is_set = false; }
    };
    rescuing_ = true;
    const Guard guard{rescuing_};
    try {
        RescuedTables tables = rescued_tables(file_, log_ == Log::needed, refusal());
        database_ = std::move(tables.database);
        check_kind();
        read_schema();
        if (database_->number("SELECT count(*) FROM (SELECT 1 FROM tick_data LIMIT 1)") == 0)
            refuse("no tick");
        Statement(*database_, "INSERT OR REPLACE INTO session(key, value) VALUES (?, ?)")
            .run(kDamageFact, loss_text(*database_, tables.incomplete));
    } catch (const InputError&) {
        if (!is_database(file_)) refuse("no SQLite file");
        throw damage_error(damage, cause);
    } catch (const DatabaseError& error) {
        if (error.cause() != DatabaseError::Cause::disk) throw damage_error(damage, error.what());
        throw InputError(file_.string() + ": " + damage +
                         ", and what is left of it cannot be put into TMPDIR (" +
                         brief(error.what()) + "); make room there");
    }
    damage_ = damage;
    rescued_ = true;
}

bool SessionReader::rescue_if_damaged() {
    if (rescued_) return true;
    cause_ = damage_found();
    if (cause_.empty()) return false;
    damage_ = "is damaged";
    rescue();
    return true;
}

void SessionReader::read_first_schema() {
    require_tables(kFirstSessionTables);
    database_->execute(first_schema_as_this_one());
    other_schema_ =
        "is of format 1, the first, which held no parameters, files, marks and wall clock: it can "
        "be exported, but not replayed";
}

void SessionReader::check_view() {
    require_tables(kSessionTables);
    // Recordings of before there were touch maps have no such table.
    if (database_->number("SELECT count(*) FROM sqlite_master WHERE name = 'touch_map'") > 0)
        require_tables(std::array{std::string_view("touch_map")});
    const bool later = schema_ > kSessionSchemaVersion;
    const bool known = [&] {
        Statement view =
            rows("SELECT sql FROM sqlite_master WHERE type = 'view' AND name = 'tick'");
        return view.next() && (later || is_tick_view(view.text(0)));
    }();
    if (!known && !has_one_view(schema_)) refuse("its tables are not those of a recording");
    if (!known) use_own_view();
    if (!later) return;
    const std::string unknown = unknown_parts();
    other_schema_ = "was recorded by a newer dibhr (format " + std::to_string(schema_) +
                    ", this one reads " + std::to_string(kSessionSchemaVersion) + "); " +
                    (unknown.empty() ? "no table or column of it is unknown here"
                                     : "not read: " + brief(unknown)) +
                    "; update dibhr";
}

/// Ticks are coded in one way in all files of this schema: the view's text is not needed.
void SessionReader::use_own_view() {
    database_->execute("PRAGMA temp_store = MEMORY; " + tick_view("CREATE TEMP VIEW"));
    other_schema_ = "has a damaged view of its ticks, which are read as format " +
                    std::to_string(schema_) + " codes them";
}

void SessionReader::require_tables(std::span<const std::string_view> wanted) const {
    std::string names;
    for (const std::string_view name : wanted)
        names.append(names.empty() ? "('" : ", '").append(name).append("'");
    // A view has no pages of its own, nor has a table that a module makes up.
    const bool plain =
        database_->number(
            "SELECT sum(rootpage > 0) FROM sqlite_master WHERE type = 'table' AND name IN " +
            names + ")") == std::ssize(wanted) &&
        database_->number(
            "SELECT sum(x.hidden) FROM sqlite_master m, pragma_table_xinfo(m.name) x "
            "WHERE m.name IN " +
            names + ")") == 0;
    if (!plain) refuse("its tables are not those of a recording");
}

std::string SessionReader::unknown_parts() const {
    constexpr std::string_view kColumns =
        "SELECT m.name, x.name FROM sqlite_master m, pragma_table_info(m.name) x "
        "WHERE m.type IN ('table', 'view') AND m.name NOT LIKE 'sqlite%' ORDER BY m.rowid, x.cid";
    std::set<std::string> known;
    const Database here(":memory:");
    here.execute(session_schema());
    for (Statement row(here, kColumns); row.next();) {
        known.insert(row.text(0));
        known.insert(row.text(0) + '.' + row.text(1));
    }
    std::set<std::string> named;
    std::string unknown;
    for (Statement row = rows(kColumns); row.next();) {
        const bool table = !known.contains(row.text(0));
        const std::string part = row.text(0) + (table ? "" : '.' + row.text(1));
        if (known.contains(part) || !named.insert(part).second) continue;
        unknown += (unknown.empty() ? "" : ", ") + part;
    }
    return unknown;
}

/// The head of a closed file holds its length, and whether a log belongs to it. Notes the damage of
/// a shorter file, and of one without a head.
SessionReader::Log SessionReader::log_by_head() {
    std::error_code failed;
    if (!std::filesystem::exists(file_, failed))
        throw InputError(file_.string() + ": no such file; check its name");
    if (!std::filesystem::is_regular_file(file_, failed)) refuse("not an ordinary file");
    // SQLite's file format, section 1.3: at 16 the size of a page, 1 for 65536; at 18 and 19 a 2
    // each for a write-ahead log; at 28 the number of pages, valid if the numbers at 24 and 92 are
    // the same. All big-endian.
    std::ifstream stream(file_, std::ios::binary);
    std::vector<std::uint8_t> head = bytes_at(stream, 0, 100);
    if (!stream.is_open()) throw InputError(file_.string() + ": cannot be read; make it readable");
    // Checked after the head was read: a recording that ends meanwhile has no log any more.
    const bool logged = std::filesystem::exists(file_.string() + "-wal", failed);
    // SQLite would delete the log of an empty file as a leftover.
    if (head.empty() && logged)
        throw InputError(file_.string() + ": is empty, and only " + file_.filename().string() +
                         "-wal, the log of its recording, is beside it; copy both again from where "
                         "it was recorded");
    if (head.empty()) refuse("it is empty");
    if (!is_database(file_)) damage_ = "is damaged";
    if (!damage_.empty()) return logged ? Log::needed : Log::none;
    head.resize(100);
    const auto number = [&head](std::size_t at, std::size_t bytes) {
        return big_endian(std::span(head).subspan(at, bytes));
    };
    const bool by_log = head[18] == 2 && head[19] == 2;
    if (by_log && logged) return Log::needed;  // which may hold what the file lacks
    const Log log = by_log ? Log::absent : logged ? Log::foreign : Log::none;
    const std::uint64_t page = number(16, 2) == 1 ? 65536 : number(16, 2);
    const std::uint64_t promised = page * number(28, 4);
    const std::uint64_t there = std::filesystem::file_size(file_, failed);
    if (failed || number(24, 4) != number(92, 4) || there >= promised) return log;
    damage_ =
        "is cut short (" + std::to_string(there) + " of " + std::to_string(promised) + " bytes)";
    return log;
}

void SessionReader::check_kind() const {
    const std::int64_t application = database_->number("PRAGMA application_id");
    if (application == 0 && database_->number("SELECT count(*) FROM sqlite_master") == 0) {
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
    if (application == kStudyApplicationId)
        throw InputError(file_.string() +
                         ": holds a participant's answers, and is no session; give it to "
                         "dibhr study report");
    if (application != kSessionApplicationId) refuse("another program's database");
}

void SessionReader::check() const {
    if (rescued_) throw damage_error(damage_, {});
    const std::string cause = damage_found();
    if (!cause.empty()) throw damage_error("is damaged", cause);
}

DamagedSession SessionReader::damage_error(const std::string& damage,
                                           const std::string& cause) const {
    return DamagedSession(file_.string() + ": " + damage +
                          (cause.empty() ? "" : " (" + brief(cause) + ")") + "; copy it again");
}

std::string SessionReader::damage_found() const {
    try {
        Statement checked = rows("PRAGMA quick_check(1)");
        const std::string words = checked.next() ? checked.text(0) : "";
        if (words != "ok") return words.substr(words.rfind('\n') + 1);
    } catch (const InputError&) {
        if (cause_.empty()) throw;
        return cause_;
    }
    const std::string log = file_.string() + "-wal";
    if (log_ == Log::needed && is_log_damaged(log) && log_has_more_ticks())
        return "torn pages in " + file_.filename().string() + "-wal";
    return {};
}

/// Whether a damaged log holds much after the damage, where SQLite ends. A power cut leaves less:
/// of the last pages, which were not flushed yet, some are missing.
bool SessionReader::log_has_more_ticks() const try {
    constexpr std::int64_t kMostUnflushed = 2000;  // LogKeeper flushes once a second
    constexpr const char* kLast = "SELECT ifnull(max(tick), -1) FROM tick_data";
    const RescuedTables tables = rescued_tables(file_, true, {});
    return tables.database->number(kLast) - database_->number(kLast) > kMostUnflushed;
} catch (const DatabaseError&) {  // of an older schema
    return true;
}

void SessionReader::refuse(const DatabaseError& error) {
    using Cause = DatabaseError::Cause;
    if (rescuing_) throw DatabaseError(error);
    const std::string words = error.what();
    if (error.cause() == Cause::damaged) {
        damage_ = "is damaged";
        cause_ = words;
        throw damage_error(damage_, cause_);
    }
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
    throw InputError(file_.string() + ": is not a session that can be read (" + brief(reason) +
                     (schema_ > kSessionSchemaVersion ? "); update dibhr"
                                                      : "); choose a file that dibhr recorded"));
}

}  // namespace dibhr
