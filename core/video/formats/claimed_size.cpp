// Reads the claimed size of a picture from its header.
#include "core/video/formats/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

namespace dibhr {

namespace {

/// Reads numbers anywhere in a picture; 0 beyond its end.
class Header {
  public:
    explicit Header(std::istream& in) : in_(in) {}

    [[nodiscard]] std::string text(std::int64_t at, std::size_t bytes) {
        std::string text(bytes, '\0');
        in_.clear();
        in_.seekg(at);
        in_.read(text.data(), static_cast<std::streamsize>(bytes));
        return in_ ? text : std::string(bytes, '\0');
    }

    [[nodiscard]] std::int64_t number(std::int64_t at, std::size_t bytes) {
        const std::string raw = text(at, bytes);
        std::uint64_t number = 0;
        for (std::size_t k = 0; k < bytes; ++k)
            number = number * 256 + static_cast<unsigned char>(raw[little_ ? bytes - 1 - k : k]);
        return static_cast<std::int64_t>(number);
    }

    void set_little(bool little) { little_ = little; }
    [[nodiscard]] std::istream& stream() { return in_; }

  private:
    std::istream& in_;
    bool little_{false};
};

ClaimedSize size_of_png(Header& header) {
    constexpr std::array<std::int64_t, 7> kChannels{1, 1, 3, 3, 4, 1, 4};  ///< as they are decoded
    const auto kind = std::min<std::size_t>(static_cast<std::size_t>(header.number(25, 1)), 6);
    const std::int64_t level_bytes = header.number(24, 1) > 8 ? 2 : 1;
    return {header.number(16, 4), header.number(20, 4), level_bytes * kChannels[kind]};
}

/// A negative number of rows means top-down order.
ClaimedSize size_of_bmp(Header& header) {
    constexpr std::int64_t kOldest = 12;  ///< bytes of the first version's header
    header.set_little(true);
    if (header.number(14, 4) == kOldest) return {header.number(18, 2), header.number(20, 2), 4};
    const auto rows = static_cast<std::int32_t>(header.number(22, 4));
    return {header.number(18, 4), std::abs(std::int64_t{rows}), 4};
}

/// The word after white space and comments.
std::string word_of(std::istream& in) {
    std::string word;
    while (in >> word && word.front() == '#') std::getline(in, word);
    return word;
}

std::int64_t number_of(const std::string& word) {
    return std::strtoll(word.c_str(), nullptr, 10);
}

/// P1 to P6 have columns and rows, then P2, P3, P5 and P6 the highest level; P7 (PAM) names each
/// number.
ClaimedSize size_of_pnm(Header& header) {
    constexpr int kMostWords = 32;
    constexpr std::int64_t kMostChannels = 4;
    const std::string kind = header.text(0, 2);
    std::istream& in = header.stream();
    ClaimedSize size;
    std::int64_t highest = 0;
    if (kind != "P7") {
        size.columns = number_of(word_of(in));
        size.rows = number_of(word_of(in));
        if (kind != "P1" && kind != "P4") highest = number_of(word_of(in));
    }
    for (int k = 0; kind == "P7" && k < kMostWords && in; ++k) {
        const std::string word = word_of(in);
        if (word == "WIDTH") size.columns = number_of(word_of(in));
        if (word == "HEIGHT") size.rows = number_of(word_of(in));
        if (word == "MAXVAL") highest = number_of(word_of(in));
    }
    const bool has_colours = kind == "P3" || kind == "P6";
    const std::int64_t channels = kind == "P7" ? kMostChannels : has_colours ? 3 : 1;
    size.pixel_bytes = channels * (highest > 255 ? 2 : 1);
    return size;
}

/// The directory of a page of a TIFF file, with 32-bit offsets, or 64-bit ones (BigTIFF).
struct TiffPage {
    std::int64_t at{0};
    std::int64_t entries{0};
    std::int64_t entry_bytes{12};
    std::int64_t value_at{8};
};

TiffPage first_page(Header& header) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 60;
    constexpr std::int64_t kMostEntries = 1000;
    const bool big = header.number(2, 2) == 43;
    const std::int64_t page =
        std::clamp<std::int64_t>(big ? header.number(8, 8) : header.number(4, 4), 0, kFarthest);
    const std::int64_t entries = header.number(page, big ? 8 : 2);
    return {page + (big ? 8 : 2), std::clamp<std::int64_t>(entries, 0, kMostEntries), big ? 20 : 12,
            big ? 12 : 8};
}

/// The size of the first page, or of a tile, which may be larger.
ClaimedSize size_of_tiff(Header& header) {
    constexpr std::int64_t kShort = 3;
    header.set_little(header.text(0, 1) == "I");
    const TiffPage page = first_page(header);
    ClaimedSize size;
    std::int64_t bits = 1;
    std::int64_t samples = 1;
    for (std::int64_t k = 0; k < page.entries; ++k) {
        const std::int64_t at = page.at + page.entry_bytes * k;
        const std::int64_t tag = header.number(at, 2);
        const std::int64_t value_at = at + page.value_at;
        const bool is_short = header.number(at + 2, 2) == kShort;
        const std::int64_t value = header.number(value_at, is_short ? 2 : 4);
        if (tag == 256 || tag == 322) size.columns = std::max(size.columns, value);
        if (tag == 257 || tag == 323) size.rows = std::max(size.rows, value);
        if (tag == 277) samples = value;
        if (tag != 258) continue;
        const bool elsewhere = header.number(at + 4, 4) > (page.entry_bytes - page.value_at) / 2;
        bits = elsewhere ? header.number(header.number(value_at, 4), 2) : value;
    }
    constexpr std::int64_t kMost = 1 << 16;
    size.pixel_bytes =
        std::max<std::int64_t>(std::min(samples, kMost) * std::min(bits, kMost) / 8, 1);
    return size;
}

/// The position of the next marker; skips bytes between segments, as decoders do. Nothing when
/// there is none near by.
std::optional<std::int64_t> jpeg_marker(Header& header, std::int64_t at) {
    constexpr std::int64_t kMostBetween = 1 << 14;
    for (const std::int64_t end = at + kMostBetween; at < end; ++at) {
        const std::int64_t kind = header.number(at + 1, 1);
        if (header.number(at, 1) == 0xff && kind != 0xff && kind != 0) return at;
    }
    return std::nullopt;
}

/// The size in the start-of-frame segment, which follows the metadata segments.
ClaimedSize size_of_jpeg(Header& header) {
    constexpr int kMostSegments = 1000;
    auto at = jpeg_marker(header, 2);
    for (int k = 0; k < kMostSegments && at; ++k) {
        const std::int64_t kind = header.number(*at + 1, 1);
        const bool begins_picture =
            kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
        if (begins_picture) return {header.number(*at + 7, 2), header.number(*at + 5, 2), 4};
        at = jpeg_marker(header, *at + 2 + header.number(*at + 2, 2));
    }
    return {};
}

/// The size of the canvas, or of the only picture, lossy or lossless.
ClaimedSize size_of_webp(Header& header) {
    constexpr std::int64_t kMostOfSide = 0x3fff;
    header.set_little(true);
    const std::string kind = header.text(8, 8);
    if (kind == "WEBPVP8X") return {header.number(24, 3) + 1, header.number(27, 3) + 1, 4};
    if (kind == "WEBPVP8 ")
        return {header.number(26, 2) & kMostOfSide, header.number(28, 2) & kMostOfSide, 4};
    if (kind != "WEBPVP8L") return {};
    const std::int64_t sides = header.number(21, 4);
    return {(sides & kMostOfSide) + 1, (sides >> 14 & kMostOfSide) + 1, 4};
}

struct Form {
    std::string_view begin;
    ClaimedSize (*size)(Header&);
};
using namespace std::string_view_literals;
constexpr std::array kForms{Form{"\x89PNG"sv, size_of_png}, Form{"BM"sv, size_of_bmp},
                            Form{"II*\0"sv, size_of_tiff},  Form{"MM\0*"sv, size_of_tiff},
                            Form{"II+\0"sv, size_of_tiff},  Form{"MM\0+"sv, size_of_tiff},
                            Form{"RIFF"sv, size_of_webp},   Form{"\xff\xd8\xff"sv, size_of_jpeg}};

}  // namespace

std::optional<ClaimedSize> claimed_size(std::istream& picture) {
    Header header(picture);
    ClaimedSize size;
    for (const Form& form : kForms) {
        if (header.text(0, form.begin.size()) == form.begin) size = form.size(header);
    }
    const std::string begin = header.text(0, 2);
    if (begin[0] == 'P' && begin[1] >= '1' && begin[1] <= '7') size = size_of_pnm(header);
    return size.columns > 0 && size.rows > 0 ? std::optional(size) : std::nullopt;
}

}  // namespace dibhr
