// Text that people or files gave, made safe to show.
#include "core/files/plain_text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dibhr {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

unsigned byte_at(std::string_view text, std::size_t k) {
    return static_cast<unsigned char>(text[k]);
}

/// How many bytes the letter at `k` takes; 0 when there is none. RFC 3629, section 4.
std::size_t letter_bytes(std::string_view text, std::size_t k) {
    const unsigned first = byte_at(text, k);
    if (first < 0x80U) return 1;
    const std::size_t bytes = first >= 0xC2U && first <= 0xDFU   ? 2
                              : first >= 0xE0U && first <= 0xEFU ? 3
                              : first >= 0xF0U && first <= 0xF4U ? 4
                                                                 : 0;
    if (bytes == 0 || k + bytes > text.size()) return 0;
    for (std::size_t n = 1; n < bytes; ++n) {
        if ((byte_at(text, k + n) & 0xC0U) != 0x80U) return 0;
    }
    const unsigned second = byte_at(text, k + 1);
    const bool too_long = (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool surrogate = first == 0xEDU && second > 0x9FU;
    const bool beyond = first == 0xF4U && second > 0x8FU;
    // U+0080 to U+009F are control characters.
    const bool control = first == 0xC2U && second < 0xA0U;
    return too_long || surrogate || beyond || control ? 0 : bytes;
}

bool is_control(unsigned byte) {
    return byte < 0x20U || byte == 0x7FU;
}

}  // namespace

std::string utf8_text(std::string_view text) {
    std::string result;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t bytes = letter_bytes(text, k);
        const bool kept =
            bytes > 0 && (!is_control(byte_at(text, k)) || text[k] == '\n' || text[k] == '\t');
        result += kept ? text.substr(k, bytes) : kReplacement;
        k += bytes > 0 ? bytes : 1;
    }
    return result;
}

std::string ascii_text(std::string_view text, std::size_t most) {
    std::string result;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t bytes = letter_bytes(text, k);
        const bool plain = bytes == 1 && !is_control(byte_at(text, k));
        result += plain ? text[k] : (text[k] == '\n' || text[k] == '\t') ? ' ' : '?';
        k += bytes > 0 ? bytes : 1;
    }
    return result.size() > most ? result.substr(0, most - 2) + ".." : result;
}

std::string html_text(std::string_view text) {
    std::string result;
    for (const char c : utf8_text(text)) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string base64_text(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const std::size_t there = std::min<std::size_t>(3, bytes.size() - k);
        std::uint32_t three = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            three = three << 8U | (n < there ? byte_at(bytes, k + n) : 0U);
        }
        for (std::size_t n = 0; n < 4; ++n) {
            text += n <= there ? kDigits[three >> (18U - 6U * n) & 63U] : '=';
        }
    }
    return text;
}

}  // namespace dibhr
