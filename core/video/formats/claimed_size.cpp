// Looks up two numbers in headers.
#include "core/video/formats/claimed_size.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

namespace dibhr {

namespace {

/// Numbers anywhere in a picture; 0 beyond its end.
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
        std::int64_t number = 0;
        for (std::size_t k = 0; k < bytes; ++k)
            number = number * 256 + static_cast<unsigned char>(raw[little_ ? bytes - 1 - k : k]);
        return number;
    }

    void set_little(bool little) { little_ = little; }
    [[nodiscard]] std::istream& stream() { return in_; }

  private:
    std::istream& in_;
    bool little_{false};
};

ClaimedSize size_of_png(Header& header) {
    return {header.number(16, 4), header.number(20, 4)};
}

/// Rows below 0 are told from above.
ClaimedSize size_of_bmp(Header& header) {
    constexpr std::int64_t kOldest = 12;  ///< bytes of the first version's header
    header.set_little(true);
    if (header.number(14, 4) == kOldest) return {header.number(18, 2), header.number(20, 2)};
    const auto rows = static_cast<std::int32_t>(header.number(22, 4));
    return {header.number(18, 4), std::abs(std::int64_t{rows})};
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

/// P1 to P6 say columns and rows; P7 (PAM) says which is which.
ClaimedSize size_of_pnm(Header& header) {
    constexpr int kMostWords = 32;
    const bool has_names = header.text(0, 2) == "P7";
    std::istream& in = header.stream();
    if (!has_names) {
        const std::int64_t columns = number_of(word_of(in));
        return {columns, number_of(word_of(in))};
    }
    ClaimedSize size;
    for (int k = 0; k < kMostWords && in; ++k) {
        const std::string word = word_of(in);
        if (word == "WIDTH") size.columns = number_of(word_of(in));
        if (word == "HEIGHT") size.rows = number_of(word_of(in));
    }
    return size;
}

/// Of the first page.
ClaimedSize size_of_tiff(Header& header) {
    constexpr std::int64_t kColumns = 256;
    constexpr std::int64_t kRows = 257;
    constexpr std::int64_t kShort = 3;
    constexpr std::int64_t kMostEntries = 1000;
    header.set_little(header.text(0, 1) == "I");
    const std::int64_t page = header.number(4, 4);
    const std::int64_t entries = std::min(header.number(page, 2), kMostEntries);
    ClaimedSize size;
    for (std::int64_t k = 0; k < entries; ++k) {
        const std::int64_t at = page + 2 + 12 * k;
        const std::int64_t value =
            header.number(at + 8, header.number(at + 2, 2) == kShort ? 2 : 4);
        if (header.number(at, 2) == kColumns) size.columns = value;
        if (header.number(at, 2) == kRows) size.rows = value;
    }
    return size;
}

/// The next segment's; what stands between two of them is passed over, as decoders do. Nothing when
/// there is none near by.
std::optional<std::int64_t> jpeg_marker(Header& header, std::int64_t at) {
    constexpr std::int64_t kMostBetween = 1 << 14;
    for (const std::int64_t end = at + kMostBetween; at < end; ++at) {
        const std::int64_t kind = header.number(at + 1, 1);
        if (header.number(at, 1) == 0xff && kind != 0xff && kind != 0) return at;
    }
    return std::nullopt;
}

/// In the segment that begins the picture, behind those of what is said of it.
ClaimedSize size_of_jpeg(Header& header) {
    constexpr int kMostSegments = 1000;
    auto at = jpeg_marker(header, 2);
    for (int k = 0; k < kMostSegments && at; ++k) {
        const std::int64_t kind = header.number(*at + 1, 1);
        const bool begins_picture =
            kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
        if (begins_picture) return {header.number(*at + 7, 2), header.number(*at + 5, 2)};
        at = jpeg_marker(header, *at + 2 + header.number(*at + 2, 2));
    }
    return {};
}

struct Form {
    std::string_view begin;
    ClaimedSize (*size)(Header&);
};
using namespace std::string_view_literals;
constexpr std::array kForms{Form{"\x89PNG"sv, size_of_png}, Form{"BM"sv, size_of_bmp},
                            Form{"II*\0"sv, size_of_tiff}, Form{"MM\0*"sv, size_of_tiff},
                            Form{"\xff\xd8\xff"sv, size_of_jpeg}};

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
