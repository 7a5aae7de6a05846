// Decides by names; reads no files but lists, camera intrinsics, and pictures that may be
// paintings.
#include "core/video/sources/layouts/layouts.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/layouts/data_sets.hpp"
#include "core/video/sources/layouts/picture_lists.hpp"
#include "core/video/sources/layouts/picture_pattern.hpp"
#include "core/video/sources/layouts/picture_times.hpp"
#include "core/video/sources/layouts/scanner_layouts.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Of a layout that the names of folders alone show.
constexpr double kSurenessOfFolderNames = 0.95;

LayoutFacts millimetres(std::vector<double> no_data, std::string reason) {
    LayoutFacts facts;
    facts.finding.statement = {.unit = DepthUnit::mm, .scale = 1.0, .no_data = std::move(no_data)};
    facts.finding.reason = std::move(reason);
    return facts;
}

void take_camera(const CameraFile& camera, LayoutFacts& facts) {
    facts.finding.statement.intrinsics = camera.intrinsics;
    facts.columns = camera.columns;
    facts.rows = camera.rows;
    if (camera.levels_per_m) facts.finding.statement.scale = 1000.0 / *camera.levels_per_m;
}

bool all_match(const PictureRow& row, const std::string& pattern) {
    return !row.empty() &&
           std::all_of(row.begin(), row.end(), [&pattern](const NumberedPicture& picture) {
               return fits_number_pattern(picture.file, pattern);
           });
}

/// 7-Scenes, and tsdf-fusion, whose pictures of colour are JPEG and whose camera is in a file:
/// microsoft.com/en-us/research/project/rgb-d-dataset-7-scenes, github.com/andyzeng/tsdf-fusion.
std::optional<LayoutFacts> facts_of_7_scenes(const fs::path& folder, const PictureSet& set) {
    if (!all_match(set.depth, "frame-%06d.depth.png")) return std::nullopt;
    const bool is_7_scenes = all_match(set.colour, "frame-%06d.color.png");
    LayoutFacts facts =
        millimetres({0.0, 65535.0}, is_7_scenes ? "7-Scenes names" : "tsdf-fusion names");
    for (const fs::path& place : {folder, folder.parent_path()}) {
        const auto camera = read_camera_matrix(place / "camera-intrinsics.txt");
        if (camera && !facts.finding.statement.intrinsics) take_camera(*camera, facts);
    }
    if (is_7_scenes && !facts.finding.statement.intrinsics)
        take_camera({{585.0, 585.0, 320.0, 240.0}, 640, 480, {}}, facts);
    facts.other_camera = is_7_scenes;  // "the RGB and depth camera have not been calibrated"
    return facts;
}

std::string folder_name(const PictureRow& row) {
    return lower_case(row.front().file.parent_path().filename().string());
}

std::optional<CameraFile> open3d_camera(const fs::path& folder) {
    for (const char* const name :
         {"camera_intrinsic.json", "camera_intrinsics.json", "intrinsic.json"}) {
        if (auto camera = read_camera_json(folder / name)) return camera;
    }
    return std::nullopt;
}

/// Folders of colour and of depth: ScanNet's with its camera, Open3D's with its camera or its
/// names (github.com/ScanNet/ScanNet, www.open3d.org/docs: reconstruction system). `rgb` beside
/// `depth` says nothing: TUM and others of other scales have it, too.
std::optional<LayoutFacts> facts_of_folders(const fs::path& folder, const PictureSet& set) {
    if (set.depth.empty() || folder_name(set.depth) != "depth") return std::nullopt;
    if (const auto camera = read_camera_matrix(folder / "intrinsic" / "intrinsic_depth.txt")) {
        LayoutFacts facts = millimetres({0.0}, "ScanNet's folders");
        take_camera(*camera, facts);
        return facts;
    }
    const auto camera = open3d_camera(folder);
    const std::string colour = set.colour.empty() ? "" : folder_name(set.colour);
    if (!camera && colour != "color" && colour != "image") return std::nullopt;
    LayoutFacts facts = millimetres({0.0}, "folders as Open3D has them");
    if (camera) {
        take_camera(*camera, facts);
    } else {
        facts.finding.sureness = kSurenessOfFolderNames;
        facts.finding.usual = {"a room in such folders", 0.02, 20.0};
    }
    return facts;
}

