// Names of files and folders.
#include "core/files/names.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Whether a new word begins between the two characters.
bool is_between_words(char before, char after) {
    const auto is = [](int (*kind)(int), char c) {
        return kind(static_cast<unsigned char>(c)) != 0;
    };
    return is_decimal_digit(before) != is_decimal_digit(after) ||
           (is(std::islower, before) && is(std::isupper, after));
}

}  // namespace

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

std::vector<std::string> words_of_name(std::string_view name) {
    std::vector<std::string> words(1);
    for (std::size_t k = 0; k < name.size(); ++k) {
        const auto byte = static_cast<unsigned char>(name[k]);
        const bool counts = byte >= 0x80 || std::isalnum(byte) != 0;
        if (k > 0 && is_between_words(name[k - 1], name[k])) words.emplace_back();
        if (counts)
            words.back().push_back(name[k]);
        else
            words.emplace_back();
    }
    std::erase(words, "");
    std::transform(words.begin(), words.end(), words.begin(), lower_case);
    return words;
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
