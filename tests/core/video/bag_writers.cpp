// Bags of ROS 2, byte by byte (MCAP) and by SQLite.
#include "tests/core/video/bag_writers.hpp"

#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tests/core/video/forms.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace fs = std::filesystem;

namespace {

class SqliteWriter : public BagWriter {
  public:
    explicit SqliteWriter(const fs::path& file) {
        if (sqlite3_open(file.c_str(), &database_) != SQLITE_OK) throw std::runtime_error("open");
        run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
            "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
        run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp "
            "INTEGER NOT NULL, data BLOB NOT NULL)");
        run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
        run("BEGIN");
    }
    ~SqliteWriter() override {
        sqlite3_exec(database_, "COMMIT", nullptr, nullptr, nullptr);
        sqlite3_close(database_);
    }
    SqliteWriter(const SqliteWriter&) = delete;
    SqliteWriter& operator=(const SqliteWriter&) = delete;

    int topic(const std::string& name, const std::string& type,
              const std::string& encoding) override {
        run("INSERT INTO topics(name, type, serialization_format, offered_qos_profiles) VALUES('" +
            name + "', '" + type + "', '" + encoding + "', '')");
        return static_cast<int>(sqlite3_last_insert_rowid(database_));
    }
    void add(int topic, const std::string& data, std::int64_t recorded_ns) override {
        sqlite3_stmt* insert = nullptr;
        sqlite3_prepare_v2(database_,
                           "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1,
                           &insert, nullptr);
        sqlite3_bind_int(insert, 1, topic);
        sqlite3_bind_int64(insert, 2, recorded_ns);
        sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_STATIC);
        sqlite3_step(insert);
        sqlite3_finalize(insert);
    }
    void run(const std::string& sql) override {
        sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr);
    }

  private:
    sqlite3* database_{nullptr};
};

template <typename Number>
std::string little(Number number) {
    std::string bytes;
    append_bytes(bytes, number);
    return bytes;
}

std::string text_field(const std::string& text) {
    return little(static_cast<std::uint32_t>(text.size())) + text;
}

std::string mcap_record(char kind, const std::string& content) {
    return kind + little(std::uint64_t{content.size()}) + content;
}

constexpr char kSchema = 3;
constexpr char kChannel = 4;
constexpr char kMessage = 5;

/// https://mcap.dev/spec
class McapWriter : public BagWriter {
  public:
    McapWriter(fs::path file, BagForm form) : file_(std::move(file)), form_(std::move(form)) {
        bytes_ += mcap_record(1, text_field("ros2") + text_field("dibhr's tests"));
    }
    ~McapWriter() override {
        if (form_.finished) finish();
        write_text(file_, bytes_);
    }
    McapWriter(const McapWriter&) = delete;
    McapWriter& operator=(const McapWriter&) = delete;

    int topic(const std::string& name, const std::string& type,
              const std::string& encoding) override {
        const auto id = static_cast<std::uint16_t>(++topics_);
        const std::string definition =
            mcap_record(kSchema, little(id) + text_field(type) + text_field("ros2msg") +
                                     text_field("uint32 height\nuint32 width\n")) +
            mcap_record(kChannel,
                        little(id) + little(id) + text_field(name) + text_field(encoding) +
                            text_field(text_field("offered_qos_profiles") + text_field("")));
        definitions_ += definition;
        (form_.chunks ? chunk_ : bytes_) += definition;
        return topics_;
    }

    void add(int topic, const std::string& data, std::int64_t recorded_ns) override {
        const auto id = static_cast<std::uint16_t>(topic);
        const auto time_ns = static_cast<std::uint64_t>(recorded_ns);
        if (form_.chunks) index_[id] += little(time_ns) + little(std::uint64_t{chunk_.size()});
        (form_.chunks ? chunk_ : bytes_) += mcap_record(
            kMessage, little(id) + little(++messages_) + little(time_ns) + little(time_ns) + data);
        if (form_.chunks && chunk_.size() >= form_.chunk_bytes) end_chunk();
    }

  private:
    void end_chunk() {
        const std::uint64_t begin = bytes_.size();
        const std::string records = packed_bytes(chunk_, form_.packing);
        const std::string times = little(std::uint64_t{0}) + little(~std::uint64_t{0});
        const std::uint64_t unpacked = chunk_.size();
        bytes_ += mcap_record(6, times + little(unpacked) + little(std::uint32_t{0}) +
                                     text_field(form_.packing) +
                                     little(std::uint64_t{records.size()}) + records);
        const std::uint64_t end = bytes_.size();
        std::string places;
        for (const auto& [topic, entries] : index_) {
            if (!form_.message_index) break;
            places += little(topic) + little(std::uint64_t{bytes_.size()});
            bytes_ += mcap_record(7, little(topic) + text_field(entries));
        }
        chunk_indexes_ += mcap_record(
            8, times + little(begin) + little(end - begin) + text_field(places) +
                   little(std::uint64_t{bytes_.size()} - end) + text_field(form_.packing) +
                   little(std::uint64_t{records.size()}) + little(unpacked));
        chunk_.clear();
        index_.clear();
    }

