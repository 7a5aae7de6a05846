// What a surface is made of, as it is felt and heard: a small TOML file beside the bump map it
// names. Some come with the program, others a person saved.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// Lengths in millimetres, so that it feels the same on pictures of all sizes.
struct Material {
    std::string name{};                      ///< "bark"; empty: as recorded, nothing is laid over
    std::filesystem::path map{};             ///< a grey picture; empty: as smooth as the surface
    std::shared_ptr<const BumpMap> bumps{};  ///< what it holds
    double width_mm{20.0};                   ///< of the map, which repeats
    double height_mm{0.0};                   ///< of its highest point over its lowest
    Friction friction{};
    double stiffness_newton_per_mm{Coupling{}.stiffness_newton_per_mm};
    double damping_newton_s_per_m{Coupling{}.damping_newton_s_per_m};
    SoundMaterial sound{};
};

/// What `--material` and the panel call the surface as it is.
inline constexpr std::string_view kAsRecorded = "as-recorded";

/// Roughness and size of the map [px] on a surface of parameters.coupling.pixel_pitch_mm. Where
/// that is coarser than half the map, the map is laid larger than it is: its bumps would fall
/// between the pixels.
void lay_texture(const Material& material, TouchParameters& parameters);

/// All that a material says of a touch.
void lay(const Material& material, TouchParameters& parameters);

/// Whether roughness and size are as lay_texture() has them.
[[nodiscard]] bool has_texture(const Material& material, const TouchParameters& parameters);

/// Whether all is as lay() has it.
[[nodiscard]] bool is_made_of(const Material& material, const TouchParameters& parameters);

/// What these parameters and a bump map (a file, or none) are together on a surface of so many
/// columns, to be kept.
[[nodiscard]] Material material_of(const TouchParameters& parameters,
                                   const std::filesystem::path& map,
                                   std::shared_ptr<const BumpMap> bumps, int columns);

/// With its map. Throws InputError that names the file and, where it can, the line.
[[nodiscard]] Material read_material(const std::filesystem::path& file);

/// One of a person's own or, if none has the name, of those that come with the program; a file
/// that ends in .toml; or kAsRecorded. Throws InputError that names those there are.
[[nodiscard]] Material material_called(const std::string& name);

/// Of those that come with the program, and of a person's own.
struct MaterialNames {
    std::vector<std::string> shipped{};
    std::vector<std::string> own{};
};
[[nodiscard]] MaterialNames material_names();
/// "as-recorded, bark, ice": all that material_called() knows.
[[nodiscard]] std::string list_of_materials();

/// The folder materials/ beside the settings file, of a person's own.
[[nodiscard]] std::filesystem::path own_materials_folder();

/// Writes the material and, beside it, its map, in place of what had its name. Gives the file.
/// Throws InputError when that is no name for a file or one that comes with the program, or it
/// cannot be written.
std::filesystem::path save_material(const Material& material);

}  // namespace dibhr
