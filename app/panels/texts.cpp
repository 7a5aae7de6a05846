// Texts of the panels.
#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <string>
#include <utility>

#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

std::string capitalised(std::string line) {
    if (!line.empty()) {
        line[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
    }
    return line;
}

std::string display_name(std::string name) {
    std::replace(name.begin(), name.end(), '-', ' ');
    return capitalised(std::move(name));
}

std::string formatted(const char* format, ...) {
    char text[512];
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
}

std::string decimal(double value, int digits) {
    std::string text = number_text(value, digits);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string date_text(const std::string& utc) {
    constexpr std::size_t kDate = 10, kMinutes = 16, kWhole = 20;
    if (utc.size() != kWhole || utc[kDate] != 'T' || utc.back() != 'Z') return utc;
    return utc.substr(0, kDate) + " " + utc.substr(kDate + 1, kMinutes - kDate - 1) + " UTC";
}

}  // namespace dibhr
