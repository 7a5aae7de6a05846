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
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using Words = std::span<const std::string_view>;

// Anywhere in a name.
constexpr std::array<std::string_view, 5> kColourWords{"colour", "color", "rgb", "albedo",
                                                       "diffuse"};
constexpr std::array<std::string_view, 5> kDepthWords{"depth", "disparity", "disparities",
                                                      "displacement", "heightmap"};
// Between other letters they mean something else: "display", "different".
constexpr std::array<std::string_view, 1> kShortColourWords{"diff"};
constexpr std::array<std::string_view, 2> kShortDepthWords{"disp", "height"};
constexpr std::array<std::string_view, 7> kMayBeColour{"image", "images", "img",   "im",
                                                       "left",  "frame",  "frames"};
constexpr std::array<std::string_view, 2> kNeutralWords{"map",
                                                        "mono"};  // "mono_depth", "depth map"

/// Last words of names of what belongs to a recording, and is neither its colour nor its depth.
struct OtherContent {
    std::string_view what;    ///< for people
    std::string_view words;   ///< each between blanks
    bool shows_depth{false};  ///< it may be felt, though something else is better
};
constexpr std::array kOtherContents{
    OtherContent{"a mask", " mask masks valid validity "},
    OtherContent{"confidence", " conf confidence confidences certainty uncertainty "},
    OtherContent{"normals", " normal normals nor nrm "},
    OtherContent{"infrared", " ir infra infrared "},
    OtherContent{"a preview", " thumb thumbs thumbnail thumbnails preview previews poster ", true},
    OtherContent{"a painting of depth",
                 " vis viz visualization visualisation visualized visualised colored coloured "
                 "colorized colourised colormap colourmap ",
                 true},
    OtherContent{"labels", " semantic semantics seg segmentation label labels instance instances "},
    OtherContent{"optical flow", " flow flows "},
    OtherContent{"another map of the material", " ao rough roughness metallic metalness opacity "}};
// After the word that decides: "normal_gl_2k", "confidence_map", "labelIds", "flow_occ".
constexpr std::array<std::string_view, 9> kPassedWords{"map", "maps", "gl",  "dx", "k",
                                                       "px",  "ids",  "occ", "noc"};

constexpr std::array<std::string_view, 5> kNumberEndings{".exr", ".npy", ".npz", ".pfm", ".raw"};
constexpr std::array<std::string_view, 18> kPictureEndings{
    ".bmp", ".exr", ".heic", ".heif", ".hif", ".jpeg", ".jpg", ".npy",  ".npz",
    ".pfm", ".pgm", ".png",  ".pnm",  ".ppm", ".tga",  ".tif", ".tiff", ".webp"};
constexpr std::array<std::string_view, 9> kVideoEndings{".avi", ".m4v", ".mkv", ".mov", ".mp4",
                                                        ".mpg", ".ogv", ".ts",  ".webm"};

