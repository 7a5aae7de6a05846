// Splits output into lines, and finds two numbers in them.
#include "core/estimate/printed_progress.hpp"

#include <algorithm>
#include <string_view>

#include "core/files/plain_text.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kLongestLine = 4096;  ///< longer lines are split

/// The whole number at `at`; moves `at` behind it. Nothing: no number, or one too large for a count
/// of frames.
std::optional<std::size_t> number_at(std::string_view line, std::size_t& at) {
    constexpr std::size_t kMostDigits = 9;
    const std::size_t begin = at;
    std::size_t number = 0;
    while (at < line.size() && is_decimal_digit(line[at]))
        number = 10 * number + static_cast<std::size_t>(line[at++] - '0');
    if (at == begin || at - begin > kMostDigits) return std::nullopt;
    return number;
}

/// The length of "/" or " of " between two counts; 0: neither.
std::size_t between_counts(std::string_view rest) {
    for (const std::string_view word : {"/", " / ", " of "})
        if (rest.starts_with(word)) return word.size();
    return 0;
}

}  // namespace

void PrintedProgress::take(const std::string& text) {
    for (const char c : text) {
        const bool ends = c == '\n' || c == '\r';
        if (ends || line_.size() == kLongestLine) {
            note();
            line_.clear();
        }
        if (!ends) line_ += c;
    }
    note();  // a bar and the last line may have no end yet
}

void PrintedProgress::note() {
    const std::string line = one_line(line_);
    if (line.find_first_not_of(' ') == std::string::npos) return;
    last_ = line;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (!is_decimal_digit(line[at])) continue;
        const auto done = number_at(line, at);
        const std::size_t length = between_counts(std::string_view(line).substr(at));
        if (!done || length == 0) continue;
        at += length;
        const auto of = number_at(line, at);
        if (!of || *of < *done) continue;
        done_ = *done;
        of_ = *of;
    }
}

std::optional<std::size_t> PrintedProgress::done_of(std::size_t all) const {
    const std::size_t off = std::max(of_, all) - std::min(of_, all);
    if (of_ < 2 || off > 1) return std::nullopt;
    return std::min(done_, all);
}

}  // namespace dibhr
