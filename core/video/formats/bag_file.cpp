// SQLite, bounded.
#include "core/video/formats/bag_file.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kLongestText_bytes = 1 << 20;  ///< of a topic's name
constexpr std::int64_t kLargestMessage_bytes = kMostPictureBytes + (1 << 16);  ///< and its header

std::string text_in(sqlite3_stmt* statement, int column) {
    const unsigned char* const text = sqlite3_column_text(statement, column);
    const int bytes = sqlite3_column_bytes(statement, column);
    return text == nullptr ? std::string{} : std::string(text, text + bytes);
}

}  // namespace

void BagFile::Closer::operator()(sqlite3* database) const noexcept {
    sqlite3_close_v2(database);
}

void BagFile::Closer::operator()(sqlite3_stmt* statement) const noexcept {
    sqlite3_finalize(statement);
}

void BagFile::Closer::operator()(sqlite3_blob* blob) const noexcept {
    sqlite3_blob_close(blob);
}

BagFile::BagFile(const fs::path& file) : file_(file) {
    require_readable(file);
    open();
    bounds_.hold(database_.get(), kLongestText_bytes);
    // A row takes about ten steps and more than a byte.
    constexpr std::uint64_t kStepsAnyway = 20'000'000;
    constexpr std::uint64_t kStepsPerByte = 100;
    std::error_code failed;
    const std::uintmax_t bytes = fs::file_size(file_, failed);
    most_steps_ = kStepsAnyway + (failed ? 0 : kStepsPerByte * bytes);
    check_tables();
}

std::vector<Topic> BagFile::topics() {
    std::vector<Topic> topics;
    const Statement statement = prepared("SELECT id, name, type FROM topics ORDER BY id");
    while (next(statement.get())) {
        topics.push_back({sqlite3_column_int64(statement.get(), 0), text_in(statement.get(), 1),
                          text_in(statement.get(), 2)});
    }
    return topics;
}

std::vector<BagMessage> BagFile::messages(std::int64_t topic, std::size_t most) {
    std::vector<BagMessage> found;
    const Statement statement =
        prepared("SELECT rowid, timestamp FROM messages WHERE topic_id = ? ORDER BY rowid LIMIT ?");
    sqlite3_bind_int64(statement.get(), 1, topic);
    sqlite3_bind_int64(statement.get(), 2, static_cast<std::int64_t>(most));
    while (next(statement.get())) {
        found.push_back(
            {sqlite3_column_int64(statement.get(), 0), sqlite3_column_int64(statement.get(), 1)});
    }
    return found;
}

std::vector<std::uint8_t> BagFile::data(std::int64_t row, std::size_t most) {
    sqlite3_blob* opened = blob_.release();
    const int result = opened == nullptr ? sqlite3_blob_open(database_.get(), "main", "messages",
                                                             "data", row, 0, &opened)
                                         : sqlite3_blob_reopen(opened, row);
    blob_.reset(opened);
    if (result != SQLITE_OK) {
        const std::string why = sqlite3_errmsg(database_.get());
        blob_.reset();  // a handle that failed once fails for ever
        refuse(why);
    }
    const int bytes = sqlite3_blob_bytes(blob_.get());
    if (bytes > kLargestMessage_bytes) refuse("a message is larger than any picture");
    std::vector<std::uint8_t> data(std::min(static_cast<std::size_t>(bytes), most));
    const int read = sqlite3_blob_read(blob_.get(), data.data(), static_cast<int>(data.size()), 0);
    if (read != SQLITE_OK) refuse();
    return data;
}

void BagFile::open() {
    // Without a log beside it the file is complete: as immutable, SQLite makes no files there.
    std::error_code failed;
    const bool complete = !fs::exists(file_.string() + "-wal", failed);
    const std::string uri = "file:" + percent_encoded(fs::absolute(file_, failed).string()) +
                            "?mode=ro" + (complete ? "&immutable=1" : "");
    sqlite3* opened = nullptr;
    const int result =
        sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) refuse();
}

/// Tables with pages of their own, whose columns are not computed.
void BagFile::check_tables() {
    const auto count = [this](const char* question) {
        const Statement statement = prepared(question);
        return next(statement.get()) ? sqlite3_column_int64(statement.get(), 0) : 0;
    };
    const bool there =
        count(
            "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name "
            "IN ('topics', 'messages')") == 2;
    const bool plain =
        count(
            "SELECT count(*) FROM sqlite_master m, pragma_table_xinfo(m.name) x WHERE m.name IN "
            "('topics', 'messages') AND x.hidden != 0") == 0;
    if (!there || !plain)
        throw InputError(shown(file_) +
                         " is a database, and not one of ROS 2: give the .db3 file of a bag");
}

BagFile::Statement BagFile::prepared(const char* sql) {
    bounds_.allow(most_steps_);
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK) refuse();
    return Statement(statement);
}

bool BagFile::next(sqlite3_stmt* statement) const {
    const int result = sqlite3_step(statement);
    if (result != SQLITE_ROW && result != SQLITE_DONE) refuse();
    return result == SQLITE_ROW;
}

void BagFile::refuse() const {
    refuse(sqlite3_errmsg(database_.get()));
}

void BagFile::refuse(std::string_view why) const {
    constexpr std::size_t kMostLetters = 200;
    throw InputError(shown(file_) + " cannot be read as a bag of ROS 2 (" +
                     one_line(why, kMostLetters) + "): copy or record it again");
}

}  // namespace dibhr
