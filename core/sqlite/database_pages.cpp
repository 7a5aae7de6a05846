// Parses pages; every number is checked before it is used.
#include "core/sqlite/database_pages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string_view>
#include <utility>

namespace dibhr {

namespace {

constexpr std::size_t kHeadBytes = 100;  // of the first page
constexpr std::string_view kMagic = "SQLite format 3";

/// Takes numbers from bytes, one after the other; past their end nothing is taken and `ok` is
/// false.
class Cursor {
  public:
    explicit Cursor(std::span<const std::uint8_t> bytes, std::size_t at = 0)
        : bytes_(bytes), at_(at), ok_(at <= bytes.size()) {}

    [[nodiscard]] bool ok() const noexcept { return ok_; }
    [[nodiscard]] std::size_t at() const noexcept { return at_; }

    std::span<const std::uint8_t> take(std::size_t count) noexcept {
        ok_ = ok_ && count <= bytes_.size() - at_;
        if (!ok_) return {};
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    std::uint64_t number(std::size_t count) noexcept { return big_endian(take(count)); }
    /// 1 to 9 bytes, of which each says whether another one follows.
    std::uint64_t varint() noexcept {
        constexpr int kMostBytes = 9;
        std::uint64_t value = 0;
        for (int k = 1; k <= kMostBytes && ok_; ++k) {
            const std::uint64_t byte = number(1);
            if (k == kMostBytes) return value << 8U | byte;
            value = value << 7U | (byte & 0x7fU);
            if ((byte & 0x80U) == 0) break;
        }
        return value;
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_;
    bool ok_;
};

/// The bytes of a value by its serial type.
std::uint64_t bytes_of_type(std::uint64_t type) noexcept {
    constexpr std::array<std::uint64_t, 12> kBytes{0, 1, 2, 3, 4, 6, 8, 8, 0, 0, 0, 0};
    return type < kBytes.size() ? kBytes[type] : (type - kBytes.size()) / 2;
}

StoredValue value_of(std::uint64_t type, std::span<const std::uint8_t> bytes) {
    constexpr std::uint64_t kReal = 7, kZero = 8, kOne = 9;
    if (type == 0) return {};
    if (type == kReal) return std::bit_cast<double>(big_endian(bytes));
    if (type == kZero || type == kOne) return static_cast<std::int64_t>(type - kZero);
    if (type < kReal) {
        const auto unused = static_cast<int>(64 - 8 * bytes.size());
        return static_cast<std::int64_t>(big_endian(bytes) << unused) >> unused;
    }
    std::string text(bytes.begin(), bytes.end());
    if (type % 2 != 0) return text;
    return StoredBytes{std::move(text)};
}

/// Nothing: it is not as long as its values.
std::optional<std::vector<StoredValue>> values_of(std::span<const std::uint8_t> row) {
    constexpr std::uint64_t kReserved = 10;
    Cursor types(row);
    const std::uint64_t head = types.varint();
    if (head > row.size()) return std::nullopt;
    Cursor content(row, head);
    std::vector<StoredValue> values;
    while (types.ok() && types.at() < head) {
        const std::uint64_t type = types.varint();
        if (type == kReserved || type == kReserved + 1) return std::nullopt;
        const auto bytes = content.take(static_cast<std::size_t>(bytes_of_type(type)));
        if (!content.ok()) return std::nullopt;
        values.push_back(value_of(type, bytes));
    }
    if (!types.ok() || types.at() != head || content.at() != row.size()) return std::nullopt;
    return values;
}

}  // namespace

/// One page's bytes.
class DatabasePages::Parser {
  public:
    Parser(DatabasePages& pages, std::span<const std::uint8_t> bytes, bool first)
        : pages_(pages), bytes_(bytes), begin_(first ? kHeadBytes : 0) {}

