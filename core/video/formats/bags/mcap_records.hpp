// The records of an MCAP file, and their fields (https://mcap.dev/spec); inside the room.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace dibhr {

inline constexpr std::uint64_t kMcapMagic_bytes = 8;     ///< at both ends of a file
inline constexpr std::uint64_t kMcapHead_bytes = 9;      ///< a record's kind, and its length
inline constexpr std::uint64_t kMcapMessage_bytes = 22;  ///< of a message before its data

/// The kinds of records that are read.
enum class McapKind : std::uint8_t {
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    data_end = 0x0f
};

/// Reads the fields of a record. Beyond its end it gives zeros, and whole() is false.
class McapFields {
  public:
    explicit McapFields(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    [[nodiscard]] bool whole() const noexcept { return whole_; }
    [[nodiscard]] std::size_t left() const noexcept { return rest_.size(); }

    template <std::unsigned_integral Number>
    Number number() {
        const auto digits = take(sizeof(Number));
        std::uint64_t value = 0;
        for (std::size_t k = digits.size(); k-- > 0;) value = (value << 8U) | digits[k];
        return static_cast<Number>(value);
    }

    std::span<const std::uint8_t> bytes() { return take(number<std::uint32_t>()); }

    /// The first thousand letters.
    std::string text();

  private:
    std::span<const std::uint8_t> take(std::size_t count);

    std::span<const std::uint8_t> rest_;
    bool whole_{true};
};

/// Bytes of a file at any place; small reads that are near each other cost one call.
class FileWindow {
  public:
    explicit FileWindow(const std::filesystem::path& file);

    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// False where the file has fewer bytes.
    [[nodiscard]] bool read(std::uint64_t at, std::span<std::uint8_t> to);

  private:
    [[nodiscard]] bool load(std::uint64_t at, std::span<std::uint8_t> to);

    std::ifstream stream_;
    std::uint64_t size_;
    std::uint64_t begin_{0};  ///< of the window
    std::vector<std::uint8_t> window_{};
};

struct McapRecord {
    McapKind kind{};
    std::uint64_t at{0};     ///< of its content
    std::uint64_t bytes{0};  ///< of its content
    bool whole{false};       ///< it ends before what it is in ends

    [[nodiscard]] std::uint64_t begin() const noexcept { return at - kMcapHead_bytes; }
    [[nodiscard]] std::uint64_t end() const noexcept { return at + bytes; }  ///< of a whole one
};

/// Reads from a file or from a chunk; false where there are fewer bytes.
using McapRead = std::function<bool(std::uint64_t at, std::span<std::uint8_t> to)>;

/// Calls `each` with the records of a range until it returns false; the last one may be cut off,
/// and zeros end the range. Returns the end of the last whole record that was taken.
std::uint64_t for_each_record(const McapRead& read, std::uint64_t begin, std::uint64_t end,
                              const std::function<bool(const McapRecord&)>& each);

}  // namespace dibhr
