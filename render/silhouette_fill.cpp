// The continuation of what is behind under the near faces.
#include "render/silhouette_fill.hpp"

#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

namespace dibhr {
namespace {

constexpr int kMostRings = 100;    // of vertices under the near face: bounds the work
constexpr int kMostSpread = 8;     // vertices along an outline, for a colour
constexpr float kWideOpen = 0.5F;  // cosine; what is seen there goes on first
constexpr int kFillSmoothings = 2;
constexpr float kLeastGap_px = 2.0F;  // between the near face and what is behind

struct Continued {
    std::optional<float> far{};
    std::optional<glm::vec3> colour{};
};

/// The mean of what is behind the vertices around that are in rings before `ring`, if it is of one
/// face with what lies at `far_px`.
Continued continued_at(const Rims& rims, GridPlace middle, int ring, float far_px) {
    Mean<float> far;
    Mean<glm::vec3> colour;
    rims.each_around(middle, [&](const Rim& around) {
        if (around.ring >= ring || !rims.is_one_face(around.far.value_or(far_px), far_px)) return;
        if (around.far) far.add(*around.far);
        if (around.colour) colour.add(*around.colour);
    });
    return {far.value(), colour.value()};
}

bool continue_at(Rims& rims, GridPlace next, int ring, const Rim& from) {
    const Continued mean = continued_at(rims, next, ring, *from.far);
    if (!mean.far || rims.elevation_px(next) - *mean.far < kLeastGap_px) return false;
    Rim& added = rims[rims.number(next)];
    added.ring = ring;
    added.far = mean.far;
    added.colour = mean.colour;
    added.far_source = from.far_source;
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
            Mean<glm::vec3> own;
            Mean<glm::vec3> far;
            rims.each_around(rim.at, [&](const Rim& around) {
                if (around.own_colour) own.add(*around.own_colour);
                if (around.colour) far.add(*around.colour);
            });
            if (wants_own) rim.own_colour = own.count > 0.0F ? own.value() : far.value();
            if (wants_far) rim.colour = far.count > 0.0F ? far.value() : own.value();
            more = more || own.count > 0.0F || far.count > 0.0F;
        }
    }
}

/// How much an outline is opened by the view: 1: straight away from the near face; 0: not at all.
float opening(const Rims& rims, const Rim& rim) {
    if (!rim.far) return 0.0F;
    const glm::vec2 shift = rims.shift(rim.at, *rim.far);
    const float lengths = glm::length(rim.outward) * glm::length(shift);
    return lengths > 0.0F ? glm::dot(rim.outward, shift) / lengths : 0.0F;
}

/// Ring by ring, from the outlines that are opened by more than `least` and at most by `most`.
void add_rings(Rims& rims, const std::vector<float>& openings, float least, float most) {
    std::vector<std::uint32_t> frontier;
    for (std::uint32_t k = 0; k < openings.size(); ++k)
        if (openings[k] > least && openings[k] <= most) frontier.push_back(k);
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
                if (continue_at(rims, next, ring, from)) frontier.push_back(rims.number(next));
            }
        }
        begin = end;
    }
}

/// Evens out the fill where rings from different sides of a face have met.
void smooth(Rims& rims) {
    const std::uint32_t count = rims.count();
    for (int pass = 0; pass < kFillSmoothings; ++pass) {
        for (std::uint32_t k = 0; k < count; ++k) {
            Rim& rim = rims[pass % 2 == 0 ? k : count - 1 - k];
            if (!rim.far) continue;
            const Continued around = continued_at(rims, rim.at, kMostRings + 1, *rim.far);
            if (around.colour) rim.colour = around.colour;
            if (rim.ring > 0 && around.far &&
                rims.elevation_px(rim.at) - *around.far >= kLeastGap_px)
                rim.far = around.far;
        }
    }
}

/// Gives what no colour has spread to that of its own place.
void colour_the_rest(Rims& rims, const FaceColour& colours) {
    const auto at = [&](GridPlace p) {
        return colours.at(rims.grid().image_i(p.i), rims.grid().image_j(p.j));
    };
    for (std::uint32_t k = 0; k < rims.count(); ++k) {
        Rim& rim = rims[k];
        if (rim.is_far && !rim.own_colour) rim.own_colour = at(rim.at);
        if (rim.far && !rim.colour) rim.colour = at(rim.far_source.value_or(rim.at));
    }
}

}  // namespace

void fill_under(Rims& rims, const FaceColour& colours) {
    spread_colours(rims);
    std::vector<float> openings(rims.count());
    for (std::uint32_t k = 0; k < rims.count(); ++k) openings[k] = opening(rims, rims[k]);
    add_rings(rims, openings, kWideOpen, 2.0F);
    add_rings(rims, openings, 0.0F, kWideOpen);
    smooth(rims);
    spread_colours(rims);  // to a gap so narrow that it had none around
    colour_the_rest(rims, colours);
}

}  // namespace dibhr
