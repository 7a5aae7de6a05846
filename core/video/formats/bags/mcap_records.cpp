// Reads fields, bytes of the file, and records one after the other.
#include "core/video/formats/bags/mcap_records.hpp"

#include <algorithm>
#include <array>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kWindow_bytes = 1 << 13;

}  // namespace

std::string McapFields::text() {
    constexpr std::size_t kMostLetters = 1000;
    const auto letters = bytes();
    const auto kept = letters.first(std::min(letters.size(), kMostLetters));
    return {kept.begin(), kept.end()};
}

std::span<const std::uint8_t> McapFields::take(std::size_t count) {
    whole_ = whole_ && count <= rest_.size();
    if (!whole_) return {};
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
}

FileWindow::FileWindow(const std::filesystem::path& file)
    : stream_(file, std::ios::binary), size_(size_of(file)) {}

bool FileWindow::read(std::uint64_t at, std::span<std::uint8_t> to) {
    if (at > size_ || to.size() > size_ - at) return false;
    if (to.size() >= kWindow_bytes) return load(at, to);
    const bool is_inside = at >= begin_ && at + to.size() <= begin_ + window_.size();
    if (!is_inside) {
        begin_ = at;
        window_.resize(std::min<std::uint64_t>(kWindow_bytes, size_ - at));
        if (!load(at, window_)) {
            window_.clear();
            return false;
        }
    }
    std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(at - begin_), to.size(), to.begin());
    return true;
}

bool FileWindow::load(std::uint64_t at, std::span<std::uint8_t> to) {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(at));
    stream_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
    return stream_.gcount() == static_cast<std::streamsize>(to.size());
}

std::uint64_t for_each_record(const McapRead& read, std::uint64_t begin, std::uint64_t end,
                              const std::function<bool(const McapRecord&)>& each) {
    std::uint64_t at = begin;
    std::array<std::uint8_t, kMcapHead_bytes> head{};
    // Zero is no kind: a crash left the end of the file empty.
    while (at <= end && end - at >= kMcapHead_bytes && read(at, head) && head[0] != 0) {
        McapFields fields(head);
        McapRecord record{.kind = McapKind{fields.number<std::uint8_t>()},
                          .at = at + kMcapHead_bytes};
        record.bytes = fields.number<std::uint64_t>();
        record.whole = record.bytes <= end - record.at;
        if (!each(record) || !record.whole) break;
        at = record.end();
    }
    return at;
}

}  // namespace dibhr
