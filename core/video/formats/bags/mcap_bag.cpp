// Reads a bag in MCAP: by the index at its end, or record by record where the recording was cut off
// (https://mcap.dev/spec). Messages are read where they are; of packed chunks the last two used are
// in memory.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/files/names.hpp"
#include "core/video/formats/bags/bag_file.hpp"
#include "core/video/formats/bags/mcap_records.hpp"
#include "core/video/formats/bags/unpacked_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Enough of a chunk's record for its fields, with the name of its packing.
constexpr std::uint64_t kChunkFields_bytes = 80;

struct McapChannel {
    std::uint16_t schema{0};
    std::string topic{};
    std::string encoding{};
};

/// A chunk, or messages that follow each other outside of chunks.
struct McapChunk {
    std::uint64_t begin{0};
    std::uint64_t bytes{0};        ///< as far as they are in the file
    std::uint64_t index_bytes{0};  ///< of the message indexes that follow it; 0: it has none
    bool loose{false};             ///< no chunk: begins with a message

    [[nodiscard]] std::uint64_t end() const noexcept { return begin + bytes; }
};

/// The records in a chunk.
struct ChunkRecords {
    std::uint64_t begin{0};           ///< in the file
    std::uint64_t bytes{0};           ///< in the file
    std::uint64_t unpacked_bytes{0};  ///< as many where they are not packed
    std::optional<CompressionFormat> packed{};
};

struct OpenChunk {
    std::size_t number{0};
    ChunkRecords records{};
    std::unique_ptr<UnpackedBytes> unpacked{};  ///< null: the records are not packed
};

class McapBag : public BagFile {
  public:
    explicit McapBag(const fs::path& place) : BagFile(place), window_(place) {
        if (read_summary()) return;
        schemas_.clear();
        channels_.clear();
        chunks_.clear();
        scan();
    }

    [[nodiscard]] std::vector<Topic> topics() override {
        std::vector<Topic> topics;
        for (const auto& [id, channel] : channels_) {
            const auto schema = schemas_.find(channel.schema);
            std::string type = schema == schemas_.end() ? std::string() : schema->second;
            if (channel.encoding != "cdr") type += " in " + channel.encoding;
            topics.push_back({id, channel.topic, std::move(type)});
        }
        return topics;
    }

    [[nodiscard]] std::vector<BagMessage> messages(std::int64_t topic, std::size_t most) override {
        std::vector<BagMessage> found;
        for (std::size_t k = 0; k < chunks_.size() && found.size() < most; ++k) {
            const std::size_t before = found.size();
            if (append_indexed(k, topic, most, found)) continue;
            found.resize(before);
            append_inspected(k, topic, most, found);
        }
        return found;
    }

    [[nodiscard]] std::string notice() const override {
        if (!cut_off_) return {};
        return shown(file()) +
               " was cut off while it was recorded or copied: what is whole of it is read";
    }

  private:
    static constexpr int kOffsetBits = 32;  ///< of a row: the place in the chunk; above: its number

    [[nodiscard]] std::vector<std::uint8_t> stored(std::int64_t row, std::size_t most) override {
        const auto place = static_cast<std::uint64_t>(row);
        const std::uint64_t at = place & ((std::uint64_t{1} << kOffsetBits) - 1);
        OpenChunk& chunk = opened(static_cast<std::size_t>(place >> kOffsetBits));
        std::array<std::uint8_t, kMcapHead_bytes> head{};
        if (!read(chunk, at, head)) refuse("a chunk is damaged");
        McapFields fields(head);
        const McapKind kind{fields.number<std::uint8_t>()};
        const auto bytes = fields.number<std::uint64_t>();
        const std::uint64_t data_at = at + kMcapHead_bytes + kMcapMessage_bytes;
        if (kind != McapKind::message || bytes < kMcapMessage_bytes ||
            data_at > chunk.records.unpacked_bytes ||
            bytes - kMcapMessage_bytes > chunk.records.unpacked_bytes - data_at)
            refuse("an index is damaged");
        if (bytes - kMcapMessage_bytes > kLargestMessage_bytes)
            refuse("a message is larger than any picture");
        std::vector<std::uint8_t> data(std::min<std::uint64_t>(bytes - kMcapMessage_bytes, most));
        if (!read(chunk, data_at, data)) refuse("a chunk is damaged");
        return data;
    }

