// The frames of a log. SQLite's file format, section 4.
#include "core/sqlite/database_log.hpp"

#include <algorithm>
#include <optional>

namespace dibhr {

namespace {

constexpr std::size_t kLogHeadBytes = 32;
constexpr std::size_t kFrameHeadBytes = 24;

/// The checksum of the log, which goes on from frame to frame.
class LogSum {
  public:
    explicit LogSum(bool big_endian) : big_(big_endian) {}

    void add(std::span<const std::uint8_t> bytes) noexcept {
        for (std::size_t k = 0; k + 8 <= bytes.size(); k += 8) {
            a_ += word(bytes.subspan(k, 4)) + b_;
            b_ += word(bytes.subspan(k + 4, 4)) + a_;
        }
    }
    [[nodiscard]] bool is(std::span<const std::uint8_t> stored) const noexcept {
        return big_endian(stored) == (std::uint64_t{a_} << 32U | b_);
    }

  private:
    [[nodiscard]] std::uint32_t word(std::span<const std::uint8_t> bytes) const noexcept {
        const auto value = static_cast<std::uint32_t>(big_endian(bytes));
        return big_ ? value : __builtin_bswap32(value);
    }

    bool big_;
    std::uint32_t a_{0}, b_{0};
};

/// What a log's frames are known by.
struct LogHead {
    std::size_t page_bytes{0};
    bool big_endian{false};
    bool whole{false};  ///< its sum is right
    std::vector<std::uint8_t> bytes{};

    /// Whether a frame was written after this head: both have the same salt.
    [[nodiscard]] bool owns(std::span<const std::uint8_t> frame) const noexcept {
        return frame.size() >= kFrameHeadBytes &&
               std::ranges::equal(frame.subspan(8, 8), std::span(bytes).subspan(16, 8));
    }
    /// The sum that the first frame's goes on from.
    [[nodiscard]] LogSum sum() const noexcept {
        LogSum sum(big_endian);
        sum.add(std::span(bytes).first(kLogHeadBytes - 8));
        return sum;
    }
};

/// Nothing: there is no frame after it. A damaged head takes the salt of the first frame.
std::optional<LogHead> head_of(std::ifstream& log, std::size_t page_bytes) {
    constexpr std::uint64_t kLogMagic = 0x377f0682;
    LogHead head{.page_bytes = page_bytes, .bytes = bytes_at(log, 0, kLogHeadBytes)};
    const auto frame = bytes_at(log, kLogHeadBytes, kFrameHeadBytes);
    if (frame.size() < kFrameHeadBytes) return std::nullopt;
    const std::span<const std::uint8_t> bytes(head.bytes);
    const std::uint64_t magic = big_endian(bytes.first(4));
    const std::uint64_t page = big_endian(bytes.subspan(8, 4));
    head.big_endian = (magic & 1U) != 0;
    head.whole = (magic & ~std::uint64_t{1}) == kLogMagic && is_page_size(page) &&
                 head.sum().is(bytes.subspan(24, 8));
    if (head.whole)
        head.page_bytes = static_cast<std::size_t>(page);
    else
        std::ranges::copy(std::span(frame).subspan(8, 8), head.bytes.begin() + 16);
    return head;
}

bool ends_a_transaction(std::span<const std::uint8_t> frame) noexcept {
    return big_endian(frame.subspan(4, 4)) != 0;
}

}  // namespace

std::vector<std::uint8_t> bytes_at(std::ifstream& file, std::uint64_t at, std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return bytes;
}

LoggedPages logged_pages(std::ifstream& log, std::size_t page_bytes) {
    LoggedPages logged{.page_bytes = page_bytes};
    const std::optional<LogHead> head = head_of(log, page_bytes);
    if (!head) return logged;
    logged.page_bytes = head->page_bytes;
    std::size_t committed = 0;
    bool lacks_frame = false;
    for (std::uint64_t at = kLogHeadBytes;; at += kFrameHeadBytes + head->page_bytes) {
        const auto frame = bytes_at(log, at, kFrameHeadBytes);
        if (frame.size() < kFrameHeadBytes) break;
        if (!head->owns(frame)) {
            lacks_frame = true;
            continue;
        }
        const auto page = static_cast<std::uint32_t>(big_endian(std::span(frame).first(4)));
        logged.places.emplace_back(page, at + kFrameHeadBytes);
        if (!ends_a_transaction(frame)) continue;
        committed = logged.places.size();
        logged.lacks_frames = lacks_frame;
    }
    logged.places.resize(committed);
    return logged;
}

bool is_log_damaged(const std::filesystem::path& log) {
    std::ifstream file(log, std::ios::binary);
    const std::optional<LogHead> head = head_of(file, 0);
    if (!head) return false;
    if (!head->whole) return true;
    const std::size_t step = kFrameHeadBytes + head->page_bytes;
    /// The sum after a frame; nothing: it is damaged, or not written yet.
    const auto sum_after = [&](std::uint64_t at, LogSum sum) -> std::optional<LogSum> {
        const auto frame = bytes_at(file, at, step);
        if (frame.size() < step || !head->owns(frame)) return std::nullopt;
        sum.add(std::span(frame).first(8));
        sum.add(std::span(frame).subspan(kFrameHeadBytes));
        return sum.is(std::span(frame).subspan(16, 8)) ? std::optional(sum) : std::nullopt;
    };
    LogSum sum = head->sum();
    std::uint64_t end = kLogHeadBytes;
    while (const auto next = sum_after(end, sum)) {
        sum = *next;
        end += step;
    }
    for (std::uint64_t at = end + step;; at += step) {
        const auto frame = bytes_at(file, at, kFrameHeadBytes);
        if (frame.size() < kFrameHeadBytes) return false;
        if (!head->owns(frame) || !ends_a_transaction(frame)) continue;
        // While it is written, the frame may have come meanwhile, or another log have begun.
        const std::optional<LogHead> now = head_of(file, 0);
        return now && now->bytes == head->bytes && !sum_after(end, sum);
    }
}

}  // namespace dibhr
