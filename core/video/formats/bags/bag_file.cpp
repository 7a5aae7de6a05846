// Tells the forms of bags apart, and unpacks messages.
#include "core/video/formats/bags/bag_file.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/sqlite/database.hpp"
#include "core/video/formats/bags/unpacked_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

bool is_mcap(std::string_view head) {
    return head.starts_with("\x89MCAP0\r\n");
}

/// Whether a message is packed. CDR begins with a zero.
bool is_zstd(const std::vector<std::uint8_t>& message) {
    constexpr std::array<std::uint8_t, 4> kMagic{0x28, 0xb5, 0x2f, 0xfd};
    return message.size() >= kMagic.size() &&
           std::equal(kMagic.begin(), kMagic.end(), message.begin());
}

}  // namespace

std::vector<std::uint8_t> BagFile::data(std::int64_t row, std::size_t most) {
    std::vector<std::uint8_t> found = stored(row, most);
    if (!is_zstd(found)) return found;
    // The longest block of zstd (RFC 8878, section 3.1.1.2.4) with the headers before it.
    constexpr std::size_t kFirstBlock_bytes = (1 << 17) + 64;
    found = stored(row, most <= kFirstBlock_bytes / 2 ? kFirstBlock_bytes : kLargestMessage_bytes);
    const auto next =
        [rest = std::span<const std::uint8_t>(found)](std::span<std::uint8_t> to) mutable {
            const std::size_t count = std::min(to.size(), rest.size());
            std::copy_n(rest.begin(), count, to.begin());
            rest = rest.subspan(count);
            return count;
        };
    UnpackedBytes unpacked(CompressionFormat::zstd, next,
                           std::min(most_unpacked(found.size()), kLargestMessage_bytes));
    const auto begin = unpacked.beginning(most);
    return {begin.begin(), begin.end()};
}

void BagFile::refuse(std::string_view why) const {
    constexpr std::size_t kMostLetters = 200;
    throw InputError(shown(file_) + " cannot be read as a bag of ROS 2 (" +
                     one_line(why, kMostLetters) + "): copy or record it again");
}

bool is_bag_file(const fs::path& file, std::string_view head) {
    return is_mcap(head) || is_database(file);
}

std::unique_ptr<BagFile> open_bag_file(const fs::path& file) {
    require_readable(file);
    return is_mcap(head_of(file)) ? open_mcap_bag(file) : open_sqlite_bag(file);
}

}  // namespace dibhr
