// Reads, finds and saves materials.
#include "app/settings/material.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "app/settings/settings.hpp"
#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/files/text_file.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr const char* kEnding = ".toml";
constexpr std::size_t kLongestName = 60;

/// A number of the file, and its place in the material.
struct Property {
    std::string_view name;
    double lowest;
    double highest;
    double& (*in)(Material&);
    std::string_view unit;
};

double highest_of(std::string_view number) {
    return touch_number(number)->highest;
}

const std::array<Property, 14>& properties() {
    static const std::array<Property, 14> all{{
        {"width", 0.1, 1000.0, [](Material& m) -> double& { return m.width_mm; },
         "mm of the map, which repeats"},
        {"height", 0.0, 50.0, [](Material& m) -> double& { return m.height_mm; },
         "mm from its lowest to its highest point"},
        {"static-friction", 0.0, highest_of("static-friction"),
         [](Material& m) -> double& { return m.friction.static_coefficient; }, ""},
        {"dynamic-friction", 0.0, highest_of("dynamic-friction"),
         [](Material& m) -> double& { return m.friction.dynamic_coefficient; }, ""},
        {"stiffness", 0.0, highest_of("stiffness"),
         [](Material& m) -> double& { return m.stiffness_newton_per_mm; }, "N/mm"},
        {"damping", 0.0, highest_of("damping"),
         [](Material& m) -> double& { return m.damping_newton_s_per_m; }, "N s/m"},
        {"sound-frequency", 20.0, 8000.0,
         [](Material& m) -> double& { return m.sound.frequency_hz; },
         "Hz, the lowest that a tap rings at"},
        {"sound-decay", 0.005, 2.0, [](Material& m) -> double& { return m.sound.decay_s; },
         "s until that has faded by 60 dB"},
        {"sound-loudness", 0.0, 1.0, [](Material& m) -> double& { return m.sound.loudness; },
         "of taps, texture and scraping"},
        {"sound-hiss", 0.0, 1.0, [](Material& m) -> double& { return m.sound.hiss; },
         "of scraping alone"},
        {"sound-grain", 0.01, 10.0, [](Material& m) -> double& { return m.sound.grain_mm; },
         "mm between what scrapes: finer is higher"},
        {"tint-share", 0.0, 1.0, [](Material& m) -> double& { return m.look.tint_share; },
         "of the tint in the colour"},
        {"gloss", 0.0, 1.0, [](Material& m) -> double& { return m.look.gloss; },
         "of its highlights"},
        {"fuzz", 0.0, 1.0, [](Material& m) -> double& { return m.look.fuzz; },
         "of fibres at its edges"},
    }};
    return all;
}

[[noreturn]] void refuse(const fs::path& file, const toml::node& node, const std::string& what) {
    throw InputError(
        one_line(file.string() + ":" + std::to_string(node.source().begin.line) + ": " + what));
}

std::string known_properties() {
    std::string names = "map, tint";
    for (const Property& property : properties()) names += ", " + std::string(property.name);
    return names;
}

void take_number(const fs::path& file, const Property& property, const toml::node& node,
                 Material& material) {
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    if (!number || !(*number >= property.lowest && *number <= property.highest))
        refuse(file, node,
               std::string(property.name) + " is not a number from " + short_text(property.lowest) +
                   " to " + short_text(property.highest));
    property.in(material) = *number;
}

/// "#7a5230"; nothing for anything else.
std::optional<glm::vec3> colour_of(std::string_view text) {
    constexpr std::size_t kLength = 7;
    if (text.size() != kLength || text.front() != '#') return std::nullopt;
    unsigned rgb = 0;
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data() + 1, end, rgb, 16).ptr != end) return std::nullopt;
    const auto channel = [rgb](unsigned shift) {
        return static_cast<float>((rgb >> shift) & 255U) / 255.0F;
    };
    return glm::vec3(channel(16U), channel(8U), channel(0U));
}

std::string text_of(glm::vec3 colour) {
    std::array<char, 8> text{};
    const auto byte = [](float c) { return static_cast<unsigned>(std::lround(255.0F * c)); };
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(colour.x), byte(colour.y),
                  byte(colour.z));
    return text.data();
}

void take(const fs::path& file, std::string_view name, const toml::node& node, Material& material) {
    if (name == "map") {
        const auto map = node.value_exact<std::string>();
        if (!map || map->empty()) refuse(file, node, "map is not the name of a picture in quotes");
        material.map = fs::absolute(file).parent_path() / *map;
        return;
    }
    if (name == "tint") {
        const auto colour = colour_of(node.value_exact<std::string>().value_or(""));
        if (!colour) refuse(file, node, "tint is not a colour in quotes, as \"#7a5230\"");
        material.look.tint = *colour;
        return;
    }
    const auto& all = properties();
    const auto* const found = std::ranges::find(all, name, &Property::name);
    if (found == all.end())
        refuse(
            file, node,
            in_quotes(name) + " is not a property of a material: those are " + known_properties());
    take_number(file, *found, node, material);
}

