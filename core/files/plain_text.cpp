// Text and numbers as the program writes them.
#include "core/files/plain_text.hpp"

#include <unistd.h>

extern "C" {
#include <libavutil/base64.h>
}

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <limits>
#include <system_error>
#include <utility>

#include "core/files/terminal.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::string written(double value, std::chars_format format, int digits) {
    std::array<char, 512> text{};  // the largest double has 309 digits before the point
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
    return {text.data(), end.ptr};
}

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
    // U+0080 to U+009F are control characters; U+202A to U+202E and U+2066 to U+2069 change the
    // direction of the text around them.
    const unsigned last = byte_at(text, k + bytes - 1);
    const bool turns = first == 0xE2U && ((second == 0x80U && last >= 0xAAU && last <= 0xAEU) ||
                                          (second == 0x81U && last >= 0xA6U && last <= 0xA9U));
    const bool control = (first == 0xC2U && second < 0xA0U) || turns;
    return too_long || surrogate || beyond || control ? 0 : bytes;
}

bool is_control(unsigned byte) {
    return byte < 0x20U || byte == 0x7FU;
}

void print_line(std::string_view head, Paint paint, std::string_view sentence) {
    while (!sentence.empty() && sentence.back() == '\n') sentence.remove_suffix(1);
    std::cerr << painted(head, paint, STDERR_FILENO) << ' ' << one_line(sentence) << '\n';
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

std::string one_line(std::string_view text, std::size_t most) {
    const std::string clean = utf8_text(text);
    std::string result;
    std::size_t shortened = 0;  // bytes of the result's first letters, with room for two dots
    std::size_t letters = 0;
    for (std::size_t k = 0; k < clean.size(); ++letters) {
        if (letters + 2 == most) shortened = result.size();
        if (letters == most) return result.substr(0, shortened) + "..";
        const std::size_t bytes = letter_bytes(clean, k);
        result += is_control(byte_at(clean, k)) ? " " : clean.substr(k, bytes);
        k += bytes;
    }
    return result;
}

std::string in_quotes(std::string_view text, std::size_t longest) {
    std::string shown(text.substr(0, longest));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return is_control(c); }, '?');
    return "'" + shown + (text.size() > longest ? "...'" : "'");
}

bool is_decimal_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool is_of_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), is_decimal_digit);
}

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::vector<std::string> plain_words_of(std::string_view text) {
    std::vector<std::string> words(1);
    for (const char c : lower_case(std::string(text))) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

std::string escaped_text(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const unsigned byte = byte_at(text, k);
        const bool hidden =
            is_control(byte) || byte >= 0x80U || (text[k] == ' ' && k > 0 && text[k - 1] == ' ');
        if (text[k] == '\\') result += '\\';
        if (hidden)
            result += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
        else
            result += text[k];
    }
    return result;
}

std::string html_text(std::string_view text) {
    constexpr std::array<std::pair<char, std::string_view>, 5> kEntities{
        {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}};
    std::string result;
    for (const char c : utf8_text(text)) {
        const auto* const entity = std::find_if(kEntities.begin(), kEntities.end(),
                                                [c](const auto& each) { return each.first == c; });
        result += entity == kEntities.end() ? std::string_view(&c, 1) : entity->second;
    }
    return result;
}

std::string percent_encoded(std::string_view path) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/-_.";
    std::string encoded;
    for (std::size_t k = 0; k < path.size(); ++k) {
        if (kPlain.find(path[k]) != std::string_view::npos) {
            encoded += path[k];
        } else {
            encoded += '%';
            encoded += kDigits[byte_at(path, k) >> 4U];
            encoded += kDigits[byte_at(path, k) & 15U];
        }
    }
    return encoded;
}

std::string percent_decoded(std::string_view text) {
    constexpr int kSixteen = 16;
    std::string decoded;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char* const digits = text.data() + k + 1;
        unsigned char byte = 0;
        const bool coded = text[k] == '%' && k + 2 < text.size() &&
                           std::from_chars(digits, digits + 2, byte, kSixteen).ptr == digits + 2;
        decoded += coded ? static_cast<char>(byte) : text[k];
        if (coded) k += 2;
    }
    return decoded;
}

std::string listed(const std::vector<std::string>& words, std::string_view between) {
    std::string list;
    for (const std::string& word : words) list.append(list.empty() ? "" : between).append(word);
    return list;
}

bool is_bare_name(std::string_view text) {
    const auto fits = [](unsigned char c) {
        return c < 0x80 && (std::isalnum(c) != 0 || c == '-' || c == '_');
    };
    return !text.empty() && std::ranges::all_of(text, fits);
}

std::optional<double> number_of_text(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string base64_text(std::string_view bytes) {
    const auto size = static_cast<int>(bytes.size());
    std::string text(AV_BASE64_SIZE(bytes.size()), '\0');
    av_base64_encode(text.data(), static_cast<int>(text.size()),
                     reinterpret_cast<const std::uint8_t*>(bytes.data()), size);
    text.pop_back();  // the zero at its end
    return text;
}

std::string bytes_of_base64(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
    if (text.size() > std::size_t{std::numeric_limits<int>::max()}) return {};
    std::string bytes(AV_BASE64_DECODE_SIZE(text.size()), '\0');
    const int written = av_base64_decode(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                         text.c_str(), static_cast<int>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max(written, 0)));
    return bytes;
}

std::string number_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

std::string number_text(double value, int digits) {
    return written(value, std::chars_format::fixed, digits);
}

std::string clock_text(double seconds) {
    const long milliseconds = std::lround(std::max(0.0, seconds) * 1000.0);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%02ld:%02ld.%03ld", milliseconds / 60000,
                  milliseconds / 1000 % 60, milliseconds % 1000);
    return text.data();
}

std::string short_text(double value, int digits) {
    return written(value, std::chars_format::general, digits);
}

void append_number(std::string& text, double value) {
    std::array<char, 32> digits{};
    char* const last = digits.data() + digits.size();
    const auto written = std::to_chars(digits.data(), last, value, std::chars_format::general, 17);
    text.append(digits.data(), written.ptr);
}

void print_error_line(std::string_view message) {
    print_line("dibhr:", Paint::error, message);
}

void print_warning(std::string_view sentence) {
    if (!sentence.empty()) print_line("dibhr: warning:", Paint::warning, sentence);
}

}  // namespace dibhr
