// Placeholders of a pattern and what they stand for.
#include "app/settings/name_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace dibhr {

namespace {

std::string padded(long long number, int digits) {
    std::array<char, 24> text{};
    std::snprintf(text.data(), text.size(), "%0*lld", digits, number);
    return text.data();
}

/// What strftime() makes of a letter after "%"; empty: the letter is no placeholder.
std::string date_part(char letter, const std::tm& now) {
    if (std::string_view("YmdHMS%").find(letter) == std::string_view::npos) return {};
    const char format[]{'%', letter, '\0'};
    std::array<char, 24> text{};
    std::strftime(text.data(), text.size(), format, &now);
    return text.data();
}

/// "00m04.631s": in the order of time also when sorted by name.
std::string time_part(double media_s) {
    constexpr double kLongest_s = 1e9;
    const long long ms = std::llround(1000.0 * std::clamp(media_s, 0.0, kLongest_s));
    return padded(ms / 60000, 2) + "m" + padded(ms / 1000 % 60, 2) + "." + padded(ms % 1000, 3) +
           "s";
}

/// Replaces '/', which would name a folder.
std::string without_separators(std::string text) {
    std::replace(text.begin(), text.end(), '/', '-');
    return text;
}

constexpr std::string_view kFile = "{file}";
constexpr std::string_view kTime = "{time}";
constexpr std::string_view kFrame = "{frame}";

/// A part of the pattern, a placeholder or one character, and its text; empty text: not a known
/// placeholder, though it looks like one.
struct Part {
    std::size_t length{1};
    std::string text{};
};

Part part_at(std::string_view rest, const NameFacts& facts) {
    if (rest[0] == '%') return {2, rest.size() > 1 ? date_part(rest[1], facts.now) : ""};
    if (rest[0] != '{') return {1, std::string(1, rest[0])};
    if (rest.starts_with(kFile)) return {kFile.size(), without_separators(facts.file)};
    if (rest.starts_with(kTime)) return {kTime.size(), time_part(facts.media_s)};
    if (rest.starts_with(kFrame)) return {kFrame.size(), padded(facts.frame, 6)};
    return {};
}

}  // namespace

std::string problem_of(const NamePattern& pattern) {
    const std::string& text = pattern.text;
    const bool one_line = std::ranges::none_of(text, [](unsigned char c) { return c < 0x20; });
    if (text.empty() || text.back() == '/' || !one_line) return "names no file";
    const NameFacts any{.file = "file"};
    std::string_view rest = text;
    while (!rest.empty()) {
        const Part part = part_at(rest, any);
        if (part.text.empty())
            return "has other placeholders than %Y %m %d %H %M %S %% {file} {time} {frame}";
        rest.remove_prefix(part.length);
    }
    return {};
}

std::string name_from(const NamePattern& pattern, const NameFacts& facts) {
    std::string name;
    for (std::string_view rest = pattern.text; !rest.empty();) {
        const Part part = part_at(rest, facts);
        name += part.text;
        rest.remove_prefix(std::min(part.length, rest.size()));
    }
    return name;
}

}  // namespace dibhr
