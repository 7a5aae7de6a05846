// Opens a bag's database with bounds on texts, messages and time.
#include "core/video/formats/bag_file.hpp"

#include <algorithm>
#include <system_error>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kLongestText_bytes = 1 << 20;                                   ///< of a topic's name
constexpr std::size_t kLargestMessage_bytes = kMostPictureBytes + (1 << 16);  ///< and its header

const fs::path& readable(const fs::path& file) {
    require_readable(file);
    return file;
}

/// Whether a write-ahead log lies beside the file; without one the file is complete.
bool has_log(const fs::path& file) {
    std::error_code failed;
    return fs::exists(file.string() + "-wal", failed);
}

}  // namespace

BagFile::BagFile(const fs::path& file)
    : file_(readable(file)),
      database_(
          file_,
          {.complete = !has_log(file_), .longest_bytes = kLongestText_bytes, .busy_timeout_ms = 0},
          [this](const DatabaseError& error) { refuse(error.what()); }),
      message_(database_, "messages", "data") {
    check_tables();
}

std::vector<Topic> BagFile::topics() const {
    std::vector<Topic> topics;
    Statement rows(database_, "SELECT id, name, type FROM topics ORDER BY id");
    while (rows.next()) topics.push_back({rows.integer(0), rows.text(1), rows.text(2)});
    return topics;
}

std::vector<BagMessage> BagFile::messages(std::int64_t topic, std::size_t most) const {
    std::vector<BagMessage> found;
    Statement rows(
        database_,
        "SELECT rowid, timestamp FROM messages WHERE topic_id = ? ORDER BY rowid LIMIT ?");
    rows.bind(topic);
    rows.bind(most);
    while (rows.next()) found.push_back({rows.integer(0), rows.integer(1)});
    return found;
}

std::vector<std::uint8_t> BagFile::data(std::int64_t row, std::size_t most) {
    const std::size_t bytes = message_.open(row);
    if (bytes > kLargestMessage_bytes) refuse("a message is larger than any picture");
    std::vector<std::uint8_t> data(std::min(bytes, most));
    message_.read(data);
    return data;
}

/// Requires real tables (not views) without generated columns, which could execute expressions.
void BagFile::check_tables() const {
    const bool there =
        database_.number(
            "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name "
            "IN ('topics', 'messages')") == 2;
    const bool plain =
        database_.number(
            "SELECT count(*) FROM sqlite_master m, pragma_table_xinfo(m.name) x WHERE m.name IN "
            "('topics', 'messages') AND x.hidden != 0") == 0;
    if (!there || !plain)
        throw InputError(shown(file_) +
                         " is a database, and not one of ROS 2: give the .db3 file of a bag");
}

void BagFile::refuse(std::string_view why) const {
    constexpr std::size_t kMostLetters = 200;
    throw InputError(shown(file_) + " cannot be read as a bag of ROS 2 (" +
                     one_line(why, kMostLetters) + "): copy or record it again");
}

}  // namespace dibhr
