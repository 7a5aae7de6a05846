// Reads a bag in SQLite (.db3) with bounds on texts, messages and time.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/sqlite/database.hpp"
#include "core/video/formats/bags/bag_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kLongestText_bytes = 1 << 20;  ///< of a topic's name

/// Whether a write-ahead log lies beside the file; without one the file is complete.
bool has_log(const fs::path& file) {
    std::error_code failed;
    return fs::exists(file.string() + "-wal", failed);
}

/// Checks every cell, and bounds every query.
class SqliteBag : public BagFile {
  public:
    explicit SqliteBag(const fs::path& place)
        : BagFile(place),
          database_(file(),
                    {.complete = !has_log(file()),
                     .longest_bytes = kLongestText_bytes,
                     .busy_timeout_ms = 0},
                    [this](const DatabaseError& error) { refuse(error.what()); }),
          message_(database_, "messages", "data") {
        check_tables();
    }

    [[nodiscard]] std::vector<Topic> topics() override {
        std::vector<Topic> topics;
        Statement rows(database_, "SELECT id, name, type FROM topics ORDER BY id");
        while (rows.next()) topics.push_back({rows.integer(0), rows.text(1), rows.text(2)});
        return topics;
    }

    [[nodiscard]] std::vector<BagMessage> messages(std::int64_t topic, std::size_t most) override {
        std::vector<BagMessage> found;
        Statement rows(
            database_,
            "SELECT rowid, timestamp FROM messages WHERE topic_id = ? ORDER BY rowid LIMIT ?");
        rows.bind(topic);
        rows.bind(most);
        while (rows.next()) found.push_back({rows.integer(0), rows.integer(1)});
        return found;
    }

  private:
    [[nodiscard]] std::vector<std::uint8_t> stored(std::int64_t row, std::size_t most) override {
        const std::size_t bytes = message_.open(row);
        if (bytes > kLargestMessage_bytes) refuse("a message is larger than any picture");
        std::vector<std::uint8_t> data(std::min(bytes, most));
        message_.read(data);
        return data;
    }

    /// Requires real tables (not views) without generated columns, which could execute expressions.
    void check_tables() const {
        const bool there =
            database_.number(
                "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name "
                "IN ('topics', 'messages')") == 2;
        const bool plain =
            database_.number(
                "SELECT count(*) FROM sqlite_master m, pragma_table_xinfo(m.name) x WHERE m.name "
                "IN ('topics', 'messages') AND x.hidden != 0") == 0;
        if (!there || !plain)
            throw InputError(shown(file()) +
                             " is a database, and not one of ROS 2: give the .db3 file of a bag");
    }

    Database database_;
    BlobReader message_;
};

}  // namespace

std::unique_ptr<BagFile> open_sqlite_bag(const fs::path& file) {
    return std::make_unique<SqliteBag>(file);
}

}  // namespace dibhr
