// Reads WebVTT line by line.
#include "core/video/guide/captions.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"
#include "core/video/sources/beside_recording.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kArrow = "-->";
constexpr std::size_t kMostCaptionLetters = 400;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::optional<int> number_in(std::string_view digits) {
    int number = 0;
    const auto [end, failed] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = failed == std::errc{} && end == digits.data() + digits.size();
    return whole && number >= 0 ? std::optional(number) : std::nullopt;
}

/// "00:01:02.500" or "01:02.500" [s].
std::optional<double> time_in(std::string_view text) {
    const std::size_t point = text.rfind('.');
    if (point == std::string_view::npos || text.size() != point + 4) return std::nullopt;
    const auto thousandths = number_in(text.substr(point + 1));
    if (!thousandths) return std::nullopt;
    double seconds = 0.0;
    std::string_view rest = text.substr(0, point);
    int parts = 0;
    while (true) {
        const std::size_t colon = rest.find(':');
        const auto part = number_in(rest.substr(0, colon));
        if (!part || ++parts > 3) return std::nullopt;
        seconds = 60.0 * seconds + *part;
        if (colon == std::string_view::npos) break;
        rest.remove_prefix(colon + 1);
    }
    if (parts < 2) return std::nullopt;
    return seconds + 0.001 * *thousandths;
}

/// "00:01.000 --> 00:04.000 line:0": a caption without its text; nothing: another line.
std::optional<Caption> times_in(std::string_view line) {
    const std::size_t arrow = line.find(kArrow);
    if (arrow == std::string_view::npos) return std::nullopt;
    const std::string_view after = trimmed(line.substr(arrow + kArrow.size()));
    const auto from_s = time_in(trimmed(line.substr(0, arrow)));
    const auto to_s = time_in(after.substr(0, after.find_first_of(" \t")));
    if (!from_s || !to_s) return std::nullopt;
    return Caption{*from_s, *to_s, {}};
}

/// Without <tags>, and with the five escapes as their signs.
std::string plain_line(std::string_view line) {
    std::string text;
    bool in_tag = false;
    for (const char c : line) {
        if (c == '<') in_tag = true;
        if (!in_tag) text += c;
        if (c == '>') in_tag = false;
    }
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kEscapes{
        {{"&lt;", "<"}, {"&gt;", ">"}, {"&nbsp;", " "}, {"&amp;", "&"}}};
    for (const auto& [escape, sign] : kEscapes)
        for (std::size_t at = text.find(escape); at != std::string::npos;
             at = text.find(escape, at + sign.size()))
            text.replace(at, escape.size(), sign);
    return one_line(text, kMostCaptionLetters);
}

/// The lines of a text; carriage returns end none.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + 1);
    }
    return lines;
}

}  // namespace

std::string Captions::at(double media_s) const {
    std::string text;
    for (const Caption& caption : all) {
        if (caption.from_s > media_s) break;
        if (media_s < caption.to_s) text += (text.empty() ? "" : "\n") + caption.text;
    }
    return text;
}

Captions captions_in(std::string_view text, const std::string& name) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    if (!text.starts_with("WEBVTT"))
        throw InputError(name + ": does not begin with WEBVTT; save the captions in that form");
    Captions captions;
    std::optional<Caption> open;
    const auto close = [&] {
        if (open && open->to_s > open->from_s && !open->text.empty())
            captions.all.push_back(std::move(*open));
        open.reset();
    };
    for (const std::string_view line : lines_of(text)) {
        if (trimmed(line).empty()) {
            close();
        } else if (open) {
            const std::string plain = plain_line(line);
            if (!plain.empty()) open->text += (open->text.empty() ? "" : "\n") + plain;
        } else {
            open = times_in(line);
        }
    }
    close();
    std::stable_sort(captions.all.begin(), captions.all.end(),
                     [](const Caption& a, const Caption& b) { return a.from_s < b.from_s; });
    if (captions.all.empty())
        throw InputError(name + ": holds no caption; each needs a line like 00:01.000 " +
                         std::string(kArrow) + " 00:04.000 and a text below it");
    return captions;
}

std::shared_ptr<const Captions> read_captions(const std::filesystem::path& depth) {
    if (depth.empty()) return nullptr;
    const std::filesystem::path file = beside_recording(depth, ".vtt");
    if (!is_file(file)) return nullptr;
    const auto text = small_text_in(file);
    if (!text)
        throw InputError(shown(file) +
                         ": cannot be read as text of up to 1 MB; make it readable or smaller");
    return std::make_shared<const Captions>(captions_in(*text, shown(file)));
}

}  // namespace dibhr
