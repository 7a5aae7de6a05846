// Materials: friction, stiffness, texture, sound and look of a surface, in a small TOML file beside
// its bump map. Some come with the program, others are the user's.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"
#include "core/sound/touch_sound.hpp"
#include "render/surface_look.hpp"

namespace dibhr {

/// Lengths are millimetres, so that a material feels the same on pictures of all sizes.
struct Material {
    std::string name{};                      ///< "bark"; empty: the surface as recorded
    std::filesystem::path map{};             ///< the bump map's file, a grey picture; empty: none
    std::shared_ptr<const BumpMap> bumps{};  ///< content of `map`
    double width_mm{20.0};                   ///< of the map, which repeats
    double height_mm{0.0};                   ///< of its highest point over its lowest
    Friction friction{};
    double stiffness_newton_per_mm{Coupling{}.stiffness_newton_per_mm};
    double damping_newton_s_per_m{Coupling{}.damping_newton_s_per_m};
    SoundMaterial sound{};
    SurfaceLook look{};
};

/// The name of "no material" for `--material` and the panel.
inline constexpr std::string_view kAsRecorded = "as-recorded";

/// Sets roughness and size of the bump map [px] for parameters.coupling.pixel_pitch_mm. Where that
/// is coarser than two pixels of the map, the map is laid larger, so that no bump falls between
/// the pixels.
void lay_texture(const Material& material, TouchParameters& parameters);

/// Sets all parameters that the material defines.
void apply_material(const Material& material, TouchParameters& parameters);

/// Whether roughness and size are those of lay_texture().
[[nodiscard]] bool has_texture(const Material& material, const TouchParameters& parameters);

/// Whether all parameters of the material are unchanged.
[[nodiscard]] bool is_made_of(const Material& material, const TouchParameters& parameters);

/// The material, to be saved, of these parameters and a bump map (a file, or none) on a surface of
/// that many columns.
[[nodiscard]] Material material_of(const TouchParameters& parameters,
                                   const std::filesystem::path& map,
                                   std::shared_ptr<const BumpMap> bumps, int columns);

/// Reads a material and its map. Throws InputError that names the file and, where known, the line.
[[nodiscard]] Material read_material(const std::filesystem::path& file);

/// The user's material of that name, else the program's; or a file that ends in .toml; or
/// kAsRecorded. Throws InputError that lists the existing ones.
[[nodiscard]] Material material_named(const std::string& name);

/// Names of the program's materials and of the user's own.
struct MaterialNames {
    std::vector<std::string> shipped{};
    std::vector<std::string> own{};
};
[[nodiscard]] MaterialNames material_names();
/// as-recorded, bark, ice: all that material_named() knows.
[[nodiscard]] std::vector<std::string> names_of_materials();

/// The folder of the user's own materials: materials/ beside the settings file.
[[nodiscard]] std::filesystem::path own_materials_folder();

/// Writes the material and, beside it, its map; replaces one of the same name. Returns the file.
/// Throws InputError when the name is no file name or is one of the program's, or writing fails.
std::filesystem::path save_material(const Material& material);

}  // namespace dibhr
