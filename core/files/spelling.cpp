// Suggests a name for a mistyped one.
#include "core/files/spelling.hpp"

#include <algorithm>
#include <cstddef>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// The optimal string alignment distance (Damerau 1964).
std::size_t edits_between(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> edits(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
        }
    }
    return edits[a.size()][b.size()];
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t kLongest = 64;  // no name is
    if (word.size() > kLongest) return {};
    std::string nearest;
    std::size_t fewest = word.size() / 3 + 1;
    for (const std::string& name : names) {
        const std::size_t edits = edits_between(word, name);
        if (edits >= fewest) continue;
        fewest = edits;
        nearest = name;
    }
    return nearest.empty() ? nearest : "; did you mean " + nearest + "?";
}

std::string none_of(const std::string& word, const std::vector<std::string>& names) {
    return "is none of " + listed(names) + did_you_mean(word, names);
}

}  // namespace dibhr
