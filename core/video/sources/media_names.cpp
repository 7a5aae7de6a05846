// Compares words and endings of names.
#include "core/video/sources/media_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/depth_words.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using Words = std::span<const std::string_view>;

// Anywhere in a name.
constexpr std::array<std::string_view, 6> kColourWords{"colour", "color",   "rgb",
                                                       "albedo", "diffuse", "couleur"};
constexpr std::array<std::string_view, 9> kDepthWords{
    "depth",        "disparity",  "disparities",
    "displacement", "heightmap",  "profondeur",
    "profundidad",  "profondita", "\xe6\xb7\xb1\xe5\xba\xa6"};  // Chinese
// Between other letters they mean something else: "display", "different".
constexpr std::array<std::string_view, 4> kShortColourWords{"diff", "farbe", "farben", "farbbild"};
constexpr std::array<std::string_view, 6> kShortDepthWords{"disp",   "height",     "tiefe",
                                                           "tiefen", "tiefenbild", "tiefenkarte"};
constexpr std::array<std::string_view, 11> kMayBeColour{"image",  "images", "img",     "im",
                                                        "left",   "frame",  "frames",  "src",
                                                        "source", "input",  "original"};
// "mono_depth", "depth maps"
constexpr std::array<std::string_view, 3> kNeutralWords{"map", "maps", "mono"};

// After the word that decides: "normal_gl_2k", "confidence_image", "labelIds", "normal_pred".
constexpr std::array<std::string_view, 13> kPassedWords{"map", "maps", "image",     "img", "gl",
                                                        "dx",  "k",    "px",        "ids", "occ",
                                                        "noc", "pred", "prediction"};

constexpr std::array<std::string_view, 5> kNumberEndings{".exr", ".npy", ".npz", ".pfm", ".raw"};
constexpr std::array<std::string_view, 18> kPictureEndings{
    ".bmp", ".exr", ".heic", ".heif", ".hif", ".jpeg", ".jpg", ".npy",  ".npz",
    ".pfm", ".pgm", ".png",  ".pnm",  ".ppm", ".tga",  ".tif", ".tiff", ".webp"};
constexpr std::array<std::string_view, 9> kVideoEndings{".avi", ".m4v", ".mkv", ".mov", ".mp4",
                                                        ".mpg", ".ogv", ".ts",  ".webm"};

bool ends_as(const fs::path& file, Words endings) {
    return is_one_of(lower_case(file.extension().string()), endings);
}

bool holds(const fs::path& file, Words anywhere, Words whole) {
    const std::string name = lower_case(file.filename().string());
    const std::vector<std::string> words = words_of_name(file.filename().string());
    return std::any_of(
               anywhere.begin(), anywhere.end(),
               [&](std::string_view word) { return name.find(word) != std::string::npos; }) ||
           std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return is_one_of(word, whole); });
}

/// `stem` with the first `word` replaced by `other`, in the same case; nothing when the stem does
/// not hold the word.
std::optional<std::string> renamed(const std::string& stem, std::string_view word,
                                   std::string_view other) {
    const auto at = lower_case(stem).find(word);
    if (at == std::string::npos) return std::nullopt;
    const auto is_large = [&](std::size_t k) {
        return std::isupper(static_cast<unsigned char>(stem[k])) != 0;
    };
    const auto large = [](char c) {
        return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    };
    std::string written(other);
    if (is_large(at)) written[0] = large(written[0]);
    if (is_large(at) && is_large(at + 1))
        std::transform(written.begin(), written.end(), written.begin(), large);
    return std::string(stem).replace(at, word.size(), written);
}

bool named_media(const fs::path& file) {
    return named_picture(file) || named_video(file);
}

/// The entries of a file's or folder's own folder whose name is not hidden, the place itself left
/// out; none where it cannot be read.
std::vector<fs::path> neighbours_of(const fs::path& given) {
    std::vector<fs::path> found;
    const fs::path folder = given.parent_path();
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const fs::path name = entry->path().filename();
        if (name != given.filename() && !name.string().starts_with('.'))
            found.push_back(folder / name);
    }
    return found;
}

/// What the last word of a name that counts says; null: nothing.
const OtherContent* named_content(const fs::path& file) {
    // Of a folder the whole name, of a file what is before the ending.
    const bool has_ending = named_media(file) || named_numbers(file);
    const auto words = words_of_name((has_ending ? file.stem() : file.filename()).string());
    const auto last = std::find_if(words.rbegin(), words.rend(), [](const std::string& word) {
        return !is_of_digits(word) && !is_one_of(word, kPassedWords);
    });
    return last == words.rend() ? nullptr : other_content_of(*last);
}

/// The same, but for what serves as the colour, and for quantities, which names of depth hold, too.
const OtherContent* other_content(const fs::path& file) {
    const OtherContent* const found = named_content(file);
    return found != nullptr && (found->shows_scene || found->is_quantity) ? nullptr : found;
}