toml::table table_of(const fs::path& file) {
    const auto content = small_text_in(file);
    if (!content)
        throw InputError("cannot read the material " + shown(file) +
                         ": name a small text file that can be read");
    try {
        return toml::parse(*content);
    } catch (const toml::parse_error& error) {
        std::ostringstream text;
        text << file.string() << ":" << error.source().begin.line << ": cannot be understood ("
             << error.description() << "); correct it";
        throw InputError(one_line(text.str()));  // it quotes the file
    }
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

void require_own_name(const std::string& name) {
    const auto fits = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == ' ' || c >= 0x80;
    };
    const bool names_file = !name.empty() && name.size() <= kLongestName && name.front() != ' ' &&
                            name.back() != ' ' && std::ranges::all_of(name, fits);
    if (!names_file)
        throw InputError(in_quotes(name) +
                         " is not a name for a material: use letters, digits, spaces and hyphens");
    if (name == kAsRecorded || contains(material_names().shipped, name))
        throw InputError(in_quotes(name) +
                         " is a material that comes with the program: choose another name");
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    if (!in || bytes.fail())
        throw InputError("cannot read the bump map " + shown(file) +
                         ": put it back, or choose another");
    return bytes.str();
}

std::string toml_of(Material material, const fs::path& map) {
    std::ostringstream text;
    text << "# A material of dibhr; any file like this can be named with --material or dropped on "
            "the window.\n";
    if (!map.empty()) text << "map = " << toml::value<std::string>(map.string()) << '\n';
    if (material.look.tint_share > 0.0)
        text << "tint = \"" << text_of(material.look.tint) << "\"  # red, green, blue\n";
    for (const Property& property : properties()) {
        text << property.name << " = " << number_text(property.in(material));
        if (!property.unit.empty()) text << "  # " << property.unit;
        text << '\n';
    }
    return text.str();
}

}  // namespace

void lay_texture(const Material& material, TouchParameters& parameters) {
    SurfaceShape& shape = parameters.shape;
    shape.roughness_px = shape.bump_size_px = 0.0;
    if (material.bumps) {
        const double pitch_mm = parameters.coupling.pixel_pitch_mm;
        shape.roughness_px = material.height_mm / pitch_mm;
        shape.bump_size_px = std::max(material.width_mm / pitch_mm, 0.5 * material.bumps->columns);
    }
    keep_in_range(parameters);
}

void apply_material(const Material& material, TouchParameters& parameters) {
    lay_texture(material, parameters);
    parameters.friction = material.friction;
    parameters.coupling.stiffness_newton_per_mm = material.stiffness_newton_per_mm;
    parameters.coupling.damping_newton_s_per_m = material.damping_newton_s_per_m;
    keep_in_range(parameters);
}

bool has_texture(const Material& material, const TouchParameters& parameters) {
    TouchParameters laid = parameters;
    lay_texture(material, laid);
    return laid == parameters;
}

bool is_made_of(const Material& material, const TouchParameters& parameters) {
    TouchParameters laid = parameters;
    apply_material(material, laid);
    return laid == parameters;
}

Material material_of(const TouchParameters& parameters, const fs::path& map,
                     std::shared_ptr<const BumpMap> bumps, int columns) {
    const double pitch_mm = parameters.coupling.pixel_pitch_mm;
    Material material{.map = map,
                      .bumps = std::move(bumps),
                      .friction = parameters.friction,
                      .stiffness_newton_per_mm = parameters.coupling.stiffness_newton_per_mm,
                      .damping_newton_s_per_m = parameters.coupling.damping_newton_s_per_m};
    if (material.bumps) {
        const double size_px = parameters.shape.bump_size_px;
        material.width_mm = (size_px > 0.0 ? size_px : columns) * pitch_mm;
        material.height_mm = parameters.shape.roughness_px * pitch_mm;
    }
    for (const Property& property : properties()) {
        double& number = property.in(material);
        number = std::clamp(number, property.lowest, property.highest);
    }
    return material;
}

Material read_material(const fs::path& file) {
    const toml::table table = table_of(file);
    Material material{.name = file.stem().string()};
    for (const auto& [name, node] : table) take(file, name.str(), node, material);
    const Friction& friction = material.friction;
    if (friction.dynamic_coefficient > friction.static_coefficient)
        throw InputError(shown(file) +
                         ": its dynamic friction is above its static friction; lower it");
    if (!material.map.empty())
        material.bumps = std::make_shared<const BumpMap>(read_bump_map(material.map));
    return material;
}

Material material_named(const std::string& name) {
    if (name == kAsRecorded) return {};
    if (fs::path(name).extension() == kEnding) return read_material(name);
    for (const fs::path& folder : {own_materials_folder(), shipped_materials_folder()}) {
        if (contains(toml_names_in(folder), name)) return read_material(folder / (name + kEnding));
    }
    const std::vector<std::string> names = names_of_materials();
    throw InputError("no material is called " + in_quotes(name) + ": there are " + listed(names) +
                     ", and files that end in .toml" + did_you_mean(name, names));
}

MaterialNames material_names() {
    MaterialNames names{.own = toml_names_in(own_materials_folder())};
    try {
        names.shipped = toml_names_in(shipped_materials_folder());
    } catch (const InputError&) {  // reported when one of them is requested
    }
    return names;
}

std::vector<std::string> names_of_materials() {
    const MaterialNames names = material_names();
    std::vector<std::string> all{std::string(kAsRecorded)};
    for (const auto* group : {&names.shipped, &names.own})
        all.insert(all.end(), group->begin(), group->end());
    return all;
}

fs::path own_materials_folder() {
    return settings_path().parent_path() / "materials";
}

fs::path save_material(const Material& material) {
    require_own_name(material.name);
    const fs::path folder = own_materials_folder();
    std::error_code failed;
    make_folders(folder, failed);
    fs::path map;
    if (!material.map.empty()) {
        map = material.name + material.map.extension().string();
        if (!fs::equivalent(material.map, folder / map, failed))
            write_file(folder / map, bytes_of(material.map));
    }
    fs::path file = folder / (material.name + kEnding);
    write_file(file, toml_of(material, map));
    return file;
}

}  // namespace dibhr
