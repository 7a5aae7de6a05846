// Finds, orders and times the pictures of a folder, and reads them one after the other.
#include "core/video/sources/layouts/picture_folder.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/colour_maps.hpp"
#include "core/video/formats/array_file.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
    return !file.filename().string().starts_with('.') &&
           (named_picture(file) ? is_file(file) : is_raw_levels(file, {}));
}

bool is_painting(const fs::path& file) {
    try {
        const cv::Mat picture = read_still(file, PictureRole::colour).picture;
        return is_colour_mapped(picture) || has_two_levels(picture);
    } catch (const InputError&) {
        return false;
    }
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

int number_in_name(const fs::path& file) {
    constexpr double kMost = 1e9;
    const double number = numbered(file).number.value_or(0.0);
    return number < kMost ? static_cast<int>(number) : 0;
}

namespace {

constexpr double kLongestRow_s = 1e6;

/// The row for a picture, by the words in `name`, the name of the picture or of its folder.
PictureRow& row_for(PictureSet& set, const fs::path& name) {
    if (!named_other(name).empty()) return set.others;
    // Arrays of brightness are in no form of colours.
    if (named_brightness(name) && named_numbers(name)) return set.others;
    if (named_depth(name)) return set.depth;
    return named_colour(name) ? set.colour : set.unnamed;
}

std::set<double> numbers_of(const PictureRow& row) {
    std::set<double> numbers;
    for (const NumberedPicture& picture : row) numbers.insert(*picture.number);
    return numbers;
}

/// The pictures of a folder, else those of its subfolder `data` (EuRoC).
void append_pictures_of(const fs::path& folder, PictureRow& row) {
    const std::size_t before = row.size();
    for (const fs::path& file : entries_of(folder)) {
        if (is_picture(file)) row.push_back(numbered(file));
    }
    const fs::path inside = folder / "data";
    if (row.size() == before && is_folder(inside)) append_pictures_of(inside, row);
}

/// Beside depth, unnamed pictures count as colour where their names are those of all depth pictures
/// without the word for depth, else where a word allows it, else where names are those of some.
void accept_as_colour(PictureSet& set) {
    if (set.depth.empty() || !set.colour.empty()) return;
    std::set<std::string> subjects;
    for (const NumberedPicture& picture : set.depth) subjects.insert(subject_of(picture.file));
    const auto allowed = [](const NumberedPicture& picture) {
        return may_name_colour(picture.file.filename()) || named_brightness(picture.file);
    };
    const auto belongs = [&subjects](const NumberedPicture& picture) {
        return subjects.contains(subject_of(picture.file));
    };
    PictureRow own;
    std::copy_if(set.unnamed.begin(), set.unnamed.end(), std::back_inserter(own), belongs);
    if (own.size() != set.depth.size())
        std::copy_if(set.unnamed.begin(), set.unnamed.end(), std::back_inserter(set.colour),
                     allowed);
    if (set.colour.empty()) set.colour = std::move(own);
}

std::string stem_of(const NumberedPicture& picture) {
    return picture.file.stem().string();
}

/// Of depth pictures of one name, numbers and a painting of them, only the numbers stay.
void drop_paintings_of_numbers(PictureRow& depth) {
    std::set<std::string> numbers;
    for (const NumberedPicture& picture : depth)
        if (named_numbers(picture.file)) numbers.insert(stem_of(picture));
    std::erase_if(depth, [&numbers](const NumberedPicture& picture) {
        return !named_numbers(picture.file) && numbers.contains(stem_of(picture));
    });
}

/// Depth pictures leave the row that are statistics of another one: Middlebury's "disp0-sd.pfm" and
/// "disp0-n.pgm" of "disp0.pfm".
void drop_statistics(PictureRow& depth) {
    std::set<std::string> names;
    for (const NumberedPicture& picture : depth) names.insert(stem_of(picture));
    std::erase_if(depth, [&names](const NumberedPicture& picture) {
        const std::string name = stem_of(picture);
        const bool is_named_so = name.ends_with("-sd") || name.ends_with("-n");
        return is_named_so && names.contains(name.substr(0, name.rfind('-')));
    });
}

/// Arrays and pictures whose names say nothing are no single row: the arrays are depth, and the
/// pictures their colour where they have the same names or are as many, and do not paint it.
void part_numbers_from_pictures(PictureSet& set) {
    if (!set.depth.empty() || !set.colour.empty()) return;
    // An EXR picture may be a photograph.
    const auto begin_of_pictures = std::stable_partition(
        set.unnamed.begin(), set.unnamed.end(), [](const NumberedPicture& picture) {
            return named_numbers(picture.file) && picture.file.extension() != ".exr";
        });
    if (begin_of_pictures == set.unnamed.begin() || begin_of_pictures == set.unnamed.end()) return;
    const PictureRow pictures(begin_of_pictures, set.unnamed.end());
    set.depth.assign(set.unnamed.begin(), begin_of_pictures);
    set.unnamed.clear();
    const bool belong = pictures.size() == set.depth.size() ||
                        stem_of(pictures.front()) == stem_of(set.depth.front());
    const fs::path& first = pictures.front().file;
    if (belong && !is_painting(first))
        set.colour = pictures;
    else
        set.facts.notice = shown(first.filename()) +
                           (pictures.size() > 1 ? " and the pictures like it are" : " is") +
                           " left out: the arrays beside are the depth, and it is no photograph of "
                           "them";
}

/// Moves to the unnamed pictures what a last word alone called a mask, confidence, ...: where a
/// depth picture has the same subject ("mask.png" of "mask_depth.png"), or where nothing else is
/// there.
void restore_others(PictureSet& set) {
    const bool is_alone = set.colour.empty() && set.depth.empty() && set.unnamed.empty();
    std::set<std::string> subjects;
    for (const NumberedPicture& picture : set.depth) subjects.insert(subject_of(picture.file));
    const auto stay = std::stable_partition(
        set.others.begin(), set.others.end(), [&](const NumberedPicture& picture) {
            return is_alone || subjects.contains(subject_of(picture.file));
        });
    std::move(set.others.begin(), stay, std::back_inserter(set.unnamed));
    set.others.erase(set.others.begin(), stay);
}

bool begins_with_numbers(const PictureRow& row) {
    return !row.empty() && named_numbers(row.front().file);
}

/// Adds the pictures of subfolders named depth or colour; of several the first, of depth preferably
/// one of arrays ("depth_bw" beside "depth_npy").
void find_pictures_in_folders(const std::vector<fs::path>& entries, PictureSet& set) {
    for (const fs::path& entry : entries) {
        if (!is_folder(entry)) continue;
        PictureRow& row = row_for(set, entry.filename());
        if (&row == &set.unnamed || &row == &set.others) continue;
        PictureRow found;
        append_pictures_of(entry, found);
        const bool is_plain =
            !row.empty() &&
            lower_case(row.front().file.parent_path().filename().string()) == "depth";
        const bool is_finer = &row == &set.depth && !is_plain && begins_with_numbers(found) &&
                              !begins_with_numbers(row);
        if (row.empty() || is_finer) row = std::move(found);
    }
    for (const fs::path& entry : entries) {
        if (set.depth.empty() || !set.colour.empty()) return;
        const std::string name = lower_case(entry.filename().string());
        const bool is_camera = name == "photo" || name == "cam" || name == "cam0";
        const bool is_colour = (is_camera || may_name_colour(entry)) && !named_depth(entry) &&
                               named_other(entry).empty();
        if (is_colour && is_folder(entry)) append_pictures_of(entry, set.colour);
    }
}

/// Arrays leave the row whose shapes are no pictures': cameras, poses, lists of numbers. Of those
/// with one name and several numbers the first is examined.
void drop_matrices(PictureRow& row) {
    std::map<std::string, bool> may_be_pictures;
    std::erase_if(row, [&may_be_pictures](const NumberedPicture& picture) {
        if (lower_case(picture.file.extension().string()) != ".npy") return false;
        std::string name = stem_of(picture);
        std::erase_if(name, is_decimal_digit);
        const auto known = may_be_pictures.find(name);
        if (known != may_be_pictures.end()) return !known->second;
        return !(may_be_pictures[name] = may_be_picture(picture.file));
    });
}

PictureSet pictures_among(const std::vector<fs::path>& entries) {
    PictureSet found;
    for (const fs::path& entry : entries) {
        if (is_picture(entry)) row_for(found, entry).push_back(numbered(entry));
    }
    drop_matrices(found.unnamed);
    return found;
}

/// Decides what pictures beside others are, whose own names do not say it.
void complete(PictureSet& set) {
    drop_statistics(set.depth);
    restore_others(set);
    part_numbers_from_pictures(set);
    accept_as_colour(set);
}

bool is_empty(const PictureSet& set) {
    return set.colour.empty() && set.depth.empty() && set.unnamed.empty() && set.others.empty();
}

/// The pictures of the only subfolder that has depth with its colour ("results", "frames").
PictureSet find_pictures_below(const std::vector<fs::path>& entries) {
    PictureSet only;
    for (const fs::path& entry : entries) {
        if (!is_folder(entry) || entry.filename().string().starts_with('.')) continue;
        PictureSet inside;
        try {
            inside = pictures_among(entries_of(entry));
        } catch (const InputError&) {
            continue;  // it may not be read
        }
        complete(inside);
        if (inside.colour.empty() || inside.depth.empty()) continue;
        if (!is_empty(only)) return {};
        only = std::move(inside);
    }
    return only;
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
    const std::vector<fs::path> entries = entries_of(folder);
    PictureSet found = pictures_among(entries);
    const bool has_named = !found.colour.empty() || !found.depth.empty();
    const bool is_bare = is_empty(found);
    PictureSet inside;
    if (!has_named && found.unnamed.size() <= 1) find_pictures_in_folders(entries, inside);
    if (!inside.depth.empty() || (!inside.colour.empty() && found.unnamed.empty()))
        found = std::move(inside);
    else
        complete(found);
    if (is_bare && is_empty(found)) found = find_pictures_below(entries);
    if (is_empty(found) && is_folder(folder / "data")) return find_pictures_in(folder / "data");
    drop_paintings_of_numbers(found.depth);
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
                                 PictureRole role, const LayoutFacts& layout, Timing timing)
    : row_(std::move(row)), role_(role) {
    StillFile first(row_.front().file, role_);
    facts_ = first.facts();
    last_ = first.next()->picture;
    facts_.first_picture = row_.front().file;
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
    add_clause(facts_.notice, layout.notice);
    if (role_ != PictureRole::depth || facts_.bits != 16) return;
    Finding finding = layout.finding;
    std::optional<Intrinsics>& camera = finding.statement.intrinsics;
    if (camera && (layout.columns > 0 || !is_camera(*camera))) {
        const FittedCamera fitted =
            fit_camera(*camera, {layout.columns, layout.rows}, {facts_.columns, facts_.rows});
        camera = fitted.camera;
        add_clause(facts_.notice, fitted.notice);
    }
    if (finding.statement != DepthStatement{}) facts_.findings.push_back(std::move(finding));
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
