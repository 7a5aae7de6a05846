// Chooses the form by the name, and writes elevations as plain numbers.
#include "core/surface_files/surface_file.hpp"

#include <algorithm>
#include <string>

#include "core/files/plain_text.hpp"
#include "core/surface_files/pieces.hpp"

namespace dibhr {

namespace {

struct Form {
    std::string_view name;
    void (*write)(const ExportedSurface&, OutputFile&);
};

/// In the order of SurfaceFormat.
constexpr Form kForms[]{
    {"pfm", write_pfm}, {"png", write_relief_png}, {"ply", write_ply}, {"stl", write_stl}};

const Form& form_of(SurfaceFormat format) noexcept {
    return kForms[static_cast<std::size_t>(format)];
}

}  // namespace

std::string_view name_of(SurfaceFormat format) noexcept {
    return form_of(format).name;
}

std::optional<SurfaceFormat> surface_format_of(const std::filesystem::path& file) {
    const std::string ending = lower_case(file.extension().string());
    for (const SurfaceFormat format : kSurfaceFormats) {
        if (ending == "." + std::string(name_of(format))) return format;
    }
    return std::nullopt;
}

ElevationRange elevation_range(const DepthSurface& surface) {
    const double first = written_px(surface, 0, 0);
    ElevationRange range{first, first};
    for (int j = 0; j < surface.rows(); ++j) {
        for (int i = 0; i < surface.columns(); ++i) {
            const double elevation = written_px(surface, i, j);
            range.lowest_px = std::min(range.lowest_px, elevation);
            range.highest_px = std::max(range.highest_px, elevation);
        }
    }
    return range;
}

/// The lowest row comes first; a negative scale means little-endian.
void write_pfm(const ExportedSurface& exported, OutputFile& file) {
    const DepthSurface& surface = exported.surface;
    Pieces pieces(file);
    pieces.add("Pf\n" + std::to_string(surface.columns()) + ' ' + std::to_string(surface.rows()) +
               "\n-1.0\n");
    for (int j = surface.rows() - 1; j >= 0; --j) {
        for (int i = 0; i < surface.columns(); ++i) {
            pieces.add(static_cast<float>(written_px(surface, i, j)));
        }
    }
    pieces.send();
}

void write_surface(const ExportedSurface& exported, SurfaceFormat format, OutputFile& file) {
    form_of(format).write(exported, file);
}

}  // namespace dibhr
