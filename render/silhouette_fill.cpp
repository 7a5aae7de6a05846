// The continuation of what is behind under the near faces.
#include "render/silhouette_fill.hpp"

#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

namespace dibhr {
namespace {

constexpr int kMostRings = 100;  // of vertices under the near face: bounds the work
constexpr int kMostSpread = 8;   // vertices along an outline, for a colour
constexpr int kFillSmoothings = 3;
constexpr float kLeastGap_px = 2.0F;  // between the near face and what is behind

struct Continued {
    std::optional<float> far{};
    std::optional<glm::vec3> colour{};
};

/// The mean of what is behind the vertices around that are in rings before `ring`.
Continued continued_at(const Rims& rims, GridPlace middle, int ring) {
    Mean<float> far;
    Mean<glm::vec3> colour;
    rims.each_around(middle, [&](const Rim& around) {
        if (around.ring >= ring) return;
        if (around.far) far.add(*around.far);
        if (around.colour) colour.add(*around.colour);
    });
    return {far.value(), colour.value()};
}

bool continue_at(Rims& rims, GridPlace next, int ring, std::optional<GridPlace> far_source) {
    const Continued mean = continued_at(rims, next, ring);
    if (!mean.far || rims.elevation_px(next) - *mean.far < kLeastGap_px) return false;
    Rim& added = rims[rims.number(next)];
    added.ring = ring;
    added.far = mean.far;
    added.colour = mean.colour;
    added.far_source = far_source;
    return true;
}

/// Gives rims whose far face is too narrow to have a colour that of the next ones.
void spread_colours(Rims& rims) {
    bool more = true;
    for (int pass = 0; more && pass < kMostSpread; ++pass) {
        more = false;
        for (std::uint32_t k = 0; k < rims.count(); ++k) {
            Rim& rim = rims[k];
            const bool wants_own = rim.is_far && !rim.own_colour;
            const bool wants_far = rim.far && !rim.colour;
            if (!wants_own && !wants_far) continue;
            more = true;
            Mean<glm::vec3> own;
            Mean<glm::vec3> far;
            rims.each_around(rim.at, [&](const Rim& around) {
                if (around.own_colour) own.add(*around.own_colour);
                if (around.colour) far.add(*around.colour);
            });
            if (wants_own) rim.own_colour = own.count > 0.0F ? own.value() : far.value();
            if (wants_far) rim.colour = far.count > 0.0F ? far.value() : own.value();
        }
    }
}

/// Ring by ring.
void add_rings(Rims& rims) {
    std::vector<std::uint32_t> frontier;
    for (std::uint32_t k = 0; k < rims.count(); ++k) {
        const Rim& rim = rims[k];
        if (rim.far && glm::dot(rim.outward, rims.shift(rim.at, *rim.far)) > 0.0F)
            frontier.push_back(k);
    }
    std::size_t begin = 0;
    for (int ring = 1; ring <= kMostRings && begin < frontier.size(); ++ring) {
        const std::size_t end = frontier.size();
        for (std::size_t k = begin; k < end; ++k) {
            const Rim from = rims[frontier[k]];
            const float reach = glm::length(rims.shift(from.at, *from.far));
            if (static_cast<float>((ring - 1) * rims.grid().step) > reach) continue;
            const auto [i, j] = from.at;
            for (const GridPlace next : {GridPlace{i - 1, j}, GridPlace{i + 1, j},
                                         GridPlace{i, j - 1}, GridPlace{i, j + 1}}) {
                if (!rims.inside(next) || rims.is_under(next)) continue;
                if (continue_at(rims, next, ring, from.far_source))
                    frontier.push_back(rims.number(next));
            }
        }
        begin = end;
    }
}

/// Evens out the fill where rings from different sides have met.
void smooth(Rims& rims) {
    const std::uint32_t count = rims.count();
    for (int pass = 0; pass < kFillSmoothings; ++pass) {
        for (std::uint32_t k = 0; k < count; ++k) {
            Rim& rim = rims[pass % 2 == 0 ? k : count - 1 - k];
            if (!rim.far) continue;
            const Continued around = continued_at(rims, rim.at, kMostRings + 1);
            if (around.colour) rim.colour = around.colour;
            if (rim.ring > 0 && around.far &&
                rims.elevation_px(rim.at) - *around.far >= kLeastGap_px)
                rim.far = around.far;
        }
    }
}

}  // namespace

void fill_under(Rims& rims) {
    spread_colours(rims);
    add_rings(rims);
    smooth(rims);
}

}  // namespace dibhr
