// Reading and quoting text that people wrote.
#include "core/files/csv_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

std::string text_of_file(const std::filesystem::path& file, const std::string& wanted) {
    const auto refuse = [&](const std::string& what) {
        throw InputError(file.string() + ": " + what + "; " + wanted);
    };
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) refuse("is a folder");
    if (std::filesystem::is_character_file(file, ignored)) refuse("is a device");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse(std::string("cannot be opened (") + std::strerror(errno) + ")");
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) refuse("cannot be read");
    return text;
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text;
}

std::string_view trimmed(std::string_view cell) {
    constexpr std::string_view kAround = " \t\r\"";
    const auto first = cell.find_first_not_of(kAround);
    if (first == std::string_view::npos) return {};
    return cell.substr(first, cell.find_last_not_of(kAround) - first + 1);
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string result = "'" + std::string(text.substr(0, kLongest));
    std::replace_if(
        result.begin(), result.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace dibhr
