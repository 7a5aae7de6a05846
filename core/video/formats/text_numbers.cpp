// Finds the matrix or the points in a text, and what is before, between and behind their numbers.
#include "core/video/formats/text_numbers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Numbers in text, after lines of other text.
struct NumbersInText {
    std::string before{};       ///< the other lines
    std::string_view titles{};  ///< the last one of them, within the text searched
    std::size_t lines_before{0};
    char between{' '};       ///< a comma, a semicolon or a blank
    bool has_commas{false};  ///< in the numbers, for points
    bool are_quoted{false};  ///< each in "
    bool are_rows{false};    ///< each line is a row of a picture
};

/// Whether the line has what numbers are written with, and nothing else.
bool is_of_numbers(std::string_view line) {
    return line.find_first_not_of("+-.eE,;\" \t\rnaifNAIF0123456789") == std::string_view::npos &&
           (line.find_first_of("0123456789") != std::string_view::npos ||
            line.find("nan") != std::string_view::npos ||
            line.find("NaN") != std::string_view::npos);
}

/// The first line of a text, which it loses.
std::string_view taken_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

std::optional<NumbersInText> find_numbers_in_text(std::string_view text) {
    constexpr std::size_t kMostLinesBefore = 40;
    NumbersInText found;
    std::array<std::string_view, 2> lines{};
    std::size_t taken = 0;
    while (!text.empty() && taken < lines.size() && found.lines_before <= kMostLinesBefore) {
        const std::string_view line = taken_line(text);
        if (is_of_numbers(line)) {
            lines[taken++] = line;
        } else if (taken > 0) {
            return std::nullopt;  // a table with words in it
        } else {
            found.before += line;
            found.titles = line;
            ++found.lines_before;
        }
    }
    if (taken == 0) return std::nullopt;
    const std::string_view first = lines[0];
    const auto digits = std::count_if(first.begin(), first.end(), is_decimal_digit);
    const auto others = std::count_if(first.begin(), first.end(), [](char c) {
        return std::string_view("+-.eE").find(c) != std::string_view::npos;
    });
    if (digits < others) return std::nullopt;
    const auto holds_any = [first](char c) { return first.find(c) != std::string_view::npos; };
    const bool is_comma_other = holds_any(';') || (holds_any('\t') && !holds_any('.'));
    found.has_commas = is_comma_other && holds_any(',');
    found.between = holds_any(';') ? ';' : holds_any(',') && !found.has_commas ? ',' : ' ';
    found.are_quoted = holds_any('"');
    found.are_rows =
        taken == lines.size() &&
        first.find_first_of(",; \t", first.find_first_not_of(" \t")) != std::string_view::npos;
    return found;
}

/// Whether numbers are heights, by the name of the file and the titles that microscopes write.
bool are_heights(const std::string& words) {
    constexpr std::string_view kHeightInJapanese = "\xe9\xab\x98\xe3\x81\x95";
    constexpr std::string_view kHeightInShiftJis = "\x8d\x82\x82\xb3";  // of Keyence
    constexpr std::array<std::string_view, 8> kWords{
        "height", "topograph",   "elevation",       "zscale",
        "hoehe",  "h\xc3\xb6he", kHeightInJapanese, kHeightInShiftJis};
    const std::string small = lower_case(words);
    return std::any_of(kWords.begin(), kWords.end(), [&small](std::string_view word) {
        return small.find(word) != std::string::npos;
    });
}

/// The column of z in a table with the titles x, y, z, with units or without; nothing: it is no
/// list of points.
std::optional<std::size_t> column_of_z(const NumbersInText& numbers) {
    std::string axes;  // the first letter of each title that is one letter, else '-'
    for (std::string_view left = numbers.titles; !left.empty();) {
        const std::size_t end = std::min(left.find_first_of(numbers.between), left.size());
        const std::vector<std::string> words = words_of_name(left.substr(0, end));
        if (!words.empty() || numbers.between != ' ')
            axes += words.empty() || words.front().size() != 1 ? '-' : words.front()[0];
        left.remove_prefix(std::min(end + 1, left.size()));
    }
    const auto at = axes.find("xyz");
    return at == std::string::npos ? std::nullopt : std::optional(at + 2);
}

