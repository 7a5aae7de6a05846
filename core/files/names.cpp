// Names of files and folders.
#include "core/files/names.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

std::string shown(const fs::path& file) {
    return in_quotes(file.string(), std::string::npos);
}

bool is_file(const fs::path& place) {
    std::error_code ignored;
    return fs::is_regular_file(place, ignored);
}

bool is_folder(const fs::path& place) {
    std::error_code ignored;
    return fs::is_directory(place, ignored);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        entries.push_back(entry->path());
    }
    if (failed)
        throw InputError(shown(folder) + " cannot be read (" + failed.message() +
                         "): check the permissions of the folder");
    std::sort(entries.begin(), entries.end(), [](const fs::path& a, const fs::path& b) {
        return in_natural_order(a.filename().string(), b.filename().string());
    });
    return entries;
}

bool in_natural_order(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!is_decimal_digit(a[i]) || !is_decimal_digit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i;
            ++j;
            continue;
        }
        const auto run = [](const std::string& text, std::size_t& at) {
            while (at + 1 < text.size() && text[at] == '0' && is_decimal_digit(text[at + 1])) ++at;
            const std::size_t begin = at;
            while (at < text.size() && is_decimal_digit(text[at])) ++at;
            return std::string_view(text).substr(begin, at - begin);
        };
        const std::string_view left = run(a, i);
        const std::string_view right = run(b, j);
        if (left.size() != right.size()) return left.size() < right.size();
        if (left != right) return left < right;
    }
    return a.size() - i < b.size() - j;
}

}  // namespace dibhr
