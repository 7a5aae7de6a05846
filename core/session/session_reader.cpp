// Opens a session file read-only.
#include "core/session/session_reader.hpp"

#include <sqlite3.h>

#include <string_view>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {
namespace {

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

}  // namespace

void SessionReader::Closer::operator()(sqlite3* database) const noexcept {
    sqlite3_close(database);
}

SessionReader::SessionReader(const std::filesystem::path& file) : file_(file) {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) {
        throw InputError(file.string() + ": no such file; check its name");
    }
    if (!std::filesystem::is_regular_file(file, failed)) refuse("no ordinary file");
    // A file without a log beside it is complete: opened as immutable, SQLite makes no files beside
    // it.
    const bool complete = !std::filesystem::exists(file.string() + "-wal", failed);
    const std::string uri = "file:" + percent_encoded(std::filesystem::absolute(file).string()) +
                            "?mode=ro" + (complete ? "&immutable=1" : "");
    sqlite3* opened = nullptr;
    const int result =
        sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) refuse(sqlite3_errstr(result));
}

void SessionReader::refuse(const std::string& reason) const {
    throw InputError(file_.string() + ": is no session that can be read (" + reason +
                     "); choose a file that dibhr recorded");
}

void SessionReader::Query::Finalizer::operator()(sqlite3_stmt* statement) const noexcept {
    sqlite3_finalize(statement);
}

SessionReader::Query::Query(const SessionReader& reader, const std::string& sql) : reader_(reader) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(reader.database_.get(), sql.c_str(), -1, &prepared, nullptr) !=
        SQLITE_OK) {
        reader.refuse(sqlite3_errmsg(reader.database_.get()));
    }
    statement_.reset(prepared);
}

bool SessionReader::Query::next() {
    const int result = sqlite3_step(statement_.get());
    if (result == SQLITE_ROW) return true;
    if (result != SQLITE_DONE) reader_.refuse(sqlite3_errmsg(reader_.database_.get()));
    return false;
}

double SessionReader::Query::real(int column) const noexcept {
    return sqlite3_column_double(statement_.get(), column);
}

long long SessionReader::Query::integer(int column) const noexcept {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string SessionReader::Query::text(int column) const {
    const unsigned char* const text = sqlite3_column_text(statement_.get(), column);
    const int bytes = sqlite3_column_bytes(statement_.get(), column);
    return text == nullptr ? std::string{} : std::string(text, text + bytes);
}

}  // namespace dibhr