bool ends_as(const fs::path& file, Words endings) {
    const std::string ending = lower_case(file.extension().string());
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

bool is_one_of(std::string_view word, Words words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_of_digits(const std::string& word) {
    return std::all_of(word.begin(), word.end(), is_decimal_digit);
}

/// Whether a new word begins between the two characters.
bool is_between_words(char before, char after) {
    const auto is = [](int (*kind)(int), char c) {
        return kind(static_cast<unsigned char>(c)) != 0;
    };
    return is_decimal_digit(before) != is_decimal_digit(after) ||
           (is(std::islower, before) && is(std::isupper, after));
}

/// The words of a name in small letters; a run of digits is a word, too.
std::vector<std::string> words_of(const std::string& name) {
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

bool holds(const fs::path& file, Words anywhere, Words whole) {
    const std::string name = lower_case(file.filename().string());
    const std::vector<std::string> words = words_of(file.filename().string());
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

/// The first file of that stem in that folder, with any extension. Nothing when there is none.
std::optional<fs::path> with_any_extension(const fs::path& folder, const std::string& stem) {
    std::set<fs::path> found;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const auto& file = entry->path();
        if (file.stem() == stem && named_media(file) && is_file(file))
            found.insert(folder / file.filename());
    }
    if (found.empty()) return std::nullopt;
    return *found.begin();
}

/// The file beside `given` of that stem: of numbers where they are searched, else of the same
/// extension, else of another; the folder beside a folder.
std::optional<fs::path> with_stem(const fs::path& given, const std::string& stem, bool numbers) {
    const auto folder = given.parent_path();
    const auto same = folder / (stem + given.extension().string());
    if (is_folder(given)) return is_folder(same) ? std::optional(same) : std::nullopt;
    if (numbers && named_picture(given)) {
        if (auto found = numbers_beside(same)) return found;
    }
    return is_file(same) ? same : with_any_extension(folder, stem);
}

/// The first file beside `given`, or folder beside a folder, that is of the same subject and that
/// `fits`; the first of numbers where they are preferred.
template <typename Fits>
std::optional<fs::path> of_same_subject(const fs::path& given, Fits fits, bool prefers_numbers) {
    std::optional<fs::path> found;
    const std::string subject = subject_of(given);
    const fs::path folder = given.parent_path();
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const fs::path name = entry->path().filename();
        const bool of_kind =
            is_folder(given) ? is_folder(*entry) : named_media(name) && is_file(*entry);
        if (!of_kind || name == given.filename() || name.string().starts_with('.') || !fits(name) ||
            names_touch_map(folder / name) || subject_of(name) != subject)
            continue;
        const auto has_numbers = [&](const fs::path& file) {
            return prefers_numbers && named_numbers(file);
        };
        const bool is_first = !found || in_natural_order(name.string(), found->filename().string());
        if (found && has_numbers(name) != has_numbers(*found) ? has_numbers(name) : is_first)
            found = folder / name;
    }
    return found;
}

/// What the last word of a name that counts says; null: nothing.
const OtherContent* other_content(const fs::path& file) {
    // Of a folder the whole name, of a file what is before the ending.
    const bool has_ending = named_media(file) || named_numbers(file);
    const auto words = words_of((has_ending ? file.stem() : file.filename()).string());
    const auto last = std::find_if(words.rbegin(), words.rend(), [](const std::string& word) {
        return !is_of_digits(word) && !is_one_of(word, kPassedWords);
    });
    if (last == words.rend()) return nullptr;
    const auto* const found = std::find_if(
        kOtherContents.begin(), kOtherContents.end(), [&last](const OtherContent& content) {
            return content.words.find(' ' + *last + ' ') != std::string_view::npos;
        });
    return found == kOtherContents.end() ? nullptr : found;
}

}  // namespace

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

std::string_view folder_named_no_depth(const fs::path& file) {
    const auto says_nothing = [](const std::string& word) {
        return is_of_digits(word) || is_one_of(word, kMayBeColour) || is_one_of(word, kPassedWords);
    };
    const std::vector<std::string> own = words_of(file.stem().string());
    if (!std::all_of(own.begin(), own.end(), says_nothing)) return {};
    const fs::path folder = file.parent_path().filename();
    const OtherContent* const found = other_content(folder);
    if (found == nullptr || found->shows_depth) return {};
    const std::vector<std::string> words = words_of(folder.string());
    const bool is_whole = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
        return says_nothing(word) || found->words.find(' ' + word + ' ') != std::string_view::npos;
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
    for (std::string word : words_of(file.stem().string())) {
        for (const Words anywhere : {Words(kColourWords), Words(kDepthWords)}) {
            for (const std::string_view said : anywhere) {
                if (const auto at = word.find(said); at != std::string::npos)
                    word.erase(at, said.size());
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

std::optional<fs::path> find_depth_beside(const fs::path& colour, std::string& looked_for) {
    looked_for.clear();
    for (const auto word : kColourWords) {
        const auto stem = renamed(colour.stem().string(), word, "depth");
        if (!stem) continue;
        const auto same = colour.parent_path() / (*stem + colour.extension().string());
        if (!looked_for.empty()) looked_for += ", ";
        looked_for += shown(same) + " (or another extension)";
        if (auto found = with_stem(colour, *stem, true)) return found;
    }
    if (looked_for.empty())
        looked_for = "nothing, because the name holds neither color, colour nor rgb";
    if (named_depth(colour)) return std::nullopt;
    if (auto found = of_same_subject(colour, named_depth, true)) return found;
    if (named_numbers(colour) || is_folder(colour)) return std::nullopt;
    const auto numbers = numbers_beside(colour);
    // An EXR picture beside a photograph is the same photograph.
    return numbers && numbers->extension() != ".exr" ? numbers : std::nullopt;
}

std::optional<fs::path> find_colour_beside(const fs::path& depth) {
    for (const auto word : kColourWords) {
        const auto stem = renamed(depth.stem().string(), "depth", word);
        if (!stem) continue;
        if (auto found = with_stem(depth, *stem, false)) return found;
    }
    if (!named_depth(depth)) return std::nullopt;
    const auto may_be_colour = [](const fs::path& name) {
        return !named_depth(name) && named_other(name).empty();
    };
    return of_same_subject(depth, may_be_colour, false);
}

}  // namespace dibhr
