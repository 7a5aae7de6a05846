// Reads rows, duration and facts of a session file.
#include "core/session/session_summary.hpp"

#include <sqlite3.h>

#include <memory>
#include <string_view>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {
namespace {

struct CloseDatabase {
    void operator()(sqlite3* database) const noexcept { sqlite3_close(database); }
};
struct FinalizeStatement {
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
};
using ReadOnlyFile = std::unique_ptr<sqlite3, CloseDatabase>;
using Query = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

std::string percent_encoded(std::string_view path) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/-_.";
    std::string encoded;
    for (const char c : path) {
        if (kPlain.find(c) != std::string_view::npos) {
            encoded += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            encoded += '%';
            encoded += kDigits[byte >> 4U];
            encoded += kDigits[byte & 15U];
        }
    }
    return encoded;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
    throw InputError(file.string() + ": is no session that can be read (" + reason +
                     "); choose a file that dibhr recorded");
}

ReadOnlyFile open(const std::filesystem::path& file) {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) {
        throw InputError(file.string() + ": no such file; check its name");
    }
    if (!std::filesystem::is_regular_file(file, failed)) refuse(file, "no ordinary file");
    // A file without a log beside it is complete: opened as immutable, SQLite makes no files beside
    // it.
    const bool complete = !std::filesystem::exists(file.string() + "-wal", failed);
    const std::string uri = "file:" + percent_encoded(std::filesystem::absolute(file).string()) +
                            "?mode=ro" + (complete ? "&immutable=1" : "");
    sqlite3* opened = nullptr;
    const int result =
        sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    ReadOnlyFile database(opened);
    if (result != SQLITE_OK) refuse(file, sqlite3_errstr(result));
    return database;
}

Query prepare(const ReadOnlyFile& database, const std::filesystem::path& file, const char* query) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(database.get(), query, -1, &prepared, nullptr) != SQLITE_OK) {
        refuse(file, sqlite3_errmsg(database.get()));
    }
    return Query(prepared);
}

bool next_row(const ReadOnlyFile& database, const std::filesystem::path& file,
              const Query& statement) {
    const int result = sqlite3_step(statement.get());
    if (result == SQLITE_ROW) return true;
    if (result != SQLITE_DONE) refuse(file, sqlite3_errmsg(database.get()));
    return false;
}

std::string text_of(const Query& statement, int column) {
    const unsigned char* const text = sqlite3_column_text(statement.get(), column);
    const int bytes = sqlite3_column_bytes(statement.get(), column);
    return text == nullptr ? std::string{} : std::string(text, text + bytes);
}

}  // namespace

SessionSummary summarise_session(const std::filesystem::path& file) {
    const ReadOnlyFile database = open(file);
    SessionSummary summary;
    const Query ticks =
        prepare(database, file, "SELECT count(*), ifnull(max(t) - min(t), 0) FROM tick");
    if (next_row(database, file, ticks)) {
        summary.rows = sqlite3_column_int64(ticks.get(), 0);
        summary.duration_s = sqlite3_column_double(ticks.get(), 1);
    }
    const Query facts = prepare(database, file, "SELECT key, value FROM session");
    while (next_row(database, file, facts)) {
        summary.facts[text_of(facts, 0)] = text_of(facts, 1);
    }
    return summary;
}

}  // namespace dibhr
