#include "assets/materials/materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "assets/materials/textures.hpp"
#include "core/error.hpp"

namespace dibhr::materials {
namespace {

struct Material {
    const char* name{};
    double (*height_at)(Place at) noexcept {};
};

constexpr std::array kMaterials{Material{"bark", bark_at},
                                Material{"ice", ice_at},
                                Material{"linen", linen_at},
                                Material{"rubber", rubber_at},
                                Material{"sandpaper", sandpaper_at},
                                Material{"skin", skin_at},
                                Material{"stone", stone_at},
                                Material{"wood", wood_at},
                                Material{"wool", wool_at}};

/// Stretches to the whole of 0..255.
std::vector<std::uint8_t> stretched(const std::vector<double>& heights) {
    const auto ends = std::minmax_element(heights.begin(), heights.end());
    const double low = *ends.first;
    const double scale = 255.0 / (*ends.second - low);
    std::vector<std::uint8_t> bytes(heights.size());
    std::transform(heights.begin(), heights.end(), bytes.begin(), [&](double x) {
        return static_cast<std::uint8_t>(std::lround((x - low) * scale));
    });
    return bytes;
}

}  // namespace

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Material& material : kMaterials) all.emplace_back(material.name);
    return all;
}

std::vector<std::uint8_t> map_of(const std::string& name) {
    const auto found = std::find_if(kMaterials.begin(), kMaterials.end(),
                                    [&](const Material& m) { return m.name == name; });
    if (found == kMaterials.end())
        throw InputError("there is no material '" + name + "': choose one of assets/materials");
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(kSide) * kSide);
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
            heights.push_back(found->height_at(Place{column + 0.5, row + 0.5} / Place{kSide}));
    return stretched(heights);
}

}  // namespace dibhr::materials