    // ---- the file's structure

    [[nodiscard]] McapRead from_file() {
        return
            [this](std::uint64_t at, std::span<std::uint8_t> to) { return window_.read(at, to); };
    }

    /// The first bytes of a record's content, far more than the fields that are read.
    [[nodiscard]] static std::vector<std::uint8_t> content(const McapRead& from,
                                                           const McapRecord& record) {
        constexpr std::uint64_t kMost_bytes = 1 << 20;
        std::vector<std::uint8_t> bytes(std::min(record.bytes, kMost_bytes));
        if (!from(record.at, bytes)) bytes.clear();
        return bytes;
    }

    void add_schema(const std::vector<std::uint8_t>& bytes) {
        McapFields fields(bytes);
        const auto id = fields.number<std::uint16_t>();
        std::string name = fields.text();
        if (fields.whole()) schemas_.emplace(id, std::move(name));
    }

    void add_channel(const std::vector<std::uint8_t>& bytes) {
        McapFields fields(bytes);
        const auto id = fields.number<std::uint16_t>();
        McapChannel channel{.schema = fields.number<std::uint16_t>()};
        channel.topic = fields.text();
        channel.encoding = fields.text();
        if (fields.whole()) channels_.emplace(id, std::move(channel));
    }

    void add_definition(const McapRead& from, const McapRecord& record) {
        if (!record.whole) return;
        if (record.kind == McapKind::schema) add_schema(content(from, record));
        if (record.kind == McapKind::channel) add_channel(content(from, record));
    }

    /// Adds a chunk of the index; false when it is not in the file.
    [[nodiscard]] bool add_chunk(const std::vector<std::uint8_t>& bytes) {
        McapFields fields(bytes);
        (void)fields.number<std::uint64_t>();  // the time of its first message
        (void)fields.number<std::uint64_t>();  // of its last one
        McapChunk chunk{.begin = fields.number<std::uint64_t>()};
        chunk.bytes = fields.number<std::uint64_t>();
        (void)fields.bytes();  // where the message index of each channel begins
        chunk.index_bytes = fields.number<std::uint64_t>();
        const std::uint64_t size = window_.size();
        if (!fields.whole() || chunk.begin > size || chunk.bytes > size - chunk.begin ||
            chunk.index_bytes > size - chunk.end())
            return false;
        chunks_.push_back(chunk);
        return true;
    }

    /// Whether the channel and its schema are known.
    [[nodiscard]] bool is_defined(std::uint16_t channel) const {
        const auto found = channels_.find(channel);
        return found != channels_.end() &&
               (found->second.schema == 0 || schemas_.contains(found->second.schema));
    }

    /// False when the file has no whole index of its chunks at its end.
    [[nodiscard]] bool read_summary() {
        constexpr std::uint64_t kFooterBytes = 20;
        std::array<std::uint8_t, kMcapHead_bytes + kFooterBytes + kMcapMagic_bytes> end{};
        std::array<std::uint8_t, kMcapMagic_bytes> magic{};
        cut_off_ = true;
        if (window_.size() < end.size() || !window_.read(0, magic) ||
            !window_.read(window_.size() - end.size(), end))
            return false;
        McapFields fields(end);
        if (McapKind{fields.number<std::uint8_t>()} != McapKind::footer ||
            fields.number<std::uint64_t>() != kFooterBytes ||
            !std::equal(magic.begin(), magic.end(), end.end() - kMcapMagic_bytes))
            return false;
        cut_off_ = false;
        const std::uint64_t begin = fields.number<std::uint64_t>();
        const std::uint64_t footer = window_.size() - end.size();
        if (begin < kMcapMagic_bytes || begin > footer) return false;  // 0: there is none
        bool is_sound = true;
        const McapRead from = from_file();
        const std::uint64_t last =
            for_each_record(from, begin, footer, [&](const McapRecord& record) {
                add_definition(from, record);
                if (record.kind == McapKind::chunk_index)
                    is_sound = record.whole && add_chunk(content(from, record));
                return is_sound;
            });
        return is_sound && last == footer && !chunks_.empty() && !channels_.empty() &&
               std::all_of(channels_.begin(), channels_.end(),
                           [this](const auto& entry) { return is_defined(entry.first); }) &&
               are_apart();
    }