/// The name of the first picture in a folder; empty: it holds none, or is no folder.
fs::path first_picture_in(const fs::path& folder) {
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const fs::path name = entry->path().filename();
        if (named_picture(name) && !name.string().starts_with('.') && is_file(*entry)) return name;
    }
    return {};
}

/// Whether the two may be colour and depth of one recording, by what they are: two files, two
/// folders, or a video and a folder of pictures.
bool may_be_pair(const fs::path& given, const fs::path& other) {
    if (!is_folder(other))
        return is_file(other) && (is_folder(given) ? named_video(other) : named_media(other));
    return is_folder(given) || (named_video(given) && !first_picture_in(other).empty());
}

/// The first file beside `given` of that stem, with any extension, or for a video the folder.
/// Nothing when there is none.
std::optional<fs::path> with_any_extension(const fs::path& given, const std::string& stem) {
    std::set<fs::path> files;
    std::optional<fs::path> folder;
    for (const fs::path& other : neighbours_of(given)) {
        const bool may_be_folder = other.filename() == stem;
        if ((!may_be_folder && other.stem() != stem) || !may_be_pair(given, other)) continue;
        if (!is_folder(other))
            files.insert(other);
        else if (may_be_folder)
            folder = other;
    }
    return files.empty() ? folder : *files.begin();
}

/// The place beside `given` of that stem: of numbers where they are searched, else of the same
/// extension, else of another; the folder beside a folder.
std::optional<fs::path> with_stem(const fs::path& given, const std::string& stem, bool numbers) {
    const auto same = given.parent_path() / (stem + given.extension().string());
    if (is_folder(given) && is_folder(same)) return same;
    if (numbers && named_picture(given) && !is_folder(given)) {
        if (auto found = numbers_beside(same)) return found;
    }
    return !is_folder(given) && is_file(same) ? same : with_any_extension(given, stem);
}

/// The place beside `given` that may belong to it and that `fits`: preferably a file beside a file
/// and a folder beside a folder, then one of numbers where they are preferred, then the first.
template <typename Fits>
std::optional<fs::path> best_beside(const fs::path& given, Fits fits, bool prefers_numbers) {
    std::optional<fs::path> found;
    const auto is_of_other_kind = [&](const fs::path& place) {
        return is_folder(place) != is_folder(given);
    };
    const auto has_numbers = [&](const fs::path& place) {
        return prefers_numbers && named_numbers(is_folder(place) ? first_picture_in(place) : place);
    };
    const auto is_better = [&](const fs::path& a, const fs::path& b) {
        if (is_of_other_kind(a) != is_of_other_kind(b)) return is_of_other_kind(b);
        if (has_numbers(a) != has_numbers(b)) return has_numbers(a);
        return in_natural_order(a.filename().string(), b.filename().string());
    };
    for (const fs::path& other : neighbours_of(given)) {
        if (!fits(other) || !may_be_pair(given, other) || names_touch_map(other)) continue;
        if (!found || is_better(other, *found)) found = other;
    }
    return found;
}

/// The best place beside `given` whose name `fits` and that is of the same subject; else, beside
/// the only video of its kind, a folder of pictures that is `named`.
template <typename Fits, typename Named>
std::optional<fs::path> belonging_to(const fs::path& given, Fits fits, Named named,
                                     bool prefers_numbers) {
    const std::string subject = subject_of(given);
    const auto is_of_subject = [&](const fs::path& other) {
        return fits(other.filename()) && subject_of(other.filename()) == subject;
    };
    if (auto found = best_beside(given, is_of_subject, prefers_numbers)) return found;
    if (!named_video(given) || is_folder(given)) return std::nullopt;
    const std::vector<fs::path> others = neighbours_of(given);
    const bool is_only = std::none_of(others.begin(), others.end(), [&](const fs::path& other) {
        return named_video(other) && named_depth(other) == named_depth(given) &&
               named_other(other).empty();
    });
    if (!is_only) return std::nullopt;
    const auto is_row = [&](const fs::path& other) {
        return is_folder(other) && named(other.filename());
    };
    return best_beside(given, is_row, prefers_numbers);
}

/// The video beside a folder of pictures that `partner` says belongs to it.
template <typename Partner>
std::optional<fs::path> video_of_folder(const fs::path& folder, Partner partner) {
    for (const fs::path& other : neighbours_of(folder))
        if (named_video(other) && !is_folder(other) && partner(other) == folder) return other;
    return std::nullopt;
}

}  // namespace

fs::path without_slash(const fs::path& place) {
    return place.has_filename() ? place : place.parent_path();
}

std::span<const std::string_view> picture_endings() noexcept {
    return kPictureEndings;
}

std::span<const std::string_view> video_endings() noexcept {
    return kVideoEndings;
}

bool named_picture(const fs::path& file) {
    return ends_as(file, kPictureEndings);
}

bool named_video(const fs::path& file) {
    return ends_as(file, kVideoEndings);
}

bool named_numbers(const fs::path& file) {
    return ends_as(file, kNumberEndings);
}

