// Finds, orders and times the pictures of a folder, and reads them one after the other.
#include "core/video/sources/picture_folder.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
    return named_picture(file) && !file.filename().string().starts_with('.') && is_file(file);
}

NumberedPicture numbered(const fs::path& file) {
    const std::string name = file.stem().string();
    const auto last = std::find_if(name.rbegin(), name.rend(), is_decimal_digit).base();
    if (last == name.begin()) return {file, {}, false};
    auto first =
        std::find_if_not(std::make_reverse_iterator(last), name.rend(), is_decimal_digit).base();
    bool decimal = false;
    if (first - name.begin() >= 2 && first[-1] == '.' && is_decimal_digit(first[-2])) {
        decimal = true;
        first =
            std::find_if_not(std::make_reverse_iterator(first - 1), name.rend(), is_decimal_digit)
                .base();
    }
    return {file, number_of_text(std::string(first, last)).value_or(0.0), decimal};
}

namespace {

constexpr double kSameTime_s = 0.02;  ///< associate.py's own limit
constexpr double kLongestRow_s = 1e6;

/// The row for a picture, by the words in `name`, the name of the picture or of its folder.
PictureRow& row_for(PictureSet& set, const fs::path& name) {
    if (named_depth(name)) return set.depth;
    return named_colour(name) ? set.colour : set.unnamed;
}

std::set<double> numbers_of(const PictureRow& row) {
    std::set<double> numbers;
    for (const NumberedPicture& picture : row) numbers.insert(*picture.number);
    return numbers;
}

void append_pictures_of(const fs::path& folder, PictureRow& row) {
    for (const fs::path& file : entries_of(folder)) {
        if (is_picture(file)) row.push_back(numbered(file));
    }
}

/// Beside depth, unnamed pictures count as colour where a word allows it, else where their names
/// are those of depth pictures without the word for depth.
void accept_as_colour(PictureSet& set) {
    if (set.depth.empty() || !set.colour.empty()) return;
    std::set<std::string> subjects;
    for (const NumberedPicture& picture : set.depth) subjects.insert(subject_of(picture.file));
    const auto allowed = [](const NumberedPicture& picture) {
        return may_name_colour(picture.file.filename());
    };
    const auto belongs = [&subjects](const NumberedPicture& picture) {
        return subjects.contains(subject_of(picture.file));
    };
    std::copy_if(set.unnamed.begin(), set.unnamed.end(), std::back_inserter(set.colour), allowed);
    if (!set.colour.empty()) return;
    std::copy_if(set.unnamed.begin(), set.unnamed.end(), std::back_inserter(set.colour), belongs);
}

/// Adds the pictures of subfolders named depth or colour; of several the first.
void find_pictures_in_folders(const std::vector<fs::path>& entries, PictureSet& set) {
    for (const fs::path& entry : entries) {
        if (!is_folder(entry)) continue;
        PictureRow& row = row_for(set, entry.filename());
        if (&row != &set.unnamed && row.empty()) append_pictures_of(entry, row);
    }
    for (const fs::path& entry : entries) {
        if (set.depth.empty() || !set.colour.empty()) return;
        if (may_name_colour(entry) && is_folder(entry)) append_pictures_of(entry, set.colour);
    }
}

}  // namespace

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

PictureSet find_pictures_in(const fs::path& folder) {
    PictureSet found;
    const std::vector<fs::path> entries = entries_of(folder);
    for (const fs::path& entry : entries) {
        if (is_picture(entry)) row_for(found, entry).push_back(numbered(entry));
    }
    const bool has_own = !found.colour.empty() || !found.depth.empty() || !found.unnamed.empty();
    if (has_own)
        accept_as_colour(found);
    else
        find_pictures_in_folders(entries, found);
    sort_by_number(found.colour);
    sort_by_number(found.depth);
    sort_by_number(found.unnamed);
    return found;
}

PictureRow nearest_in_time(const PictureRow& colour, const PictureRow& depth) {
    if (colour.empty() || depth.empty() || !has_order(colour, true) || !has_order(depth, true))
        return colour;
    const auto time_of = [](const NumberedPicture& picture) { return *picture.number; };
    const bool overlap = time_of(colour.front()) <= time_of(depth.back()) + kSameTime_s &&
                         time_of(depth.front()) <= time_of(colour.back()) + kSameTime_s;
    if (!overlap) return colour;
    PictureRow nearest;
    auto later = colour.begin();
    for (const NumberedPicture& picture : depth) {
        const double time_s = time_of(picture);
        while (later != colour.end() && time_of(*later) <= time_s) ++later;
        const bool has_before = later != colour.begin();
        const double before_s = has_before ? time_s - time_of(later[-1]) : kLongestRow_s;
        const double until_s = later != colour.end() ? time_of(*later) - time_s : kLongestRow_s;
        const bool takes_later = until_s <= kSameTime_s && until_s < before_s;
        if (!takes_later && !has_before) continue;
        const NumberedPicture& taken = takes_later ? *later : later[-1];
        if (nearest.empty() || nearest.back().file != taken.file)
            nearest.push_back({taken.file, time_s, true});
    }
    return nearest.empty() ? colour : nearest;
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
                                 PictureRole role, const LayoutFacts& layout, Timing timing)
    : row_(std::move(row)), role_(role) {
    StillFile first(row_.front().file, role_);
    facts_ = first.facts();
    last_ = first.next()->picture;
    facts_.file = std::move(place);
    facts_.timing = std::move(timing);
    apply_layout(layout);
    const double lasts_s = times.back() - times.front();
    if (row_.size() > 1 && !(lasts_s <= kLongestRow_s))
        throw InputError(shown(facts_.file) + " has pictures that are " + short_text(lasts_s) +
                         " s apart: give each its time in seconds, or only a number");
    take_times(std::move(times));
}

void PictureSequence::apply_layout(const LayoutFacts& layout) {
    facts_.notice = layout.notice;
    if (role_ != PictureRole::depth || facts_.bits != 16) return;
    DepthStatement known = layout.known;
    const bool is_size =
        layout.columns == 0 || (layout.columns == facts_.columns && layout.rows == facts_.rows);
    if (!is_size) known.intrinsics.reset();
    if (facts_.known_from.empty() && known != DepthStatement{})
        facts_.known_from = layout.known_from;
    facts_.known.fill_in(known);
    facts_.other_camera = layout.other_camera;
}

cv::Mat PictureSequence::picture(std::size_t at) {
    try {
        StillFile still(row_[at].file, role_);
        last_ = with_bits(still.next()->picture, still.facts().bits, facts_.bits);
    } catch (const InputError& error) {
        report_trouble(error.what());
    }
    return last_;
}

}  // namespace dibhr
