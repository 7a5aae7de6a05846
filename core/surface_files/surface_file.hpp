// Writes the touched surface as a file: numbers for programs, a relief, a mesh and a solid plate
// for other tools and machines.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/files/output_file.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// How a surface is written, row by row, a value or a corner for every VERTEX:
/// pfm: its elevation [px], 32-bit real numbers;
/// png: a grey relief of 16 bits, from 0 on the ground to 65535 at the surface's ceiling; a text
///      in the file states ceiling and pitch;
/// ply: the mesh that is touched [mm], x to the right, y up, z to the viewer, with its colours;
/// stl: a plate of 2 mm with the mesh on it [mm], closed, for a printer or a mill.
enum class SurfaceFormat { pfm, png, ply, stl };

inline constexpr SurfaceFormat kSurfaceFormats[]{SurfaceFormat::pfm, SurfaceFormat::png,
                                                 SurfaceFormat::ply, SurfaceFormat::stl};

/// "pfm": a file's ending without the dot.
[[nodiscard]] std::string_view name_of(SurfaceFormat format) noexcept;

/// By the ending of the name, in small or capital letters; nothing for another one.
[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(const std::filesystem::path& file);

/// Thickness of an STL file's plate under the lowest place of the surface [mm].
inline constexpr double kPlate_mm = 2.0;

/// The surface to write. A place without a finite elevation is written as ground, 0 px.
struct ExportedSurface {
    DepthSurface surface;
    double pixel_pitch_mm;
    const ColourImage* colour{nullptr};  ///< of the whole surface, any size; null, empty: none
};

struct ElevationRange {
    double lowest_px{0.0};
    double highest_px{0.0};
};

/// The lowest and the highest written elevation.
[[nodiscard]] ElevationRange elevation_range(const DepthSurface& surface);

/// Writes all of it; the caller commits the file. Holds a few rows in memory. Throws InputError.
void write_surface(const ExportedSurface& exported, SurfaceFormat format, OutputFile& file);

}  // namespace dibhr