std::string_view named_other(const fs::path& file) {
    const OtherContent* const found = other_content(file);
    return found == nullptr ? std::string_view() : found->what;
}

std::string_view named_no_depth(const fs::path& place) {
    const OtherContent* const found = other_content(place);
    return found == nullptr || found->shows_depth ? std::string_view() : found->what;
}

bool named_brightness(const fs::path& file) {
    const OtherContent* const found = named_content(file);
    return found != nullptr && found->shows_scene;
}

std::string_view folder_named_no_depth(const fs::path& file) {
    const auto says_nothing = [](const std::string& word) {
        return is_of_digits(word) || is_one_of(word, kMayBeColour) || is_one_of(word, kPassedWords);
    };
    const std::vector<std::string> own = words_of_name(file.stem().string());
    if (!std::all_of(own.begin(), own.end(), says_nothing)) return {};
    const fs::path folder = file.parent_path().filename();
    const OtherContent* const found = other_content(folder);
    if (found == nullptr || found->shows_depth) return {};
    const std::vector<std::string> words = words_of_name(folder.string());
    const bool is_whole = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
        return says_nothing(word) || other_content_of(word) == found;
    });
    return is_whole ? found->what : std::string_view();
}

std::optional<fs::path> numbers_beside(const fs::path& file) {
    for (const std::string_view ending : kNumberEndings) {
        fs::path numbers = file;
        numbers.replace_extension(ending);
        if (numbers == file || !is_file(numbers)) continue;
        if (ending != ".raw" || is_raw_levels(numbers, {})) return numbers;
    }
    return std::nullopt;
}

bool named_colour(const fs::path& file) {
    return holds(file, kColourWords, kShortColourWords) && named_other(file).empty();
}

bool named_depth(const fs::path& file) {
    return holds(file, kDepthWords, kShortDepthWords) && named_other(file).empty();
}

bool may_name_colour(const fs::path& file) {
    return holds(file, {}, kMayBeColour);
}

std::string subject_of(const fs::path& file) {
    std::string subject;
    for (std::string word : words_of_name(file.stem().string())) {
        for (const Words anywhere : {Words(kColourWords), Words(kDepthWords)}) {
            for (const std::string_view said : anywhere) {
                const auto at = word.find(said);
                if (at == std::string::npos) continue;
                word.erase(at, said.size());
                if (word == "s") word.clear();  // "depths"
            }
        }
        if (word.empty() || is_one_of(word, kShortColourWords) ||
            is_one_of(word, kShortDepthWords) || is_one_of(word, kMayBeColour) ||
            is_one_of(word, kNeutralWords))
            continue;
        if (!subject.empty()) subject += ' ';
        subject += word;
    }
    return subject;
}

std::optional<fs::path> find_depth_beside(const fs::path& given, std::string& looked_for) {
    const fs::path colour = without_slash(given);
    looked_for.clear();
    for (const auto word : kColourWords) {
        const auto stem = renamed(colour.stem().string(), word, "depth");
        if (!stem) continue;
        const auto same = colour.parent_path() / (*stem + colour.extension().string());
        if (!looked_for.empty()) looked_for += ", ";
        looked_for += shown(same) + (named_video(colour) && !is_folder(colour)
                                         ? " (or another extension, or a folder of pictures)"
                                         : " (or another extension)");
        if (auto found = with_stem(colour, *stem, true)) return found;
    }
    if (named_depth(colour)) return std::nullopt;
    if (auto found = belonging_to(colour, named_depth, named_depth, true)) return found;
    if (is_folder(colour))
        return video_of_folder(colour, [](const fs::path& video) {
            return named_depth(video) ? find_colour_beside(video) : std::nullopt;
        });
    if (named_numbers(colour)) return std::nullopt;
    const auto numbers = numbers_beside(colour);
    // An EXR picture beside a photograph is the same photograph.
    return numbers && numbers->extension() != ".exr" ? numbers : std::nullopt;
}

std::optional<fs::path> find_colour_beside(const fs::path& given) {
    const fs::path depth = without_slash(given);
    for (const auto word : kColourWords) {
        const auto stem = renamed(depth.stem().string(), "depth", word);
        if (!stem) continue;
        if (auto found = with_stem(depth, *stem, false)) return found;
    }
    if (!named_depth(depth)) return std::nullopt;
    const auto may_be_colour = [](const fs::path& name) {
        return !named_depth(name) && named_other(name).empty();
    };
    const auto is_called_colour = [&](const fs::path& name) {
        return may_be_colour(name) && (named_colour(name) || may_name_colour(name));
    };
    if (auto found = belonging_to(depth, may_be_colour, is_called_colour, false)) return found;
    if (!is_folder(depth)) return std::nullopt;
    return video_of_folder(depth, [&](const fs::path& video) {
        std::string ignored;
        return may_be_colour(video) ? find_depth_beside(video, ignored) : std::nullopt;
    });
}

}  // namespace dibhr
