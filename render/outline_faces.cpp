// The near and the far face of each cut cell.
#include "render/outline_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "render/face_colour.hpp"

namespace dibhr {
namespace {

constexpr int kMostPasses = 3;  // of vertices along an outline, that take a face from the next
constexpr int kEndSmoothings = 2;
constexpr float kSameEnd_units = 30.0F;
constexpr float kLeastShare = 0.1F;  // of an edge; an outline nearer to a vertex says little beyond

/// Takes a value that is not known yet. Whether it did.
template <class Value>
bool take(std::optional<Value>& value, const std::optional<Value>& other) {
    if (value || !other) return false;
    value = other;
    return true;
}

class FaceJoiner {
  public:
    FaceJoiner(const CutRelief& relief, Rims& rims)
        : relief_(relief),
          grid_(relief.grid),
          elevation_(relief.depth),
          colour_(relief.colour, relief.depth),
          same_end_px_(kSameEnd_units * static_cast<float>(outline_unit(relief.depth.from))),
          rims_(rims) {}

    std::vector<OutlineCell> run() {
        std::vector<OutlineCell> cells;
        cells.reserve(relief_.cuts.cells.size());
        for (std::size_t k = 0; k < relief_.cuts.cells.size(); ++k)
            cells.push_back(join(rims_.place(relief_.cuts.cells[k]), relief_.cuts.ends_px[k]));
        take_means();
        // A cell may touch one face only.
        bool more = true;
        for (int pass = 0; more && pass < kMostPasses; ++pass) {
            more = false;
            for (const OutlineCell& cell : cells) more = complete(cell, rims_) || more;
        }
        smooth_ends();
        end_at_outlines(cells);
        return cells;
    }

  private:
    /// Of the ends of faces around a rim [px].
    struct Ends {
        Mean<float> far{}, near{};
        Mean<glm::vec2> faces{};
        Mean<glm::vec3> colour{};
    };

    /// Gives each corner of a cut cell the elevation of the face that it is not on.
    OutlineCell join(GridPlace place, glm::vec2 ends_px) {
        const std::array<GridPlace, 4> corners = corners_of(place);
        OutlineCell cell{.ends_px = ends_px};
        for (std::size_t k = 0; k < 4; ++k) {
            cell.rims[k] = rims_.number(corners[k]);
            cell.face[k] = face_at(corners[k], 0.5F * (ends_px.x + ends_px.y));
        }
        ends_.resize(rims_.count());
        // Where a high and a low step meet, it is the high one's faces that must not be missed.
        const float rise = ends_px.y - ends_px.x;
        const float weight = std::max(rise * rise * rise * rise, 1.0F);
        for (std::size_t k = 0; k < 4; ++k)
            if (cell.face[k] == Face::far) colour(rims_[cell.rims[k]]);
        for (std::size_t to = 0; to < 4; ++to) {
            Rim& corner = rims_[cell.rims[to]];
            Ends& ends = ends_[cell.rims[to]];
            ends.faces.add(ends_px, weight);
            if (cell.face[to] != Face::far) ends.far.add(ends_px.x, weight);
            if (cell.face[to] != Face::near) ends.near.add(ends_px.y, weight);
            for (std::size_t k = 0; k < 4; ++k) {
                if (cell.face[k] == cell.face[to]) continue;
                if (cell.face[k] == Face::far) {
                    if (const auto& behind = rims_[cell.rims[k]].own_colour)
                        ends.colour.add(*behind, weight);
                    corner.far_source = well_inside(corners[k], corner.at);
                    corner.outward += rims_.in_image(corners[k]) - rims_.in_image(corner.at);
                } else if (cell.face[k] == Face::near) {
                    corner.near_source = corners[k];
                }
            }
        }
        return cell;
    }

    /// The vertex beyond `source`, seen from `from`, if it is on the same face: beside an outline,
    /// light and colour are uncertain.
    [[nodiscard]] GridPlace well_inside(GridPlace source, GridPlace from) const {
        const GridPlace beyond{2 * source.i - from.i, 2 * source.j - from.j};
        if (!rims_.inside(beyond) || relief_.cuts.around[rims_.index(beyond)] > 0.0F) return source;
        const float apart_px = std::abs(rims_.elevation_px(beyond) - rims_.elevation_px(source));
        return apart_px < same_end_px_ ? beyond : source;
    }

    [[nodiscard]] Face face_at(GridPlace vertex, float middle_px) const {
        if (relief_.cuts.between[rims_.index(vertex)]) return Face::between;
        return rims_.elevation_px(vertex) > middle_px ? Face::near : Face::far;
    }

