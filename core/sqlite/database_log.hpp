// A write-ahead log read without SQLite, also one of which parts are damaged.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>
#include <vector>

namespace dibhr {

/// As SQLite stores its numbers.
[[nodiscard]] inline std::uint64_t big_endian(std::span<const std::uint8_t> bytes) noexcept {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) value = value << 8U | byte;
    return value;
}

[[nodiscard]] inline bool is_page_size(std::uint64_t bytes) noexcept {
    return bytes >= 512 && bytes <= 65536 && std::has_single_bit(bytes);
}

/// Fewer, where the file ends.
[[nodiscard]] std::vector<std::uint8_t> bytes_at(std::ifstream& file, std::uint64_t at,
                                                 std::size_t count);

/// The committed pages of a log.
struct LoggedPages {
    std::size_t page_bytes{0};
    bool lacks_frames{false};  ///< some are damaged so that it is not known of which pages
    /// Number of a page and where in the log its bytes are, from old to new.
    std::vector<std::pair<std::uint32_t, std::uint64_t>> places{};
};

/// Also those after a damaged one. `page_bytes`: where the log's head does not say it.
[[nodiscard]] LoggedPages logged_pages(std::ifstream& log, std::size_t page_bytes);

/// Whether a log holds committed pages after one that is damaged, which SQLite does not read. Reads
/// all of it; also while it is written.
[[nodiscard]] bool is_log_damaged(const std::filesystem::path& log);

}  // namespace dibhr