LayoutFacts facts_of(const fs::path& folder, const PictureSet& set) {
    if (auto facts = facts_of_7_scenes(folder, set)) return *facts;
    if (auto facts = facts_of_folders(folder, set)) return *facts;
    return scanner_facts(folder);
}

/// The name that states depth or colour: the file's own, else that of its folder.
fs::path role_name_of(const fs::path& place) {
    const fs::path own = without_slash(place);
    return named_depth(own) || named_colour(own) ? own : own.parent_path();
}

bool are_swapped(const fs::path& colour, const fs::path& depth) {
    const fs::path first = role_name_of(colour);
    const fs::path second = role_name_of(depth);
    return named_depth(first) && !named_colour(first) && named_colour(second) &&
           !named_depth(second);
}

/// Empty where the folder has a list of pictures.
std::vector<fs::path> videos_in(const fs::path& folder) {
    std::vector<fs::path> videos;
    if (is_picture_list(folder / "depth.txt") || is_picture_list(folder / "associations.txt"))
        return videos;
    for (const fs::path& entry : entries_of(folder)) {
        if (named_video(entry) && !entry.filename().string().starts_with('.') && is_file(entry))
            videos.push_back(entry);
    }
    return videos;
}

/// The colour video of a depth video, preferably one named colour; null: none.
const fs::path* colour_beside(const fs::path& depth, const std::vector<fs::path>& videos) {
    const std::string subject = subject_of(depth);
    const fs::path* found = nullptr;
    for (const fs::path& video : videos) {
        if (named_depth(video) || subject_of(video) != subject) continue;
        if (found == nullptr || (named_colour(video) && !named_colour(*found))) found = &video;
    }
    return found;
}

bool holds_both(const PictureSet& pictures) {
    return !pictures.colour.empty() && !pictures.depth.empty();
}

/// Videos and the pictures or arrays of the other role that belong to them, in a folder or beside
/// them; none where the pictures are colour and depth already.
std::vector<MediaPlaces> pairs_with_pictures(const fs::path& folder,
                                             const std::vector<fs::path>& videos) {
    std::vector<MediaPlaces> pairs;
    if (videos.empty()) return pairs;
    const PictureSet pictures = find_pictures_in(folder);
    if (holds_both(pictures)) return pairs;
    std::string ignored;
    for (const fs::path& video : videos) {
        if (!named_other(video).empty()) continue;
        const bool is_depth = named_depth(video);
        auto other = is_depth ? find_colour_beside(video) : find_depth_beside(video, ignored);
        if (!other && !is_depth && videos.size() == 1 && pictures.depth.size() > 1) other = folder;
        const bool is_row = other && (is_folder(*other) || (!is_depth && named_numbers(*other)));
        if (!is_row) continue;
        pairs.push_back(is_depth ? MediaPlaces{*other, video, {}} : MediaPlaces{video, *other, {}});
    }
    return pairs;
}

/// In natural order. A single video named colour and a single one named depth are always a pair.
std::vector<MediaPlaces> pairs_of(const fs::path& folder, const std::vector<fs::path>& videos) {
    std::vector<MediaPlaces> pairs;
    std::vector<fs::path> colours;
    std::vector<fs::path> depths;
    for (const fs::path& video : videos) {
        if (named_depth(video))
            depths.push_back(video);
        else if (named_colour(video))
            colours.push_back(video);
    }
    for (const fs::path& depth : depths) {
        if (const fs::path* const colour = colour_beside(depth, videos))
            pairs.push_back({*colour, depth, {}});
    }
    if (pairs.empty() && colours.size() == 1 && depths.size() == 1)
        pairs.push_back({colours.front(), depths.front(), {}});
    if (pairs.empty()) pairs = pairs_with_pictures(folder, videos);
    std::stable_sort(pairs.begin(), pairs.end(), [](const MediaPlaces& a, const MediaPlaces& b) {
        return in_natural_order(a.colour.filename().string(), b.colour.filename().string());
    });
    return pairs;
}

std::string pair_text(const MediaPlaces& pair) {
    return shown(pair.colour.filename()) + " with " + shown(pair.depth.filename());
}