/// The lines behind the numbers, which end them with a sign or in words.
std::size_t lines_behind(const fs::path& file) {
    constexpr std::size_t kEnd_bytes = 512;
    const std::string end = end_of(file, kEnd_bytes);
    std::string_view text = end;
    if (size_of(file) > kEnd_bytes) taken_line(text);  // a part of one
    std::size_t count = 0;
    while (!text.empty()) {
        const std::string_view line = taken_line(text);
        const auto first = line.find_first_not_of(" \t\r\x1a");
        if (is_of_numbers(line))
            count = 0;
        else if (first != std::string_view::npos && line[first] != '#')
            ++count;
    }
    return count;
}

std::uint64_t lines_of_numbers(const fs::path& file) {
    constexpr std::uint64_t kMost = kMostPixels;
    std::ifstream in(file, std::ios::binary);
    std::uint64_t count = 0;
    for (std::string line; count < kMost && std::getline(in, line);)
        if (is_of_numbers(line)) ++count;
    return count;
}

/// What numpy.genfromtxt reads them with, but for the columns; a cell that is no number is no data.
std::string arguments_of(const NumbersInText& numbers, std::size_t behind) {
    std::string line = "line";
    if (numbers.has_commas) line += ".replace(',', '.')";
    if (numbers.are_quoted) line += ".replace(chr(34), '')";
    const bool is_changed = line != "line";
    std::string text =
        is_changed ? "[" + line + " for line in open('{}', encoding='latin-1')]" : "'{}'";
    if (numbers.between != ' ') text += std::string(", delimiter='") + numbers.between + "'";
    if (numbers.lines_before > 0) text += ", skip_header=" + std::to_string(numbers.lines_before);
    if (behind > 0) text += ", skip_footer=" + std::to_string(behind);
    const bool may_have_words = numbers.lines_before > 0 || behind > 0;
    if (may_have_words && !is_changed) text += ", encoding='latin-1'";
    return text;
}

}  // namespace

bool begins_like_text(const fs::path& file) {
    constexpr std::size_t kLines_bytes = 512;
    const std::string head = beginning_of(file, kLines_bytes);
    if (head.starts_with("YUV4MPEG2 ")) return false;
    return std::all_of(head.begin(), head.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 32 || (byte >= '\t' && byte <= '\r') || byte == 27;
    });
}

TextAdvice advice_on_numbers_in_text(const fs::path& file) {
    constexpr std::size_t kInspectedText_bytes = 1 << 16;
    if (!begins_like_text(file)) return {};
    const std::string text = beginning_of(file, kInspectedText_bytes);
    const auto numbers = find_numbers_in_text(text);
    if (!numbers) return {};
    const std::string arguments = arguments_of(*numbers, lines_behind(file));
    const std::string save = "python3 -c \"import numpy; numpy.save('";
    if (const auto z = column_of_z(*numbers))
        return {
            " is a list of points in text: if they are in the order of the pixels, save their "
            "distances: " +
                save + "depth.npy', numpy.genfromtxt(" + arguments +
                ", usecols=" + std::to_string(*z) +
                ").reshape({sides}))\"; if not, open it in CloudCompare (package cloudcompare), "
                "choose Tools, Projection, Rasterize, save the heights as GeoTIFF (height.tif, or "
                "depth.tif where Z points away from the camera), and give that",
            lines_of_numbers(file)};
    const char* const what = numbers->between == ' '
                                 ? " holds numbers as text: if they are depth"
                                 : " is a table in text: if its cells are depth";
    return {std::string(what) + ", convert it: " + save +
            (are_heights(numbers->before + file.stem().string()) ? "height" : "depth") +
            ".npy', numpy.genfromtxt(" + arguments + ")" +
            (numbers->are_rows ? "" : ".reshape(ROWS, COLUMNS)") + ")\""};
}

}  // namespace dibhr