    void finish() {
        if (!chunk_.empty()) end_chunk();
        bytes_ += mcap_record(15, little(std::uint32_t{0}));
        const std::uint64_t summary = form_.summary ? bytes_.size() : 0;
        if (form_.summary) bytes_ += definitions_ + chunk_indexes_;
        bytes_ +=
            mcap_record(2, little(summary) + little(std::uint64_t{0}) + little(std::uint32_t{0}));
        bytes_ += kMagic;
    }

    static constexpr std::string_view kMagic = "\x89MCAP0\r\n";

    fs::path file_;
    BagForm form_;
    int topics_{0};
    std::uint32_t messages_{0};
    std::string bytes_{kMagic};
    std::string definitions_{};                     ///< schemas and channels
    std::string chunk_indexes_{};                   ///< of the summary
    std::string chunk_{};                           ///< the records of the chunk that is written
    std::map<std::uint16_t, std::string> index_{};  ///< its entries by topic
};

}  // namespace

CdrWriter& CdrWriter::text(const std::string& letters) {
    number(static_cast<std::uint32_t>(letters.size() + 1));
    bytes_ += letters + '\0';
    return *this;
}

CdrWriter& CdrWriter::sequence(const std::string& data) {
    number(static_cast<std::uint32_t>(data.size()));
    bytes_ += data;
    return *this;
}

CdrWriter& CdrWriter::header(double stamp_s, const std::string& frame) {
    const double whole_s = std::floor(stamp_s);
    number(static_cast<std::int32_t>(whole_s));
    number(static_cast<std::uint32_t>(std::llround((stamp_s - whole_s) * 1e9)));
    return text(frame);
}

std::string image(double stamp_s, int columns, int rows, const std::string& encoding, int step,
                  const std::string& data, bool big_endian) {
    return CdrWriter()
        .header(stamp_s)
        .number(static_cast<std::uint32_t>(rows))
        .number(static_cast<std::uint32_t>(columns))
        .text(encoding)
        .number(static_cast<std::uint8_t>(big_endian ? 1 : 0))
        .number(static_cast<std::uint32_t>(step))
        .sequence(data)
        .bytes();
}

std::string depth_image(double stamp_s, int level, int columns, int rows) {
    const std::vector<std::uint16_t> levels(static_cast<std::size_t>(columns * rows),
                                            static_cast<std::uint16_t>(level));
    std::string data(2 * levels.size(), '\0');
    std::memcpy(data.data(), levels.data(), data.size());
    return image(stamp_s, columns, rows, "16UC1", 2 * columns, data);
}

std::string packed_bytes(const std::string& data, const std::string& packing) {
    std::string packed;
    if (packing == "zstd") {
        packed.resize(ZSTD_compressBound(data.size()));
        packed.resize(ZSTD_compress(packed.data(), packed.size(), data.data(), data.size(), 1));
    } else if (packing == "lz4") {
        packed.resize(LZ4F_compressFrameBound(data.size(), nullptr));
        packed.resize(
            LZ4F_compressFrame(packed.data(), packed.size(), data.data(), data.size(), nullptr));
    } else {
        packed = data;
    }
    return packed;
}

std::string BagForm::name() const {
    return ending + (packing.empty() ? "" : ", " + packing) + (chunks ? "" : ", no chunks") +
           (message_index ? "" : ", no message index") + (summary ? "" : ", no summary");
}

std::vector<BagForm> mcap_forms() {
    return {{},
            {.packing = "zstd"},
            {.packing = "lz4"},
            {.packing = "zstd", .message_index = false},
            {.packing = "lz4", .summary = false},
            {.chunks = false},
            {.chunks = false, .summary = false}};
}

std::vector<BagForm> bag_forms() {
    std::vector<BagForm> forms = mcap_forms();
    forms.push_back({.ending = ".db3"});
    return forms;
}

Bag::Bag(const fs::path& file, const BagForm& form) {
    if (form.ending == ".db3")
        writer_ = std::make_unique<SqliteWriter>(file);
    else
        writer_ = std::make_unique<McapWriter>(file, form);
}

}  // namespace dibhr::test
