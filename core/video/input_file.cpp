// What can be said about a given file before any decoder sees it.
#include "core/video/input_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/media.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Whether the file begins like text: no zero and no control bytes. Playlists are text, too, and
/// would make the decoder open other files. Text pictures (PNM) are not refused.
bool begins_like_text(std::ifstream& in) {
    std::array<char, 512> head{};
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    const auto count = static_cast<std::size_t>(in.gcount());
    if (count >= 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7') return false;
    return std::all_of(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(count), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 32 || (byte >= '\t' && byte <= '\r') || byte == 27;
    });
}

constexpr std::array<std::string_view, 3> kColourWords{"colour", "color", "rgb"};

/// `stem` with the first `word` replaced by `other`, written as large as `word` is; nothing when
/// the stem does not hold the word.
std::optional<std::string> renamed(const std::string& stem, std::string_view word,
                                   std::string_view other) {
    const auto at = lower(stem).find(word);
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
    static constexpr std::array<std::string_view, 18> kExtensions{
        ".avi", ".bmp", ".jpeg", ".jpg", ".m4v", ".mkv", ".mov",  ".mp4",  ".mpg",
        ".ogv", ".pgm", ".png",  ".ppm", ".tif", ".ts",  ".tiff", ".webm", ".webp"};
    std::set<fs::path> found;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end;
         !failed && entry != end; entry.increment(failed)) {
        const auto& file = entry->path();
        const auto extension = lower(file.extension().string());
        if (file.stem() == stem &&
            std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end() &&
            is_file(file))
            found.insert(folder / file.filename());
    }
    if (found.empty()) return std::nullopt;
    return *found.begin();
}

/// The file beside `given` of that stem: of the same extension, else of another.
std::optional<fs::path> with_stem(const fs::path& given, const std::string& stem) {
    const auto folder = given.parent_path();
    const auto same = folder / (stem + given.extension().string());
    return is_file(same) ? same : with_any_extension(folder, stem);
}

}  // namespace

std::string shown(const fs::path& file) {
    return in_quotes(file.string(), std::string::npos);
}

bool named_depth(const fs::path& file) {
    return lower(file.stem().string()).find("depth") != std::string::npos;
}

void require_readable(const fs::path& file) {
    std::error_code failed;
    const auto status = fs::status(file, failed);
    if (status.type() == fs::file_type::not_found)
        throw InputError(shown(file) + " does not exist: check the name and the folder");
    if (failed)
        throw InputError(shown(file) + " cannot be reached (" + failed.message() +
                         "): check the name and the permissions of its folder");
    if (fs::is_directory(status))
        throw InputError(shown(file) + " is a folder: give the video or picture file in it");
    if (!fs::is_regular_file(status))
        throw InputError(shown(file) + " is a pipe or a device: save its data to a file first");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError(shown(file) + " cannot be read: check its permissions (chmod u+r)");
    if (fs::file_size(file, failed) == 0)
        throw InputError(shown(file) + " is empty: record or copy it again");
    if (begins_like_text(in))
        throw InputError(shown(file) + " holds text, not a video or a picture: give another file");
}

void require_size(const fs::path& file, int columns, int rows) {
    if (columns >= 2 && rows >= 2) return;
    throw InputError(shown(file) + " is only " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " pixels: give one of at least 2 x 2");
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
