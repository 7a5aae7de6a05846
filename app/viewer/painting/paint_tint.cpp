// Shows in colour what the brush has painted.
#include "app/viewer/painting/paint_tint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "app/settings/material.hpp"
#include "core/error.hpp"
#include "core/video/depth/colour_ramp.hpp"

namespace dibhr {

namespace {

constexpr double kMostTint = 0.65;
constexpr double kSame = 1e-3;  // N/mm or friction: more than the maps round off
constexpr glm::vec3 kAnything{0.95F, 0.55F, 0.05F};

/// The map whose values are shown; none: show where any paint lies.
std::optional<TouchMapKind> shown_kind(BrushLayer layer) {
    switch (layer) {
        case BrushLayer::stiffness:
            return TouchMapKind::stiffness;
        case BrushLayer::friction:
            return TouchMapKind::friction;
        case BrushLayer::height:
            return TouchMapKind::height;
        case BrushLayer::material:
        case BrushLayer::region:
        case BrushLayer::nothing:
            break;
    }
    return std::nullopt;
}

struct Paint {
    glm::vec3 colour{0.0F};
    double cover{0.0};  ///< 0 to 1
};

/// The pixel of a map that lies at a pixel of a picture; null: there is no map.
const TouchMap::Pixel* pixel_under(const TouchMap& map, const ColourImage& picture, int i, int j) {
    if (map.empty()) return nullptr;
    return &map.at(static_cast<int>(std::int64_t{i} * map.columns / picture.columns),
                   static_cast<int>(std::int64_t{j} * map.rows / picture.rows));
}

double cover_of(const TouchMap::Pixel* pixel) {
    return pixel != nullptr ? pixel->cover / TouchMap::kWhole : 0.0;
}

glm::vec3 colour_of_material(double stiffness, double friction,
                             std::span<const PaintedMaterial> materials) {
    const auto found = std::find_if(materials.begin(), materials.end(), [&](const auto& material) {
        return std::abs(material.stiffness_newton_per_mm - stiffness) < kSame &&
               std::abs(material.friction - friction) < kSame;
    });
    return found != materials.end() ? found->tint : kAnything;
}

Paint paint_at(const TouchMaps& maps, const ColourImage& picture, int i, int j,
               std::span<const PaintedMaterial> materials) {
    const auto* const stiffness = pixel_under(maps.stiffness, picture, i, j);
    const auto* const friction = pixel_under(maps.friction, picture, i, j);
    const auto* const height = pixel_under(maps.height, picture, i, j);
    Paint paint{kAnything, std::max({cover_of(stiffness), cover_of(friction), cover_of(height)})};
    if (cover_of(stiffness) > 0.0 && cover_of(friction) > 0.0)
        paint.colour = colour_of_material(maps.stiffness.value_of(*stiffness),
                                          maps.friction.value_of(*friction), materials);
    return paint;
}

/// Neighbouring labels have colours far apart.
glm::vec3 colour_of_region(std::uint8_t label) {
    constexpr float kGolden = 0.618F;  // of a turn around the hues
    const float hue = 6.0F * std::fmod(kGolden * static_cast<float>(label), 1.0F);
    const auto part = [hue](float at) {
        const float apart = std::abs(std::fmod(hue - at + 9.0F, 6.0F) - 3.0F);
        return std::clamp(2.0F - apart, 0.0F, 1.0F);
    };
    return {part(0.0F), part(2.0F), part(4.0F)};
}

/// The picture with the paint of each of its pixels.
template <typename PaintAt>
ColourImage with_tint(const ColourImage& picture, const PaintAt& paint_at) {
    ColourImage tinted = picture;
    std::size_t at = 0;
    for (int j = 0; j < picture.rows; ++j) {
        for (int i = 0; i < picture.columns; ++i, at += 3) {
            const Paint paint = paint_at(i, j);
            if (paint.cover <= 0.0) continue;
            for (int c = 0; c < 3; ++c) {
                std::uint8_t& channel = tinted.rgb[at + static_cast<std::size_t>(c)];
                const double colour = 255.0 * static_cast<double>(paint.colour[c]);
                channel = static_cast<std::uint8_t>(
                    std::lround(channel + kMostTint * paint.cover * (colour - channel)));
            }
        }
    }
    return tinted;
}

}  // namespace

std::vector<PaintedMaterial> painted_materials() {
    std::vector<PaintedMaterial> all;
    const MaterialNames names = material_names();
    for (const auto* group : {&names.own, &names.shipped}) {
        for (const std::string& name : *group) {
            try {
                const Material material = material_named(name);
                all.push_back({material.stiffness_newton_per_mm,
                               material.friction.static_coefficient, material.look.tint});
            } catch (const InputError&) {  // reported when it is chosen
            }
        }
    }
    return all;
}

ColourImage with_paint(const ColourImage& picture, const TouchMaps& maps, BrushLayer layer,
                       std::span<const PaintedMaterial> materials) {
    const auto kind = shown_kind(layer);
    const ColourImage ramp = colours_of(ColourRamp::viridis);
    const auto of_value = [&](int i, int j) -> Paint {
        const auto* const pixel = pixel_under(maps.of(*kind), picture, i, j);
        if (pixel == nullptr) return {};
        const std::uint8_t* const rgb = &ramp.rgb[std::size_t{3} * (pixel->level >> 8U)];
        return {glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0F, cover_of(pixel)};
    };
    return with_tint(picture, [&](int i, int j) {
        return kind ? of_value(i, j) : paint_at(maps, picture, i, j, materials);
    });
}

ColourImage with_regions(const ColourImage& picture, const Regions& regions, int label_picture) {
    return with_tint(picture, [&](int i, int j) -> Paint {
        const std::uint8_t label = regions.label(
            label_picture, static_cast<int>(std::int64_t{i} * regions.columns / picture.columns),
            static_cast<int>(std::int64_t{j} * regions.rows / picture.rows));
        if (label == 0) return {};
        return {colour_of_region(label), 1.0};
    });
}

}  // namespace dibhr