std::string others_of(const std::vector<MediaPlaces>& pairs) {
    constexpr std::size_t kMostNamed = 3;
    if (pairs.size() < 2) return {};
    std::string said = "opened " + pair_text(pairs.front()) + "; the folder also holds ";
    for (std::size_t k = 1; k < std::min(pairs.size(), kMostNamed + 1); ++k)
        said += (k > 1 ? ", " : "") + pair_text(pairs[k]);
    const std::size_t unnamed = pairs.size() - std::min(pairs.size(), kMostNamed + 1);
    return said + (unnamed > 0 ? " and " + std::to_string(unnamed) + " more pairs" : "");
}

/// Whether the folder holds these videos and no pictures but previews and a single cover; nor
/// pictures of both roles in folders of their own.
bool is_of_videos(const fs::path& folder, const std::vector<fs::path>& videos) {
    if (videos.empty() || holds_both(find_pictures_in(folder))) return false;
    int covers = 0;
    for (const fs::path& entry : entries_of(folder)) {
        if (!is_picture(entry) || !named_other(entry).empty()) continue;
        if (named_depth(entry) || named_colour(entry) || ++covers > 1) return false;
    }
    return true;
}

/// The numbers beside a picture of depth that only paints them; empty: it is to be opened itself.
fs::path numbers_painted_by(const fs::path& file) {
    const bool may_paint = named_depth(file) && named_picture(file) && !named_numbers(file);
    const auto numbers = may_paint ? numbers_beside(file) : std::nullopt;
    return numbers && is_painting(file) ? *numbers : fs::path();
}

std::string painting_text(const fs::path& numbers, const fs::path& painting) {
    return "opened " + shown(numbers.filename()) + ", the numbers that " +
           shown(painting.filename()) + " paints";
}

/// Pictures of one role, and the place where they were found.
struct PlacedRow {
    fs::path place{};
    PictureRow pictures{};
    LayoutFacts said{};
};

std::unique_ptr<PictureSource> sequence(const PlacedRow& row, const PictureRow& other,
                                        PictureRole role) {
    return std::make_unique<PictureSequence>(
        row.place, row.pictures, times_s(row.pictures, other, kPicturesPerSecond), role, row.said,
        timing_of(row.pictures, other, row.said.list));
}

/// Whether a folder has files that are read, or are of a form that has to be converted.
bool holds_media(const fs::path& folder) {
    constexpr int kMostRead = 20;  // files whose bytes are looked at
    int read = 0;
    for (const fs::path& entry : entries_of(folder)) {
        if (is_picture(entry) || (named_video(entry) && is_file(entry))) return true;
        if (is_file(entry) && read++ < kMostRead && !advice_on_form(entry).empty()) return true;
    }
    return false;
}

/// The folders below that hold media, all at the first level that has any.
std::vector<fs::path> folders_of_media(const fs::path& folder) {
    constexpr int kMostLevels = 3;
    constexpr std::size_t kMostFolders = 200;
    std::vector<fs::path> level{folder};
    std::vector<fs::path> found;
    for (int k = 0; k < kMostLevels && found.empty(); ++k) {
        std::vector<fs::path> below;
        for (const fs::path& above : level) {
            try {
                for (const fs::path& entry : entries_of(above)) {
                    if (!is_folder(entry) || entry.filename().string().starts_with('.')) continue;
                    if (below.size() == kMostFolders) break;
                    below.push_back(entry);
                    if (holds_media(entry)) found.push_back(entry);
                }
            } catch (const InputError&) {
                continue;  // it may not be read
            }
        }
        level = std::move(below);
    }
    return found;
}

/// The advice on a file as one on all files of its ending: its command of Python in a loop of the
/// shell, which saves each under a name of its own. Empty where it has no such command.
std::string advice_on_each(std::string advice, const fs::path& file) {
    const std::string ending = file.extension().string();
    const auto begin = advice.find("python3 -c \"");
    if (begin == std::string::npos || ending.size() < 2 || !is_bare_name(ending.substr(1)))
        return {};
    const auto end = advice.find('"', advice.find('"', begin) + 1) + 1;
    std::string command = advice.substr(begin, end - begin);
    const auto replace = [&command](const std::string& part, const std::string& by) {
        const auto at = command.find(part);
        if (at != std::string::npos) command.replace(at, part.size(), by);
        return at != std::string::npos;
    };
    if (!replace("'" + file.filename().string() + "'", "'$f'")) return {};
    if (!replace("'depth.npy'", "'${f%.*}_depth.npy'") &&
        !replace("'height.npy'", "'${f%.*}_height.npy'"))
        return {};
    advice.replace(begin, end - begin, "for f in *" + ending + "; do " + command + "; done");
    constexpr std::string_view kThat = "and give that";
    if (const auto at = advice.find(kThat); at != std::string::npos)
        advice.replace(at, kThat.size(), "and give the folder");
    return advice;
}