    std::optional<StoredPage> page() {
        constexpr std::uint64_t kTableLeaf = 13, kTableBranch = 5, kIndexLeaf = 10,
                                kIndexBranch = 2;
        Cursor head(bytes_, begin_);
        const std::uint64_t kind = head.number(1);
        if (kind != kTableLeaf && kind != kTableBranch && kind != kIndexLeaf &&
            kind != kIndexBranch)
            return std::nullopt;
        page_.index = kind == kIndexLeaf || kind == kIndexBranch;
        branch_ = kind == kTableBranch || kind == kIndexBranch;
        const std::uint64_t free_block = head.number(2);
        const std::uint64_t cells = head.number(2);
        content_ = head.number(2);
        if (content_ == 0) content_ = 65536;
        const std::uint64_t fragments = head.number(1);
        const auto last_child = static_cast<std::uint32_t>(branch_ ? head.number(4) : 0);
        for (std::uint64_t k = 0; k < cells; ++k)
            if (const std::uint64_t at = head.number(2); !head.ok() || !add_cell(at))
                return std::nullopt;
        if (branch_) page_.children.push_back(last_child);
        if (head.at() > content_ || !add_free_blocks(free_block) || unused() != fragments)
            return std::nullopt;
        return std::move(page_);
    }

  private:
    bool add_cell(std::uint64_t at) {
        if (at < content_ || at >= bytes_.size()) return false;
        Cursor cell(bytes_, static_cast<std::size_t>(at));
        if (branch_) page_.children.push_back(static_cast<std::uint32_t>(cell.number(4)));
        const bool holds_row = page_.index || !branch_;
        const std::uint64_t length = holds_row ? cell.varint() : 0;
        const auto number = static_cast<std::int64_t>(page_.index ? 0 : cell.varint());
        if (!page_.index && number <= last_number_ && !is_first_) return false;
        is_first_ = false;
        last_number_ = number;
        if (holds_row && !add_row(length, number, cell)) return false;
        used_.emplace_back(at, std::max<std::uint64_t>(cell.at(), at + kShortest));
        return cell.ok();
    }

    bool add_row(std::uint64_t length, std::int64_t number, Cursor& cell) {
        if (length > pages_.longest_bytes_) return false;
        const std::size_t here = bytes_here(static_cast<std::size_t>(length));
        taken_ += here;  // cells that overlap could make a page of any amount of work
        if (taken_ > bytes_.size()) return false;
        const auto first = cell.take(here);
        Bytes row(first.begin(), first.end());
        if (here < length) {
            const auto rest = static_cast<std::uint32_t>(cell.number(4));
            if (!cell.ok() || !pages_.append_rest(rest, length - here, row)) return false;
        }
        auto values = cell.ok() ? values_of(row) : std::nullopt;
        if (values) page_.rows.push_back({number, std::move(*values)});
        return values.has_value();
    }

    /// Of a row of that length; the rest is on other pages. Section 1.6.
    [[nodiscard]] std::size_t bytes_here(std::size_t length) const noexcept {
        const std::size_t usable = bytes_.size();
        const std::size_t most = page_.index ? (usable - 12) * 64 / 255 - 23 : usable - 35;
        if (length <= most) return length;
        const std::size_t least = (usable - 12) * 32 / 255 - 23;
        const std::size_t here = least + (length - least) % (usable - 4);
        return here <= most ? here : least;
    }

    bool add_free_blocks(std::uint64_t at) {
        std::uint64_t before = 0;
        while (at != 0) {
            if (at < content_ || at <= before) return false;
            Cursor block(bytes_,
                         static_cast<std::size_t>(std::min<std::uint64_t>(at, bytes_.size())));
            const std::uint64_t next = block.number(2);
            const std::uint64_t length = block.number(2);
            if (!block.ok() || length < kShortest || at + length > bytes_.size()) return false;
            used_.emplace_back(at, at + length);
            before = std::exchange(at, next);
        }
        return true;
    }

    /// How many bytes nobody uses; nothing: some are used twice.
    [[nodiscard]] std::optional<std::uint64_t> unused() {
        std::ranges::sort(used_);
        std::uint64_t at = content_;
        std::uint64_t unused = 0;
        for (const auto& [begin, end] : used_) {
            if (begin < at) return std::nullopt;
            unused += begin - at;
            at = end;
        }
        if (at > bytes_.size()) return std::nullopt;
        return unused + bytes_.size() - at;
    }

    static constexpr std::uint64_t kShortest = 4;  ///< bytes of a cell or free block

