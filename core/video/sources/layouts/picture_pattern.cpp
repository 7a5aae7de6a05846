// Matches names with patterns.
#include "core/video/sources/layouts/picture_pattern.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/layouts/picture_folder.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// The fixed text before and after a number.
struct NumberPattern {
    std::string before{};
    std::string after{};
    std::size_t digits{1};  ///< at least
};

/// The first number in printf's form, with its least number of digits: %d, %4d, %04d.
std::optional<NumberPattern> number_pattern(const std::string& name) {
    for (auto at = name.find('%'); at != std::string::npos; at = name.find('%', at + 1)) {
        const std::size_t first = name.compare(at, 2, "%0") == 0 ? at + 2 : at + 1;
        std::size_t end = first;
        while (end < std::min(name.size(), first + 2) && is_decimal_digit(name[end])) ++end;
        if (name.compare(end, 1, "d") != 0) continue;
        const int digits = std::atoi(name.substr(first, end - first).c_str());
        return NumberPattern{name.substr(0, at), name.substr(end + 1),
                             static_cast<std::size_t>(std::max(1, digits))};
    }
    return std::nullopt;
}

std::optional<double> number_of(const std::string& name, const NumberPattern& pattern) {
    const bool fits = name.starts_with(pattern.before) && name.ends_with(pattern.after) &&
                      name.size() >= pattern.before.size() + pattern.after.size() + pattern.digits;
    if (!fits) return std::nullopt;
    const std::string digits = name.substr(
        pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
    if (!is_of_digits(digits)) return std::nullopt;
    return number_of_text(digits);
}

/// Whether the name matches: a star stands for any text, all other characters for themselves.
bool fits_stars(std::string_view name, std::string_view pattern) {
    std::size_t at = 0;
    std::size_t star = std::string_view::npos;  // the last star; its text ends at `end`
    std::size_t end = 0;
    std::size_t k = 0;
    while (k < name.size()) {
        if (at < pattern.size() && pattern[at] == '*') {
            star = at++;
            end = k;
        } else if (at < pattern.size() && pattern[at] == name[k]) {
            ++at;
            ++k;
        } else if (star != std::string_view::npos) {
            at = star + 1;
            k = ++end;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

}  // namespace

bool fits_number_pattern(const fs::path& file, const std::string& pattern) {
    const auto numbers = number_pattern(pattern);
    return numbers && number_of(file.filename().string(), *numbers);
}

bool is_picture_pattern(const fs::path& place) {
    const std::string name = place.filename().string();
    std::error_code failed;
    return (name.find('*') != std::string::npos || number_pattern(name)) &&
           !fs::exists(place, failed);
}

PictureSet pictures_of_pattern(const fs::path& pattern) {
    const std::string wanted = pattern.filename().string();
    const auto numbers = number_pattern(wanted);
    const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
    PictureSet found;
    for (const fs::path& file : entries_of(folder)) {
        if (!is_picture(file)) continue;
        const std::string name = file.filename().string();
        if (!numbers) {
            if (fits_stars(name, wanted)) found.unnamed.push_back(numbered(file));
        } else if (const auto number = number_of(name, *numbers)) {
            found.unnamed.push_back({file, number, false});
        }
    }
    if (found.unnamed.empty())
        throw InputError(shown(pattern) +
                         " is a pattern that no picture's name matches: check the folder and the "
                         "letters around the number");
    sort_by_number(found.unnamed);
    return found;
}

}  // namespace dibhr