    /// Puts the chunks in order; false when they overlap.
    [[nodiscard]] bool are_apart() {
        std::sort(chunks_.begin(), chunks_.end(),
                  [](const McapChunk& a, const McapChunk& b) { return a.begin < b.begin; });
        return std::adjacent_find(chunks_.begin(), chunks_.end(),
                                  [](const McapChunk& a, const McapChunk& b) {
                                      return b.begin < a.end() + a.index_bytes || a.bytes == 0;
                                  }) == chunks_.end();
    }

    /// Reads the heads of all records from the beginning, up to the last whole one.
    void scan() {
        const McapRead from = from_file();
        bool has_end = false;
        for_each_record(from, kMcapMagic_bytes, window_.size(), [&](const McapRecord& record) {
            has_end = record.kind == McapKind::data_end || record.kind == McapKind::footer;
            if (has_end) return false;
            add_definition(from, record);
            if (record.kind == McapKind::message && record.whole) add_loose(record);
            const std::uint64_t there =
                record.whole ? record.bytes + kMcapHead_bytes : window_.size() - record.begin();
            if (record.kind == McapKind::chunk && (record.whole || there >= kChunkFields_bytes))
                chunks_.push_back({.begin = record.begin(), .bytes = there});
            const bool has_chunk = !chunks_.empty() && !chunks_.back().loose;
            if (record.kind == McapKind::message_index && record.whole && has_chunk)
                chunks_.back().index_bytes = record.end() - chunks_.back().end();
            return true;
        });
        cut_off_ = cut_off_ || !has_end;
        // Of the last chunk's indexes some may be missing.
        if (!has_end && !chunks_.empty()) chunks_.back().index_bytes = 0;
        for (std::size_t k = 0; k < chunks_.size(); ++k) {
            if (!chunks_[k].loose && has_undefined_channel(chunks_[k])) read_definitions(k);
        }
    }

    /// Adds a message outside of chunks to those before it.
    void add_loose(const McapRecord& record) {
        constexpr std::uint64_t kMost_bytes = 1 << 30;  // places in it fit into a row
        if (chunks_.empty() || !chunks_.back().loose ||
            record.begin() - chunks_.back().begin > kMost_bytes)
            chunks_.push_back({.begin = record.begin(), .loose = true});
        chunks_.back().bytes = record.end() - chunks_.back().begin;
    }

    /// Calls `each` with every message index of a chunk; false when they are damaged or missing.
    [[nodiscard]] bool for_each_index(
        const McapChunk& chunk,
        const std::function<void(std::uint16_t channel, const McapRecord& entries)>& each) {
        const McapRead from = from_file();
        bool is_sound = chunk.index_bytes > 0;
        const std::uint64_t end = chunk.end() + chunk.index_bytes;
        const std::uint64_t last =
            for_each_record(from, chunk.end(), end, [&](const McapRecord& record) {
                std::array<std::uint8_t, 6> head{};
                is_sound = is_sound && record.kind == McapKind::message_index && record.whole &&
                           record.bytes >= head.size() && from(record.at, head);
                McapFields fields(head);
                const auto channel = fields.number<std::uint16_t>();
                const auto bytes = fields.number<std::uint32_t>();
                is_sound = is_sound && bytes <= record.bytes - head.size();
                if (is_sound) each(channel, {.at = record.at + head.size(), .bytes = bytes});
                return is_sound;
            });
        return is_sound && last == end;
    }