    void colour(Rim& rim) const {
        if (rim.is_far) return;
        rim.is_far = true;
        rim.own_colour = colour_.around(grid_.image_i(rim.at.i), grid_.image_j(rim.at.j));
    }

    void take_means() {
        for (std::uint32_t k = 0; k < rims_.count(); ++k) {
            rims_[k].far = ends_[k].far.value();
            rims_[k].near = ends_[k].near.value();
            rims_[k].faces = ends_[k].faces.value();
            rims_[k].colour = ends_[k].colour.value();
        }
    }

    /// Takes sources that are not known at a corner from the other ones. Whether there was one.
    static bool complete(const OutlineCell& cell, Rims& rims) {
        bool changed = false;
        for (std::size_t k = 0; k < 4; ++k) {
            Rim& corner = rims[cell.rims[k]];
            for (const std::uint32_t number : cell.rims) {
                const Rim& other = rims[number];
                if (cell.face[k] != Face::far && take(corner.far_source, other.far_source)) {
                    corner.outward = other.outward;
                    changed = true;
                }
                if (cell.face[k] != Face::near && take(corner.near_source, other.near_source))
                    changed = true;
            }
        }
        return changed;
    }

    /// Evens out the near face's end: it is steep there, so that its pixels end at many elevations.
    void smooth_ends() {
        for (int pass = 0; pass < kEndSmoothings; ++pass) {
            for (std::uint32_t k = 0; k < rims_.count(); ++k) {
                Rim& rim = rims_[k];
                if (!rim.near) continue;
                Mean<float> mean;
                rims_.each_around(rim.at, [&](const Rim& other) {
                    if (other.near && std::abs(*other.near - *rim.near) < same_end_px_)
                        mean.add(*other.near);
                });
                rim.near = mean.value();
            }
        }
    }

    /// The outline lies between the drawn vertices: what is drawn there is on the way from the near
    /// face to the vertex beyond, so that this one goes on with the slope of the face, by least
    /// squares over the edges to it.
    void end_at_outlines(const std::vector<OutlineCell>& cells) {
        struct Sums {
            float share{kLeastShare}, square{kLeastShare}, inside_px{0.0F};
        };
        std::vector<Sums> all(rims_.count());
        for (const OutlineCell& cell : cells) {
            for (std::size_t to = 0; to < 4; ++to) {
                if (cell.face[to] == Face::near) continue;
                for (std::size_t k = 0; k < 4; ++k) {
                    if (cell.face[k] != Face::near) continue;
                    const GridPlace inner = rims_[cell.rims[k]].at;
                    const float share = outline_between(inner, rims_[cell.rims[to]].at,
                                                        0.5F * (cell.ends_px.x + cell.ends_px.y));
                    Sums& sums = all[cell.rims[to]];
                    sums.share += share;
                    sums.square += share * share;
                    sums.inside_px += share * (1.0F - share) * rims_.elevation_px(inner);
                }
            }
        }
        for (std::uint32_t k = 0; k < rims_.count(); ++k) {
            Rim& rim = rims_[k];
            if (!rim.near) continue;
            const float end_px = (*rim.near * all[k].share - all[k].inside_px) / all[k].square;
            rim.front = std::clamp(end_px, *rim.near - same_end_px_, *rim.near + same_end_px_);
        }
    }

    /// Where the outline lies on the edge to a vertex beyond it, 0: at the first vertex.
    [[nodiscard]] float outline_between(GridPlace inner, GridPlace outer, float middle_px) const {
        const glm::ivec2 from{grid_.image_i(inner.i), grid_.image_j(inner.j)};
        const glm::ivec2 way = glm::ivec2(grid_.image_i(outer.i), grid_.image_j(outer.j)) - from;
        const int pixels = std::max(std::abs(way.x), std::abs(way.y));
        float before_px = rims_.elevation_px(inner);
        for (int k = 1; k <= pixels; ++k) {
            const glm::ivec2 at = from + way * k / pixels;
            const float here_px = elevation_(relief_.depth.from.index(at.x, at.y));
            if (here_px <= middle_px && before_px > middle_px)
                return (static_cast<float>(k - 1) +
                        (before_px - middle_px) / (before_px - here_px)) /
                       static_cast<float>(pixels);
            before_px = here_px;
        }
        return 1.0F;
    }

    const CutRelief& relief_;
    const ReliefGrid& grid_;
    PixelElevation elevation_;
    FaceColour colour_;
    float same_end_px_;
    Rims& rims_;
    std::vector<Ends> ends_{};  // of each rim
};

}  // namespace

std::vector<OutlineCell> join_faces(const CutRelief& relief, Rims& rims) {
    return FaceJoiner(relief, rims).run();
}

}  // namespace dibhr
