// Reading a folder, and completing what is typed.
#include "app/settings/folder.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/settings/recent_files.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

bool is_hidden(const fs::path& file) {
    return file.filename().string().starts_with('.');
}

constexpr std::string_view kSessionEnding = ".dibhr";
constexpr std::array<std::string_view, 3> kBagEndings{".mcap", ".db3", ".bag"};

/// Whether it is a ROS bag.
bool is_bag(const fs::path& file) {
    const std::string ending = lower_case(file.extension().string());
    return std::ranges::find(kBagEndings, ending) != kBagEndings.end();
}

FileKind kind_of(const fs::directory_entry& entry) {
    std::error_code unknown;
    if (entry.is_directory(unknown)) return FileKind::folder;
    const fs::path& file = entry.path();
    if (lower_case(file.extension().string()) == kSessionEnding) return FileKind::session;
    if (named_video(file) || is_bag(file)) return FileKind::video;
    if (names_touch_map(file)) return FileKind::other;  // a touch map painted on a recording
    return named_picture(file) ? FileKind::picture : FileKind::other;
}

FolderEntry described(const fs::directory_entry& entry) {
    FolderEntry row{.kind = kind_of(entry), .file = entry.path()};
    std::error_code unknown;
    if (row.kind != FileKind::folder) {
        const std::uintmax_t bytes = entry.file_size(unknown);
        row.bytes = unknown ? 0 : bytes;
    }
    const auto changed = entry.last_write_time(unknown);
    if (!unknown) row.changed = changed;
    return row;
}

bool comes_before(const FolderEntry& a, const FolderEntry& b) {
    const bool a_folder = a.kind == FileKind::folder;
    const bool b_folder = b.kind == FileKind::folder;
    if (a_folder != b_folder) return a_folder;
    return in_natural_order(lower_case(a.file.filename().string()),
                            lower_case(b.file.filename().string()));
}

bool is_film(const FolderEntry& entry) {
    return entry.kind == FileKind::video || entry.kind == FileKind::picture;
}

/// Moves each depth file into the entry of its colour file: same subject and same kind.
void join_pairs(std::vector<FolderEntry>& entries) {
    std::map<std::string, std::vector<FolderEntry*>> colours;
    for (FolderEntry& entry : entries) {
        const fs::path& file = entry.file;
        if (is_film(entry) && !named_depth(file) && (named_colour(file) || may_name_colour(file)))
            colours[subject_of(file)].push_back(&entry);
    }
    for (FolderEntry& entry : entries) {
        if (!is_film(entry) || !named_depth(entry.file)) continue;
        for (FolderEntry* const row : colours[subject_of(entry.file)]) {
            if (!row->depth.empty() || row->kind != entry.kind) continue;
            row->depth = std::exchange(entry.file, {});
            row->bytes += entry.bytes;
            break;
        }
    }
    std::erase_if(entries, [](const FolderEntry& entry) { return entry.file.empty(); });
}

std::string common_beginning(const std::string& a, const std::string& b) {
    return {a.begin(), std::ranges::mismatch(a, b).in1};
}

}  // namespace

const char* name_of(FileKind kind) noexcept {
    constexpr std::array kNames{"folder", "session", "video", "picture", "file"};
    static_assert(kNames.size() == static_cast<std::size_t>(FileKind::other) + 1);
    return kNames[static_cast<std::size_t>(kind)];
}

std::string FolderEntry::name() const {
    const std::string first = file.filename().string();
    if (kind == FileKind::folder) return first + "/";
    return depth.empty() ? first : first + " + " + depth.filename().string();
}

Folder read_folder(const fs::path& path) {
    Folder folder;
    folder.path = whole_path(path);
    std::error_code failed;
    if (!folder.path.has_filename() && folder.path.has_relative_path())
        folder.path = folder.path.parent_path();
    fs::directory_iterator entries(folder.path, fs::directory_options::skip_permission_denied,
                                   failed);
    for (; !failed && entries != fs::directory_iterator(); entries.increment(failed)) {
        if (!is_hidden(entries->path())) folder.entries.push_back(described(*entries));
    }
    if (failed) folder.trouble = shown(folder.path) + " cannot be read: " + failed.message();
    std::ranges::sort(folder.entries, comes_before);
    join_pairs(folder.entries);
    return folder;
}

std::vector<std::string> endings_that_open() {
    std::vector<std::string> endings{std::string(kSessionEnding)};
    endings.insert(endings.end(), video_endings().begin(), video_endings().end());
    endings.insert(endings.end(), kBagEndings.begin(), kBagEndings.end());
    endings.insert(endings.end(), picture_endings().begin(), picture_endings().end());
    return endings;
}

bool is_only_folder(const FolderEntry& entry) noexcept {
    return entry.kind == FileKind::folder && !entry.recording;
}

bool can_be_opened(const FolderEntry& entry) noexcept {
    return entry.kind != FileKind::other;
}

fs::path whole_path(const fs::path& file) {
    std::error_code unknown;
    const fs::path whole = fs::absolute(file, unknown);
    return (unknown ? file : whole).lexically_normal();
}

std::optional<FolderEntry> resolve_typed(const Folder& folder, const std::string& typed,
                                         const std::optional<FolderEntry>& chosen) {
    const fs::path named = expand_home(typed);
    if (is_live(named)) return FolderEntry{FileKind::video, named};
    for (const fs::path& place : {folder.path / named, whole_path(named)}) {
        std::error_code unknown;
        if (fs::is_directory(place, unknown) && !place.has_filename())
            return FolderEntry{FileKind::folder, place};
        const bool exists = fs::exists(place, unknown);
        if (unknown) return FolderEntry{FileKind::other, place};  // opening it says why
        if (!exists) continue;
        const auto known = index_of_entry(folder, place);
        if (!known && fs::is_directory(place, unknown)) return FolderEntry{FileKind::folder, place};
        return known ? folder.entries[*known] : FolderEntry{FileKind::other, place};
    }
    return chosen;
}

std::optional<std::size_t> index_of_entry(const Folder& folder, const fs::path& file) {
    const fs::path whole = whole_path(file);
    const auto holds = [&whole](const FolderEntry& entry) {
        return entry.file == whole || entry.depth == whole;
    };
    const auto found = std::ranges::find_if(folder.entries, holds);
    if (found == folder.entries.end()) return std::nullopt;
    return static_cast<std::size_t>(found - folder.entries.begin());
}

std::string completed(const std::string& typed, const fs::path& folder) {
    const std::size_t slash = typed.rfind('/');
    const std::string before = slash == std::string::npos ? "" : typed.substr(0, slash + 1);
    const std::string begun = typed.substr(before.size());
    const fs::path place = before.empty() ? folder : folder / expand_home(before);
    std::error_code failed;
    std::optional<std::string> all;
    for (fs::directory_iterator entries(place, failed);
         !failed && entries != fs::directory_iterator(); entries.increment(failed)) {
        const fs::path& file = entries->path();
        std::string name = file.filename().string();
        if (!name.starts_with(begun) || (begun.empty() && is_hidden(file))) continue;
        std::error_code unknown;
        if (entries->is_directory(unknown)) name += '/';
        all = all ? common_beginning(*all, name) : name;
    }
    return all && all->size() > begun.size() ? before + *all : typed;
}

}  // namespace dibhr
