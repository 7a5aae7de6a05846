// A path in a command that a user types.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dibhr {

/// The text as one word of a shell: in quotation marks where a shell would read it otherwise.
[[nodiscard]] inline std::string shell_word(const std::string& text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        return letter || (c >= '0' && c <= '9') ||
               std::string_view("/._-+").find(c) != std::string_view::npos;
    });
    if (plain && !text.empty()) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

}  // namespace dibhr