    DatabasePages& pages_;
    std::span<const std::uint8_t> bytes_;
    std::size_t begin_;
    bool branch_{false};
    std::uint64_t content_{0};
    std::size_t taken_{0};
    bool is_first_{true};
    std::int64_t last_number_{0};
    std::vector<std::pair<std::uint64_t, std::uint64_t>> used_{};
    StoredPage page_{};
};

DatabasePages::DatabasePages(const std::filesystem::path& file, bool with_log,
                             std::size_t page_bytes, std::size_t longest_bytes)
    : page_bytes_(page_bytes), longest_bytes_(longest_bytes), file_(file, std::ios::binary) {
    const Bytes head = bytes_at(file_, 0, kHeadBytes);
    std::uint64_t promised = 0;
    if (head.size() == kHeadBytes && std::ranges::equal(kMagic, std::span(head).first(15))) {
        const std::uint64_t size = big_endian(std::span(head).subspan(16, 2));
        if (is_page_size(size == 1 ? 65536 : size)) page_bytes_ = size == 1 ? 65536 : size;
        promised = big_endian(std::span(head).subspan(28, 4));
    }
    LoggedPages logged{.page_bytes = page_bytes_};
    if (with_log) {
        log_.open(file.string() + "-wal", std::ios::binary);
        logged = logged_pages(log_, page_bytes_);
    }
    page_bytes_ = logged.page_bytes;
    std::error_code failed;
    const std::uint64_t there = std::filesystem::file_size(file, failed);
    // A head that promises far more than there is has other numbers in that place.
    const std::uint64_t most = std::numeric_limits<std::uint32_t>::max() / 2;
    if (!failed) count_ = static_cast<std::uint32_t>(std::min(there / page_bytes_, most));
    if (promised > count_ && promised / 64 <= std::max<std::uint32_t>(count_, 1024))
        count_ = static_cast<std::uint32_t>(promised);
    keep(logged);
    // Of a sound file no page is read more than a few times.
    constexpr std::size_t kTimes = 8;
    rest_left_ = kTimes * page_bytes_ * (std::size_t{count_} + logged_.size());
}

void DatabasePages::keep(const LoggedPages& logged) {
    lacks_frames_ = logged.lacks_frames;
    // Every page behind the file's end has a frame.
    const std::uint64_t most = std::uint64_t{count_} + logged.places.size();
    for (const auto& [page, place] : logged.places) {
        if (page == 0 || page > most) {
            lacks_frames_ = true;
            continue;
        }
        logged_[page].push_back(place);
        count_ = std::max(count_, page);
    }
}

bool DatabasePages::read(std::uint32_t number, std::size_t version, Bytes& bytes) {
    const auto found = logged_.find(number);
    const std::size_t logged = found == logged_.end() ? 0 : found->second.size();
    if (number == 0 || version > logged) return false;
    if (version < logged)
        bytes = bytes_at(log_, found->second[logged - 1 - version], page_bytes_);
    else
        bytes = bytes_at(file_, std::uint64_t{number - 1} * page_bytes_, page_bytes_);
    return true;
}

std::optional<StoredPage> DatabasePages::page(std::uint32_t number) {
    Bytes bytes;
    for (std::size_t version = 0; read(number, version, bytes); ++version) {
        if (bytes.size() < page_bytes_) continue;
        auto page = Parser(*this, bytes, number == 1).page();
        if (!page) continue;
        page->older = version > 0;
        return page;
    }
    return std::nullopt;
}

std::optional<std::uint32_t> DatabasePages::head_number(std::size_t at) {
    Bytes bytes;
    for (std::size_t version = 0; read(1, version, bytes); ++version) {
        if (bytes.size() < kHeadBytes || !std::ranges::equal(kMagic, std::span(bytes).first(15)))
            continue;
        return static_cast<std::uint32_t>(big_endian(std::span(bytes).subspan(at, 4)));
    }
    return std::nullopt;
}

bool DatabasePages::append_rest(std::uint32_t first, std::size_t length, Bytes& to) {
    constexpr std::size_t kNextBytes = 4;
    Bytes bytes;
    for (std::uint32_t number = first; length > 0;) {
        if (!read(number, 0, bytes) || bytes.size() < page_bytes_) return false;
        const std::size_t here = std::min(length, bytes.size() - kNextBytes);
        if (here > rest_left_) return false;
        rest_left_ -= here;
        const auto begin = bytes.begin() + kNextBytes;
        to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(here));
        number = static_cast<std::uint32_t>(big_endian(std::span(bytes).first(kNextBytes)));
        length -= here;
    }
    return true;
}

}  // namespace dibhr
