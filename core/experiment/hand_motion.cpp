// From a motion to goals.
#include "core/experiment/hand_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kUpdate_s = 1e-3;
constexpr double kRoundOff = 1e-9;

}  // namespace

void fit_into(HandMotion& motion, const ImageArea& area) {
    Vec2 low = motion.places.at(0);
    Vec2 high = low;
    for (const Vec2& place : motion.places) {
        low = {std::min(low.x, place.x), std::min(low.y, place.y)};
        high = {std::max(high.x, place.x), std::max(high.y, place.y)};
    }
    const Vec2 half = 0.5 * (high - low);
    // Round-off of a place that stays is no motion: it is not to be magnified.
    const double furthest = std::max(std::max(std::abs(low.x), std::abs(low.y)),
                                     std::max(std::abs(high.x), std::abs(high.y)));
    const double least = kRoundOff * furthest;
    const double fits_x = half.x > least ? area.half_size.x / half.x : INFINITY;
    const double fits_y = half.y > least ? area.half_size.y / half.y : INFINITY;
    const double scale = std::min(fits_x, fits_y);
    if (!std::isfinite(scale) || scale <= 0.0) {
        throw InputError("the hand does not move; record it again while it moves");
    }
    const Vec2 centre = low + half;
    for (Vec2& place : motion.places) place = area.centre + scale * (place - centre);
}

PathRun human_path(const HandMotion& motion, const DepthClip& clip, double mu) {
    PathRun path;
    path.name = "human";
    path.source = motion.source;
    path.mu = mu;
    for (std::size_t k = 0; k < motion.places.size(); ++k) {
        const Vec2& place = motion.places[k];
        const double z = clip.at(kUpdate_s * static_cast<double>(k)).elevation_at(place.x, place.y);
        path.goals.emplace_back(place.x, place.y, z - motion.penetrations_px[k]);
    }
    survey_path(path, clip);
    return path;
}

}  // namespace dibhr
