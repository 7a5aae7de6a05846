// Cuts a polyline into the pieces that a dash pattern leaves visible.
#include "core/plot/dashes.hpp"

#include <cstddef>

#include <glm/geometric.hpp>

namespace dibhr {
namespace {

/// Lengths of line and gap by turns, in widths of the line; ends are round, so a dot is short.
std::vector<double> pattern_of(Dash dash) {
    switch (dash) {
        case Dash::dashed:
            return {4.0, 3.0};
        case Dash::dotted:
            return {0.1, 2.4};
        case Dash::dash_dot:
            return {4.5, 2.4, 0.1, 2.4};
        case Dash::solid:
            break;
    }
    return {};
}

}  // namespace

std::vector<std::vector<Vec2>> dashes_of(std::span<const Vec2> points, Dash dash, double width_px) {
    const std::vector<double> pattern = pattern_of(dash);
    if (pattern.empty() || points.empty()) return {{points.begin(), points.end()}};
    std::vector<std::vector<Vec2>> pieces{{points[0]}};
    std::size_t part = 0;  // of the pattern; the even ones are visible
    double left = pattern[0] * width_px;
    const auto next_part = [&](Vec2 at) {
        if (part % 2 == 0) pieces.back().push_back(at);
        part = (part + 1) % pattern.size();
        if (part % 2 == 0) pieces.push_back({at});
        left = pattern[part] * width_px;
    };
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Vec2 way = points[k] - points[k - 1];
        const double length = glm::length(way);
        double gone = 0.0;
        while (length - gone > left) {
            gone += left;
            next_part(points[k - 1] + way * (gone / length));
        }
        left -= length - gone;
        if (part % 2 == 0) pieces.back().push_back(points[k]);
    }
    if (pieces.back().size() < 2) pieces.pop_back();
    return pieces;
}

}  // namespace dibhr
