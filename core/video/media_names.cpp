// Words and endings in names.
#include "core/video/media_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "core/video/media.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using Words = std::span<const std::string_view>;
constexpr std::array<std::string_view, 3> kColourWords{"colour", "color", "rgb"};
constexpr std::array<std::string_view, 11> kPictureEndings{
    ".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".pnm", ".ppm", ".tga", ".tif", ".tiff", ".webp"};
constexpr std::array<std::string_view, 9> kVideoEndings{".avi", ".m4v", ".mkv", ".mov", ".mp4",
                                                        ".mpg", ".ogv", ".ts",  ".webm"};

bool ends_as(const fs::path& file, Words endings) {
    const std::string ending = lower_case(file.extension().string());
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

bool holds(const fs::path& file, std::string_view word) {
    return lower_case(file.filename().string()).find(word) != std::string::npos;
}

/// `stem` with the first `word` replaced by `other`, written as large as `word` is; nothing when
/// the stem does not hold the word.
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

bool is_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

/// The file of that stem in that folder, whatever its extension; the first by name. Nothing when
/// none.
std::optional<fs::path> with_any_extension(const fs::path& folder, const std::string& stem) {
    std::set<fs::path> found;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const auto& file = entry->path();
        const bool of_media = named_picture(file) || ends_as(file, kVideoEndings);
        if (file.stem() == stem && of_media && is_file(file))
            found.insert(folder / file.filename());
    }
    if (found.empty()) return std::nullopt;
    return *found.begin();
}

/// The file beside `given` of that stem: of the same extension, else of another; the folder beside
/// a folder.
std::optional<fs::path> with_stem(const fs::path& given, const std::string& stem) {
    const auto folder = given.parent_path();
    const auto same = folder / (stem + given.extension().string());
    if (is_folder(given)) return is_folder(same) ? std::optional(same) : std::nullopt;
    return is_file(same) ? same : with_any_extension(folder, stem);
}

}  // namespace

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_folder(const fs::path& place) {
    std::error_code ignored;
    return fs::is_directory(place, ignored);
}

bool named_picture(const fs::path& file) {
    return ends_as(file, kPictureEndings);
}

bool named_colour(const fs::path& file) {
    return std::any_of(kColourWords.begin(), kColourWords.end(),
                       [&file](std::string_view word) { return holds(file, word); });
}

bool named_depth(const fs::path& file) {
    return holds(file, "depth");
}

std::optional<fs::path> find_depth_beside(const fs::path& colour, std::string& looked_for) {
    looked_for.clear();
    for (const auto word : kColourWords) {
        const auto stem = renamed(colour.stem().string(), word, "depth");
        if (!stem) continue;
        const auto same = colour.parent_path() / (*stem + colour.extension().string());
        if (!looked_for.empty()) looked_for += ", ";
        looked_for += shown(same) + " (or another extension)";
        if (auto found = with_stem(colour, *stem)) return found;
    }
    if (looked_for.empty())
        looked_for = "nothing, because the name holds neither color, colour nor rgb";
    return std::nullopt;
}

std::optional<fs::path> find_colour_beside(const fs::path& depth) {
    for (const auto word : kColourWords) {
        const auto stem = renamed(depth.stem().string(), "depth", word);
        if (!stem) continue;
        if (auto found = with_stem(depth, *stem)) return found;
    }
    return std::nullopt;
}

}  // namespace dibhr
