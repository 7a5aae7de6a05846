// Matches names with patterns.
#include "core/video/picture_pattern.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/video/media.hpp"
#include "core/video/picture_folder.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

const std::regex& printf_number() {
    static const std::regex number("%0?([0-9]{0,2})d");
    return number;
}

/// The letters as they are, before and after a number.
struct NumberPattern {
    std::string before{};
    std::string after{};
    std::size_t digits{1};  ///< at least
};

std::optional<NumberPattern> number_pattern(const std::string& name) {
    std::smatch found;
    if (!std::regex_search(name, found, printf_number())) return std::nullopt;
    NumberPattern pattern{found.prefix(), found.suffix(), 1};
    if (found[1].length() > 0)
        pattern.digits = static_cast<std::size_t>(std::max(1, std::atoi(found[1].str().c_str())));
    return pattern;
}

std::optional<double> number_of(const std::string& name, const NumberPattern& pattern) {
    const bool fits = name.starts_with(pattern.before) && name.ends_with(pattern.after) &&
                      name.size() >= pattern.before.size() + pattern.after.size() + pattern.digits;
    if (!fits) return std::nullopt;
    const std::string digits = name.substr(
        pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
    const bool is_number = std::all_of(digits.begin(), digits.end(),
                                       [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_number) return std::nullopt;
    return std::strtod(digits.c_str(), nullptr);
}

/// Stars stand for any letters: what is between them follows in this order.
bool fits_stars(std::string_view name, std::string_view pattern) {
    std::size_t at = 0;
    std::size_t star = std::string_view::npos;  // the last one, and what it stands for ends here
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