/// What a folder without pictures holds instead, and what to do, after the words "is a folder
/// without pictures".
std::string advice_without_pictures(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    for (const fs::path& entry : entries) {
        const bool may_be_depth = is_file(entry) && !named_picture(entry) && !named_video(entry) &&
                                  !entry.filename().string().starts_with('.');
        const std::string advice = may_be_depth ? advice_on_form(entry) : std::string();
        if (advice.empty()) continue;
        const auto alike = std::count_if(
            entries.begin(), entries.end(),
            [&](const fs::path& other) { return other.extension() == entry.extension(); });
        const std::string each = alike > 1 ? advice_on_each(advice, entry) : std::string();
        if (!each.empty()) return " that are read: " + shown(entry.filename()) + " in it" + each;
        return " that are read: " + shown(entry.filename()) + " in it" + advice +
               (alike > 1 ? " (likewise the others, each under a name of its own)" : "");
    }
    constexpr std::size_t kMostNamed = 4;
    const std::vector<fs::path> folders = folders_of_media(folder);
    if (folders.empty()) return ": give the folder or the file that holds them";
    if (folders.size() == 1)
        return " of its own: give " + shown(folders.front()) + ", which is in it";
    std::vector<std::string> names;
    for (std::size_t k = 0; k < std::min(folders.size(), kMostNamed); ++k)
        names.push_back(shown(folders[k].lexically_relative(folder)));
    if (folders.size() > kMostNamed)
        names.push_back(std::to_string(folders.size() - kMostNamed) + " more");
    return " of its own, and its folders " + listed(names) +
           " are not named colour and depth: give the colour folder first and then the depth "
           "folder";
}

/// The pictures of that role, or those whose names state no role. Throws InputError when there are
/// none.
PlacedRow row_of(const fs::path& place, PictureRole role) {
    PictureSet found = pictures_at(place);
    const bool is_depth = role == PictureRole::depth;
    PictureRow& named = is_depth ? found.depth : found.colour;
    PictureRow& row = named.empty() ? found.unnamed : named;
    const bool has_others = !found.colour.empty() || !found.depth.empty();
    const std::string kind = !has_others ? "" : is_depth ? "depth " : "colour ";
    if (row.empty() && !has_others && is_folder(place))
        throw InputError(shown(place) + " is a folder without pictures" +
                         advice_without_pictures(place));
    if (row.empty())
        throw InputError(shown(place) + (is_folder(place) ? " is a folder" : " is a list") +
                         " without " + kind +
                         "pictures: give the folder or the file that holds them");
    return {place, std::move(row), std::move(found.facts)};
}

Sources pair_of(const PlacedRow& colour, const PlacedRow& depth) {
    return {sequence(depth, colour.pictures, PictureRole::depth),
            sequence(colour, depth.pictures, PictureRole::colour)};
}

}  // namespace

bool names_pictures(const fs::path& place) {
    return is_folder(place) || is_picture_pattern(place) || is_picture_list(place);
}

PictureSet pictures_at(const fs::path& place) {
    if (is_picture_pattern(place)) return pictures_of_pattern(place);
    if (!is_folder(place)) return read_picture_list(place);
    if (auto listed = read_lists_in(place)) return std::move(*listed);
    if (auto scanned = scanner_folder(place)) return std::move(scanned->pictures);
    PictureSet found = find_pictures_in(place);
    const fs::path folder = without_slash(place);
    LayoutFacts facts = facts_of(folder, found);
    add_clause(facts.notice, found.facts.notice);
    found.facts = std::move(facts);
    return found;
}

std::unique_ptr<PictureSource> open_row(const fs::path& place, PictureRole role) {
    return sequence(row_of(place, role), {}, role);
}

