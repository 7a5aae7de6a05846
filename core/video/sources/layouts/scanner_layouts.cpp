// A table of layouts, and the comparison of a folder with it.
#include "core/video/sources/layouts/scanner_layouts.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/names.hpp"
#include "core/video/formats/camera_files.hpp"
#include "core/video/sources/layouts/picture_pattern.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// One layout. Places are in the exported folder: a file, a folder, or a pattern with a number.
/// Depth is in millimetres, in 16 bits, 0 where there is none, and seen through the colour camera.
struct ScannerLayout {
    std::string_view name;
    std::string_view colour;
    std::string_view depth;
    std::string_view sign;    ///< has to be there, too; empty: nothing
    std::string_view camera;  ///< of the colour pictures; of several the first
    std::optional<CameraFile> (*read_camera)(const fs::path& file);
    int camera_columns, camera_rows;  ///< size of its pictures, where the file does not state it
};

// docs/format.md of github.com/strayrobots/scanner; README.md of github.com/PolyCam/polyform; "All
// Data" of 3dscannerapp.com, as its readers describe it; DATA.md of github.com/apple/ARKitScenes.
constexpr std::array kLayouts{
    ScannerLayout{"Stray Scanner", "rgb.mp4", "depth", "odometry.csv", "camera_matrix.csv",
                  read_camera_matrix, 1920, 1440},
    ScannerLayout{"Polycam", "keyframes/images", "keyframes/depth", "keyframes/cameras",
                  "keyframes/cameras", read_camera_json, 0, 0},
    ScannerLayout{"Polycam", "images", "depth", "corrected_cameras", "cameras", read_camera_json, 0,
                  0},
    ScannerLayout{"3D Scanner App", "frame_%05d.jpg", "depth_%05d.png", "info.json",
                  "frame_%05d.json", read_camera_json, 1920, 1440},
    ScannerLayout{"ARKitScenes", "lowres_wide", "lowres_depth", "", "lowres_wide_intrinsics",
                  read_camera_pincam, 0, 0},
    ScannerLayout{"ARKitScenes", "wide", "highres_depth", "", "wide_intrinsics", read_camera_pincam,
                  0, 0}};

/// The files of a place of a layout; none where it is missing.
std::vector<fs::path> files_of(const fs::path& folder, std::string_view place) {
    std::vector<fs::path> files;
    const fs::path found = folder / place;
    if (is_file(found)) return {found};
    const bool is_pattern = place.find('%') != std::string_view::npos;
    if (!is_pattern && !is_folder(found)) return files;
    for (const fs::path& entry : entries_of(is_pattern ? folder : found)) {
        const bool fits = is_pattern ? fits_number_pattern(entry, std::string(place))
                                     : !entry.filename().string().starts_with('.');
        if (fits && is_file(entry)) files.push_back(entry);
    }
    return files;
}

PictureRow row_in(const fs::path& folder, std::string_view place) {
    PictureRow row;
    for (const fs::path& file : files_of(folder, place))
        if (is_picture(file)) row.push_back(numbered(file));
    sort_by_number(row);
    return row;
}

/// Whether the camera's centre is near the middle of the layout's usual pictures: who makes them
/// smaller has smaller cameras.
bool may_see(const Intrinsics& camera, const ScannerLayout& layout) {
    const auto is_middle = [](double centre, int side) {
        return centre > 0.3 * side && centre < 0.7 * side;
    };
    return is_middle(camera.cx, layout.camera_columns) && is_middle(camera.cy, layout.camera_rows);
}

LayoutFacts facts_in(const fs::path& folder, const ScannerLayout& layout) {
    LayoutFacts facts;
    facts.finding.statement = {.unit = DepthUnit::mm, .scale = 1.0, .no_data = std::vector{0.0}};
    facts.finding.reason = std::string(layout.name) + "'s folders";
    const std::vector<fs::path> cameras = files_of(folder, layout.camera);
    const auto camera = cameras.empty() ? std::nullopt : layout.read_camera(cameras.front());
    if (!camera) return facts;
    facts.finding.statement.intrinsics = camera->intrinsics;
    if (camera->columns > 0 && camera->rows > 0) {
        facts.columns = camera->columns;
        facts.rows = camera->rows;
    } else if (may_see(camera->intrinsics, layout)) {
        facts.columns = layout.camera_columns;
        facts.rows = layout.camera_rows;
    }
    return facts;
}

std::optional<ScannerFolder> as_laid_out(const fs::path& folder, const ScannerLayout& layout) {
    if (!layout.sign.empty() && files_of(folder, layout.sign).empty()) return std::nullopt;
    ScannerFolder found;
    found.pictures.depth = row_in(folder, layout.depth);
    if (found.pictures.depth.empty()) return std::nullopt;
    found.depth_place = found.pictures.depth.front().file.parent_path();
    if (named_video(fs::path(layout.colour)))
        found.film = files_of(folder, layout.colour).empty() ? fs::path() : folder / layout.colour;
    else
        found.pictures.colour = row_in(folder, layout.colour);
    if (found.film.empty() && found.pictures.colour.empty()) return std::nullopt;
    found.pictures.facts = facts_in(folder, layout);
    return found;
}

}  // namespace

std::optional<ScannerFolder> scanner_folder(const fs::path& folder) {
    if (!is_folder(folder)) return std::nullopt;
    for (const ScannerLayout& layout : kLayouts)
        if (auto found = as_laid_out(folder, layout)) return found;
    return std::nullopt;
}

LayoutFacts scanner_facts(const fs::path& depth_folder) {
    const fs::path own = depth_folder.has_filename() ? depth_folder : depth_folder.parent_path();
    const fs::path parent = own.has_parent_path() ? own.parent_path() : fs::path(".");
    const auto found = scanner_folder(parent);
    return found && found->depth_place.filename() == own.filename() ? found->pictures.facts
                                                                    : LayoutFacts{};
}

}  // namespace dibhr