    [[nodiscard]] bool has_undefined_channel(const McapChunk& chunk) {
        bool found = false;
        const bool is_sound = for_each_index(chunk, [&](std::uint16_t channel, const McapRecord&) {
            found = found || !is_defined(channel);
        });
        return found || !is_sound;
    }

    /// Reads the schemas and channels in a chunk.
    void read_definitions(std::size_t number) {
        OpenChunk& chunk = opened(number);
        const McapRead from = reader_of(chunk);
        for_each_record(from, 0, chunk.records.unpacked_bytes, [&](const McapRecord& record) {
            add_definition(from, record);
            return true;
        });
    }

    // ---- messages of a chunk

    /// A row for each entry of the chunk's index; false when it has none.
    [[nodiscard]] bool append_indexed(std::size_t number, std::int64_t topic, std::size_t most,
                                      std::vector<BagMessage>& found) {
        std::uint64_t unpacked = 0;
        return for_each_index(
            chunks_[number], [&](std::uint16_t channel, const McapRecord& entries) {
                if (channel != topic) return;
                const bool is_packed = records_of(chunks_[number]).packed.has_value();
                std::array<std::uint8_t, 16> entry{};
                for (std::uint64_t k = 0; k + entry.size() <= entries.bytes; k += entry.size()) {
                    if (found.size() >= most || !window_.read(entries.at + k, entry)) return;
                    McapFields fields(entry);
                    const auto time_ns = fields.number<std::uint64_t>();
                    const auto at = fields.number<std::uint64_t>();
                    append(number, at, time_ns, is_packed, unpacked, found);
                }
            });
    }

    /// A row for each whole message, which is found by reading the chunk.
    void append_inspected(std::size_t number, std::int64_t topic, std::size_t most,
                          std::vector<BagMessage>& found) {
        OpenChunk& chunk = opened(number);
        const McapRead from = reader_of(chunk);
        std::uint64_t unpacked = 0;
        for_each_record(from, 0, chunk.records.unpacked_bytes, [&](const McapRecord& record) {
            if (record.kind != McapKind::message) return true;
            std::array<std::uint8_t, kMcapMessage_bytes> head{};
            std::array<std::uint8_t, 1> last{};
            if (!record.whole || record.bytes < head.size() || !from(record.at, head) ||
                !from(record.end() - 1, last))
                return false;
            McapFields fields(head);
            if (fields.number<std::uint16_t>() == topic) {
                (void)fields.number<std::uint32_t>();  // counts the messages
                append(number, record.begin(), fields.number<std::uint64_t>(),
                       chunk.unpacked != nullptr, unpacked, found);
            }
            return found.size() < most;
        });
    }

    /// `unpacked`: how far the chunk must be unpacked for the messages before.
    static void append(std::size_t number, std::uint64_t at, std::uint64_t time_ns, bool is_packed,
                       std::uint64_t& unpacked, std::vector<BagMessage>& found) {
        constexpr std::uint64_t kLast = (std::uint64_t{1} << kOffsetBits) - 1;
        const std::uint64_t place = std::min(at, kLast);  // beyond every chunk: refused when read
        const std::uint64_t more = is_packed && place > unpacked ? place - unpacked : 0;
        unpacked += more;
        constexpr std::uint64_t kLast_ns = std::numeric_limits<std::int64_t>::max();
        found.push_back({static_cast<std::int64_t>((std::uint64_t{number} << kOffsetBits) | place),
                         static_cast<std::int64_t>(std::min(time_ns, kLast_ns)), more});
    }