Sources both_rows(const fs::path& place) {
    PictureSet found = pictures_at(place);
    if (!holds_both(found)) return {};
    const LayoutFacts of_colour{.list = found.facts.list};
    return pair_of({place, std::move(found.colour), of_colour},
                   {place, std::move(found.depth), std::move(found.facts)});
}

Sources rows_of_two(const fs::path& colour, const fs::path& depth) {
    return pair_of(row_of(colour, PictureRole::colour), row_of(depth, PictureRole::depth));
}

void add_camera_beside(Sources& sources) {
    const SourceFacts& facts = sources.depth->facts();
    if (facts.live || facts.cameras) return;
    Findings rows = facts.findings;
    rows.insert(rows.end(), sources.findings.begin(), sources.findings.end());
    const auto& set = sources.data_set.of(facts);
    if (set) rows.push_back(set->finding);
    const DepthStatement known = sure_facts({}, rows);
    const bool is_row = !facts.first_picture.empty();
    const fs::path& picture = facts.picture();
    std::error_code failed;
    const fs::path folder = fs::absolute(picture, failed).parent_path();
    const bool has_own = set && set->camera && is_camera(set->camera->intrinsics);
    const auto beside = has_own
                            ? std::optional(CameraBeside{.camera = *set->camera})
                            : read_camera_beside(picture, is_row || named_depth(folder.filename()),
                                                 number_in_name(picture));
    if (!beside) return;
    DepthStatement said;
    const CameraFile& camera = beside->camera;
    if (beside->has_intrinsics && !known.intrinsics) {
        const FittedCamera fitted = fit_camera(camera.intrinsics, {camera.columns, camera.rows},
                                               {facts.columns, facts.rows});
        said.intrinsics = fitted.camera;
        add_clause(sources.notice, fitted.notice);
    }
    if (camera.levels_per_m && facts.bits == 16 && !known.unit) {
        said.unit = DepthUnit::mm;
        said.scale = one_in_mm(DepthUnit::m) / *camera.levels_per_m;
    }
    if (said == DepthStatement{}) return;
    sources.findings.push_back(
        has_own ? Finding{said, Evidence::layout, set->finding.sureness, set->finding.reason}
                : finding_of_metadata(said, shown(beside->file.filename())));
}

MediaPlaces places_for(const fs::path& colour, const fs::path& depth) {
    if (are_swapped(colour, depth))
        return {depth, colour,
                "taken by their names: " + shown(depth.filename()) + " as colour, " +
                    shown(colour.filename()) + " as depth"};
    const fs::path& painting = depth.empty() ? colour : depth;
    if (const fs::path numbers = numbers_painted_by(painting); !numbers.empty())
        return {depth.empty() ? numbers : colour, depth.empty() ? fs::path() : numbers,
                painting_text(numbers, painting)};
    if (!is_folder(colour) || (!depth.empty() && depth != colour)) return {colour, depth, {}};
    if (const auto scanned = scanner_folder(colour))
        return scanned->film.empty() ? MediaPlaces{colour, depth, {}}
                                     : MediaPlaces{scanned->film, scanned->depth_place, {}};
    const std::vector<fs::path> videos = videos_in(colour);
    const std::vector<MediaPlaces> pairs = pairs_of(colour, videos);
    if (!pairs.empty()) return {pairs.front().colour, pairs.front().depth, others_of(pairs)};
    if (videos.size() == 1 && is_of_videos(colour, videos)) return {videos.front(), {}, {}};
    return {colour, depth, {}};
}

fs::path depth_place_for(const fs::path& place) {
    if (!is_folder(place)) {
        const fs::path numbers = numbers_painted_by(place);
        return numbers.empty() ? place : numbers;
    }
    if (const auto scanned = scanner_folder(place))
        return scanned->film.empty() ? place : scanned->depth_place;
    const std::vector<fs::path> videos = videos_in(place);
    const std::vector<MediaPlaces> pairs = pairs_of(place, videos);
    if (!pairs.empty()) return pairs.front().depth;
    if (!is_of_videos(place, videos)) return place;
    const auto depth = std::find_if(videos.begin(), videos.end(), named_depth);
    if (depth != videos.end()) return *depth;
    return videos.size() == 1 ? videos.front() : place;
}

}  // namespace dibhr
