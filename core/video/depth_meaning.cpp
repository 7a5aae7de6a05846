// Names, and one voice over another.
#include "core/video/depth_meaning.hpp"

namespace dibhr {

std::string_view name_of(NearLevels value) noexcept {
    return value == NearLevels::bright ? "bright" : "dark";
}

std::string_view name_of(DepthUnit value) noexcept {
    switch (value) {
        case DepthUnit::levels:
            return "levels";
        case DepthUnit::disparity:
            return "disparity";
        case DepthUnit::mm:
            return "mm";
        case DepthUnit::m:
            return "m";
    }
    return {};
}

std::string_view name_of(DepthPacking value) noexcept {
    switch (value) {
        case DepthPacking::separate:
            return "separate";
        case DepthPacking::left_right:
            return "left-right";
        case DepthPacking::right_left:
            return "right-left";
        case DepthPacking::top_bottom:
            return "top-bottom";
        case DepthPacking::bottom_top:
            return "bottom-top";
        case DepthPacking::tracks:
            return "tracks";
    }
    return {};
}

std::string_view name_of(DepthCode value) noexcept {
    return value == DepthCode::grey ? "grey" : "hue";
}

std::string_view name_of(Geometry value) noexcept {
    return value == Geometry::relief ? "relief" : "true";
}

void DepthStatement::fill_in(const DepthStatement& other) {
    const auto take = [](auto& mine, const auto& theirs) {
        if (!mine) mine = theirs;
    };
    take(near, other.near);
    take(unit, other.unit);
    take(scale, other.scale);
    take(range, other.range);
    take(no_data, other.no_data);
    take(packing, other.packing);
    take(code, other.code);
    take(geometry, other.geometry);
    take(intrinsics, other.intrinsics);
}

}  // namespace dibhr