    /// Where the records of a chunk are, and how they are packed.
    [[nodiscard]] ChunkRecords records_of(const McapChunk& chunk) {
        if (chunk.loose) return {chunk.begin, chunk.bytes, chunk.bytes, std::nullopt};
        std::array<std::uint8_t, kChunkFields_bytes> bytes{};
        const auto head = std::span(bytes).first(std::min(chunk.bytes, kChunkFields_bytes));
        if (!window_.read(chunk.begin, head)) refuse("its index is damaged");
        McapFields fields(head);
        const McapKind kind{fields.number<std::uint8_t>()};
        // Its length, and the times of its first and its last message.
        for (int k = 0; k < 3; ++k) (void)fields.number<std::uint64_t>();
        const auto unpacked_bytes = fields.number<std::uint64_t>();
        (void)fields.number<std::uint32_t>();  // the checksum
        const std::string packing = fields.text();
        const auto packed_bytes = fields.number<std::uint64_t>();
        if (kind != McapKind::chunk || !fields.whole()) refuse("a chunk is damaged");
        ChunkRecords records;
        records.begin = chunk.begin + head.size() - fields.left();
        records.bytes = std::min(packed_bytes, chunk.end() - records.begin);
        records.unpacked_bytes = records.bytes;
        if (packing.empty()) return records;
        if (packing != "zstd" && packing != "lz4") refuse("its chunks are packed with " + packing);
        const std::uint64_t most_bytes = most_unpacked(records.bytes);
        const bool is_whole = records.bytes == packed_bytes;
        if (unpacked_bytes > most_bytes && is_whole)
            refuse("a chunk claims to be larger than it can be");
        records.packed = packing == "lz4" ? CompressionFormat::lz4 : CompressionFormat::zstd;
        records.unpacked_bytes = std::min(unpacked_bytes, most_bytes);
        return records;
    }

    /// The chunk stays open until two others were used.
    [[nodiscard]] OpenChunk& opened(std::size_t number) {
        constexpr std::size_t kMostOpen = 2;
        const auto found = std::find_if(open_.begin(), open_.end(), [&](const OpenChunk& chunk) {
            return chunk.number == number;
        });
        if (found != open_.end()) {
            std::rotate(found, found + 1, open_.end());
            return open_.back();
        }
        OpenChunk chunk{.number = number, .records = records_of(chunks_.at(number))};
        const ChunkRecords& records = chunk.records;
        if (records.packed) {
            const auto next = [this, at = records.begin, end = records.begin + records.bytes](
                                  std::span<std::uint8_t> to) mutable -> std::size_t {
                const std::size_t count = std::min<std::uint64_t>(to.size(), end - at);
                if (!window_.read(at, to.first(count))) return 0;
                at += count;
                return count;
            };
            chunk.unpacked =
                std::make_unique<UnpackedBytes>(*records.packed, next, records.unpacked_bytes);
        }
        if (open_.size() == kMostOpen) open_.erase(open_.begin());
        open_.push_back(std::move(chunk));
        return open_.back();
    }

    [[nodiscard]] bool read(OpenChunk& chunk, std::uint64_t at, std::span<std::uint8_t> to) {
        if (chunk.unpacked) return chunk.unpacked->read(at, to);
        if (at > chunk.records.bytes || to.size() > chunk.records.bytes - at) return false;
        return window_.read(chunk.records.begin + at, to);
    }

    [[nodiscard]] McapRead reader_of(OpenChunk& chunk) {
        return [this, &chunk](std::uint64_t at, std::span<std::uint8_t> to) {
            return read(chunk, at, to);
        };
    }

    FileWindow window_;
    bool cut_off_{false};
    std::map<std::uint16_t, std::string> schemas_{};  ///< their names
    std::map<std::uint16_t, McapChannel> channels_{};
    std::vector<McapChunk> chunks_{};  ///< in their order in the file
    std::vector<OpenChunk> open_{};    ///< the one used last is the last
};

}  // namespace

std::unique_ptr<BagFile> open_mcap_bag(const fs::path& file) {
    return std::make_unique<McapBag>(file);
}

}  // namespace dibhr
