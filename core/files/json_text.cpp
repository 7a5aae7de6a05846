// JSON, written by hand.
#include "core/files/json_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace dibhr {

std::string json_number(double value) {
    if (!std::isfinite(value)) return "null";
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string json_quoted(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20) {
            result += "\\u00";
            result += kDigits[byte >> 4U];
            result += kDigits[byte & 15U];
            continue;
        }
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

JsonObject& JsonObject::add(std::string_view name, const std::string& json) {
    text_ += (text_.empty() ? "" : ", ") + json_quoted(name) + ": " + json;
    return *this;
}

}  // namespace dibhr
