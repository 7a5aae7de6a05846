// Finds, orders and times the pictures of a folder, and reads them one after the other.
#include "core/video/picture_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/video/media.hpp"
#include "core/video/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool is_picture(const fs::path& file) {
    std::error_code ignored;
    return named_picture(file) && !file.filename().string().starts_with('.') &&
           fs::is_regular_file(file, ignored);
}

NumberedPicture numbered(const fs::path& file) {
    const std::string name = file.stem().string();
    const auto last = std::find_if(name.rbegin(), name.rend(), is_digit).base();
    if (last == name.begin()) return {file, {}, false};
    auto first = std::find_if_not(std::make_reverse_iterator(last), name.rend(), is_digit).base();
    bool decimal = false;
    if (first - name.begin() >= 2 && first[-1] == '.' && is_digit(first[-2])) {
        decimal = true;
        first =
            std::find_if_not(std::make_reverse_iterator(first - 1), name.rend(), is_digit).base();
    }
    return {file, std::strtod(std::string(first, last).c_str(), nullptr), decimal};
}

/// Runs of digits by their value, everything else by its letters.
bool in_natural_order(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!is_digit(a[i]) || !is_digit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i;
            ++j;
            continue;
        }
        const auto run = [](const std::string& text, std::size_t& at) {
            while (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) ++at;
            const std::size_t begin = at;
            while (at < text.size() && is_digit(text[at])) ++at;
            return std::string_view(text).substr(begin, at - begin);
        };
        const std::string_view left = run(a, i);
        const std::string_view right = run(b, j);
        if (left.size() != right.size()) return left.size() < right.size();
        if (left != right) return left < right;
    }
    return a.size() - i < b.size() - j;
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

/// By the words in `name`, which is of the picture or of its folder.
PictureRow& row_for(PictureFolder& folder, const fs::path& name) {
    if (named_depth(name)) return folder.depth;
    return named_colour(name) ? folder.colour : folder.unnamed;
}

/// Every number once, and with or without a point throughout.
bool has_order(const PictureRow& row, bool decimal) {
    std::set<double> numbers;
    return std::all_of(row.begin(), row.end(), [&](const NumberedPicture& picture) {
        return picture.number && picture.decimal == decimal &&
               numbers.insert(*picture.number).second;
    });
}

void sort_by_number(PictureRow& row) {
    if (!has_order(row, false) && !has_order(row, true)) return;
    std::sort(row.begin(), row.end(), [](const NumberedPicture& a, const NumberedPicture& b) {
        return *a.number < *b.number;
    });
}

std::set<double> numbers_of(const PictureRow& row) {
    std::set<double> numbers;
    for (const NumberedPicture& picture : row) numbers.insert(*picture.number);
    return numbers;
}

}  // namespace

PictureFolder look_into(const fs::path& folder) {
    PictureFolder found;
    const std::vector<fs::path> entries = entries_of(folder);
    for (const fs::path& entry : entries) {
        if (is_picture(entry)) row_for(found, entry).push_back(numbered(entry));
    }
    const bool has_own = !found.colour.empty() || !found.depth.empty() || !found.unnamed.empty();
    for (const fs::path& entry : entries) {
        if (has_own || !is_folder(entry)) continue;
        PictureRow& row = row_for(found, entry);
        if (&row == &found.unnamed || !row.empty()) continue;
        for (const fs::path& file : entries_of(entry)) {
            if (is_picture(file)) row.push_back(numbered(file));
        }
    }
    sort_by_number(found.colour);
    sort_by_number(found.depth);
    sort_by_number(found.unnamed);
    return found;
}

std::vector<double> times_s(const PictureRow& row, const PictureRow& other, double frames_per_s) {
    std::vector<double> times;
    if (has_order(row, true) && has_order(other, true)) {
        for (const NumberedPicture& picture : row) times.push_back(*picture.number);
        return times;
    }
    if (has_order(row, false) && has_order(other, false)) {
        std::set<double> numbers = numbers_of(row);
        numbers.merge(numbers_of(other));
        for (const NumberedPicture& picture : row) {
            const auto rank = std::distance(numbers.begin(), numbers.find(*picture.number));
            times.push_back(static_cast<double>(rank) / frames_per_s);
        }
        return times;
    }
    for (std::size_t k = 0; k < row.size(); ++k)
        times.push_back(static_cast<double>(k) / frames_per_s);
    return times;
}

PictureSequence::PictureSequence(fs::path place, PictureRow row, std::vector<double> times,
                                 PictureRole role)
    : row_(std::move(row)), times_s_(std::move(times)), role_(role) {
    StillFile first(row_.front().file, role_);
    facts_ = first.facts();
    last_ = first.next()->picture;
    facts_.file = std::move(place);
    facts_.start_s = times_s_.front();
    for (double& time_s : times_s_) time_s -= facts_.start_s;
    const auto count = static_cast<std::int64_t>(row_.size());
    facts_.frames = count;
    facts_.still = count == 1;
    if (count == 1) return;
    const double interval_s = times_s_.back() / static_cast<double>(count - 1);
    facts_.frames_per_s = 1.0 / interval_s;
    facts_.duration_s = times_s_.back() + interval_s;
}

std::optional<TimedPicture> PictureSequence::next() {
    if (at_ == row_.size()) return std::nullopt;
    const std::size_t at = at_++;
    try {
        StillFile still(row_[at].file, role_);
        last_ = with_bits(still.next()->picture, still.facts().bits, facts_.bits);
    } catch (const InputError& error) {
        if (facts_.trouble.empty())
            facts_.trouble = std::string(error.what()) + "; until then the one before it is shown";
    }
    return TimedPicture{last_, times_s_[at], static_cast<std::int64_t>(at)};
}

void PictureSequence::seek(double time_s) {
    const auto later =
        std::upper_bound(times_s_.begin(), times_s_.end(), time_s + kTimeTolerance_s);
    at_ = later == times_s_.begin() ? 0 : static_cast<std::size_t>(later - times_s_.begin()) - 1;
}

}  // namespace dibhr
