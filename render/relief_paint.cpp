// The colours for depth.
#include "render/relief_paint.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/video/depth/colour_ramp.hpp"

namespace dibhr {

namespace {

constexpr int kColours = 256;
constexpr std::array<std::uint8_t, 3> kUnseen{24, 27, 38};  // not in any ramp

std::shared_ptr<const ColourImage> ramp_of(ColourRamp ramp) {
    return std::make_shared<const ColourImage>(colours_of(ramp));
}

}  // namespace

std::shared_ptr<const ColourImage> depth_colours(ReliefPaint paint) {
    static const auto turbo = ramp_of(ColourRamp::turbo);
    static const auto viridis = ramp_of(ColourRamp::viridis);
    static const auto grey = ramp_of(ColourRamp::grey);
    switch (paint) {
        case ReliefPaint::turbo:
            return turbo;
        case ReliefPaint::viridis:
            return viridis;
        case ReliefPaint::grey:
            return grey;
        case ReliefPaint::video:
        case ReliefPaint::clay:
            break;
    }
    return nullptr;
}

std::shared_ptr<const ColourImage> depth_picture(const DepthImage& depth,
                                                 const std::vector<std::uint8_t>* unseen,
                                                 ReliefPaint paint, int most_side) {
    const auto ramp = depth_colours(paint);
    if (!ramp || depth.columns <= 0 || depth.rows <= 0 || most_side <= 0) return nullptr;
    const int step = (std::max(depth.columns, depth.rows) + most_side - 1) / most_side;
    ColourImage picture{.columns = (depth.columns + step - 1) / step,
                        .rows = (depth.rows + step - 1) / step};
    picture.rgb.reserve(3 * static_cast<std::size_t>(picture.columns) *
                        static_cast<std::size_t>(picture.rows));
    const auto scale = static_cast<float>((kColours - 1) / depth.highest_level);
    for (int j = 0; j < depth.rows; j += step) {
        for (int i = 0; i < depth.columns; i += step) {
            const std::size_t at = depth.index(i, j);
            const float level = std::clamp(scale * depth.levels[at], 0.0F, kColours - 1.0F);
            const bool is_unseen = unseen != nullptr && (*unseen)[at] != 0;
            const std::uint8_t* const colour =
                is_unseen ? kUnseen.data()
                          : &ramp->rgb[3 * static_cast<std::size_t>(std::lround(level))];
            picture.rgb.insert(picture.rgb.end(), colour, colour + 3);
        }
    }
    return std::make_shared<const ColourImage>(std::move(picture));
}

}  // namespace dibhr
