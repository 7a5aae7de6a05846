// The near and the far face of each cut cell.
#include "render/outline_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "render/face_colour.hpp"

namespace dibhr {
namespace {

constexpr int kMostPasses = 3;  // of vertices along an outline, that take a face from the next
constexpr int kEndSmoothings = 2;
constexpr float kSameEnd_px = 30.0F;

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
          image_(relief.depth.from),
          elevation_(relief.depth),
          colour_(relief.colour, relief.depth),
          rims_(rims) {}

    std::vector<OutlineCell> run() {
        std::vector<OutlineCell> cells;
        cells.reserve(relief_.cuts.cells.size());
        for (const std::size_t cell : relief_.cuts.cells) cells.push_back(join(rims_.place(cell)));
        take_means();
        // A cell may touch one face only.
        bool more = true;
        for (int pass = 0; more && pass < kMostPasses; ++pass) {
            more = false;
            for (const OutlineCell& cell : cells) more = complete(cell) || more;
        }
        smooth_ends();
        return cells;
    }

  private:
    /// Of the ends of faces around a rim [px].
    struct Ends {
        Mean<float> far{}, near{};
        Mean<glm::vec2> faces{};
    };

    /// Gives each corner of a cut cell the elevation of the face that it is not on.
    OutlineCell join(GridPlace place) {
        const std::array<GridPlace, 4> corners = corners_of(place);
        OutlineCell cell;
        const float middle_px = middle_of(corners);
        for (std::size_t k = 0; k < 4; ++k) {
            cell.rims[k] = rims_.number(corners[k]);
            cell.face[k] = face_at(corners[k], middle_px);
        }
        ends_.resize(rims_.count());
        Mean<float> far;
        Mean<float> near;
        for (std::size_t to = 0; to < 4; ++to) {
            Rim& corner = rims_[cell.rims[to]];
            if (cell.face[to] == Face::far) colour(corner);
            for (std::size_t k = 0; k < 4; ++k) {
                if (cell.face[k] == cell.face[to] || cell.face[k] == Face::between) continue;
                const float end_px = end_of_face(corners[k], corner.at);
                if (cell.face[k] == Face::far) {
                    far.add(end_px);
                    ends_[cell.rims[to]].far.add(end_px);
                    corner.far_source = corners[k];
                    corner.outward += rims_.in_image(corners[k]) - rims_.in_image(corner.at);
                } else {
                    near.add(end_px);
                    ends_[cell.rims[to]].near.add(end_px);
                    corner.near_source = corners[k];
                }
            }
        }
        const auto far_px = far.value();
        const auto near_px = near.value();
        if (!far_px || !near_px) return cell;
        for (const std::uint32_t rim : cell.rims) ends_[rim].faces.add({*far_px, *near_px});
        return cell;
    }

    [[nodiscard]] Face face_at(GridPlace vertex, float middle_px) const {
        if (relief_.cuts.between[rims_.index(vertex)]) return Face::between;
        return rims_.elevation_px(vertex) > middle_px ? Face::near : Face::far;
    }

    void colour(Rim& rim) const {
        if (rim.is_far) return;
        rim.is_far = true;
        rim.colour = colour_.around(grid_.image_i(rim.at.i), grid_.image_j(rim.at.j));
        rim.has_own_colour = rim.colour.has_value();
    }

    /// Half way between the highest and the lowest vertex on a face: of a cell, or, where a corner
    /// lies between the faces, of the cells around it.
    [[nodiscard]] float middle_of(const std::array<GridPlace, 4>& cell) const {
        const bool blurred = std::any_of(cell.begin(), cell.end(), [this](GridPlace corner) {
            return relief_.cuts.between[rims_.index(corner)];
        });
        const int more = blurred ? 1 : 0;
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (int j = cell[0].j - more; j <= cell[3].j + more; ++j) {
            for (int i = cell[0].i - more; i <= cell[3].i + more; ++i) {
                if (!rims_.inside({i, j}) || relief_.cuts.between[rims_.index({i, j})]) continue;
                low = std::min(low, rims_.elevation_px({i, j}));
                high = std::max(high, rims_.elevation_px({i, j}));
            }
        }
        return 0.5F * (low + high);
    }

    /// The elevation of the face of `from` where it ends on the way to `to`: before the highest
    /// step from pixel to pixel [px].
    [[nodiscard]] float end_of_face(GridPlace from, GridPlace to) const {
        const int x = grid_.image_i(from.i);
        const int y = grid_.image_j(from.j);
        const int dx = grid_.image_i(to.i) - x;
        const int dy = grid_.image_j(to.j) - y;
        const int pixels = std::max(std::abs(dx), std::abs(dy));
        const bool straight = (dx == 0 || std::abs(dx) == pixels) &&
                              (dy == 0 || std::abs(dy) == pixels);  // all but in the last cells
        const auto first = static_cast<std::ptrdiff_t>(image_.index(x, y));
        const std::ptrdiff_t stride =
            (dx > 0) - (dx < 0) + std::ptrdiff_t{(dy > 0) - (dy < 0)} * image_.columns;
        float end = rims_.elevation_px(from);
        float highest = 0.0F;
        float before = end;
        for (int k = 1; k <= pixels; ++k) {
            const float next =
                elevation_(straight ? static_cast<std::size_t>(first + k * stride)
                                    : image_.index(x + k * dx / pixels, y + k * dy / pixels));
            if (std::abs(next - before) > highest) {
                highest = std::abs(next - before);
                end = before;
            }
            before = next;
        }
        return end;
    }

    void take_means() {
        for (std::uint32_t k = 0; k < rims_.count(); ++k) {
            rims_[k].far = ends_[k].far.value();
            rims_[k].near = ends_[k].near.value();
            rims_[k].faces = ends_[k].faces.value();
        }
    }

    /// Takes what is not known at a corner from the other ones. Whether there was something.
    bool complete(const OutlineCell& cell) {
        bool changed = false;
        for (std::size_t k = 0; k < 4; ++k) {
            Rim& corner = rims_[cell.rims[k]];
            const bool wants_far = cell.face[k] != Face::far && !corner.far;
            const bool wants_near = cell.face[k] != Face::near && !corner.near;
            if (corner.faces && !wants_far && !wants_near) continue;
            for (const std::uint32_t number : cell.rims) {
                const Rim& other = rims_[number];
                changed = take(corner.faces, other.faces) || changed;
                if (wants_far && take(corner.far, other.far)) {
                    corner.far_source = other.far_source;
                    corner.outward = other.outward;
                    changed = true;
                }
                if (wants_near && take(corner.near, other.near)) {
                    corner.near_source = other.near_source;
                    changed = true;
                }
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
                    if (other.near && std::abs(*other.near - *rim.near) < kSameEnd_px)
                        mean.add(*other.near);
                });
                rim.near = mean.value();
            }
        }
    }

    const CutRelief& relief_;
    const ReliefGrid& grid_;
    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    FaceColour colour_;
    Rims& rims_;
    std::vector<Ends> ends_{};  // of each rim
};

}  // namespace

std::vector<OutlineCell> join_faces(const CutRelief& relief, Rims& rims) {
    return FaceJoiner(relief, rims).run();
}

}  // namespace dibhr
