// The triangles of the layers that are drawn where the relief is cut.
#include "render/silhouette_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/outline_faces.hpp"
#include "render/silhouette_fill.hpp"
#include "render/silhouette_rims.hpp"

namespace dibhr {
namespace {

constexpr int kFarUnder = 12;         // rings; what is continued less far is hardly marked
constexpr float kSameEnd = 0.3F;      // of a step: ends that differ by more are of different faces
constexpr std::uint8_t kUnlit = 255;  // for a side, whose slope nobody knows
constexpr float kSteepFace = 8.0F;    // px/px; two corners of a face may differ by this
// The two triangles of a cell by the numbers of its corners.
constexpr std::array<std::size_t, 6> kTriangles{0, 2, 1, 1, 2, 3};

GridVertex vertex(GridPlace p) {
    return {static_cast<std::uint16_t>(p.i), static_cast<std::uint16_t>(p.j)};
}

std::array<std::uint8_t, 4> bytes(const std::optional<glm::vec3>& colour) {
    const glm::vec3 rgb = colour.value_or(glm::vec3(0.0F));
    const auto byte = [](float c) { return static_cast<std::uint8_t>(c + 0.5F); };
    return {byte(rgb.x), byte(rgb.y), byte(rgb.z), 0};
}

LayerVertex at_outline(const Rim& rim, float elevation_px, std::optional<GridPlace> source) {
    const glm::vec2 faces = rim.faces.value_or(glm::vec2(elevation_px));
    LayerVertex made{vertex(rim.at), vertex(source.value_or(rim.at)),
                     elevation_px,   faces.x,
                     faces.y,        bytes(rim.colour)};
    made.fill[3] = static_cast<std::uint8_t>(255 * std::min(rim.ring, kFarUnder) / kFarUnder);
    return made;
}

/// Adds a vertex to a triangle; `number`, from 1, is its number if it was added before, else 0.
void add(SilhouetteLayer& layer, std::uint32_t& number, const LayerVertex& vertex) {
    if (number == 0) {
        layer.vertices.push_back(vertex);
        number = static_cast<std::uint32_t>(layer.vertices.size());
    }
    layer.indices.push_back(number - 1);
}

class LayerMesher {
  public:
    LayerMesher(const CutRelief& relief, const Rims& rims, SilhouetteLayers& layers)
        : relief_(relief), rims_(rims), numbers_(rims.count()), layers_(layers) {}

    void add_cut_cell(const OutlineCell& cell) {
        for (std::size_t first = 0; first < kTriangles.size(); first += 3) {
            add_behind(cell, first);
            if (!has_one_front(cell, first)) continue;
            for (std::size_t n = first; n < first + 3; ++n) add_front(cell, kTriangles[n]);
        }
    }

    /// Adds the cells with a corner under the near face, row by row, since neighbours share shaded
    /// vertices.
    void add_cells_under() {
        std::vector<std::uint8_t> touched(relief_.elevations.size(), 0);
        for (std::uint32_t k = 0; k < rims_.count(); ++k) {
            const Rim& rim = rims_[k];
            if (!rim.far) continue;
            for (const GridPlace first : corners_of({rim.at.i - 1, rim.at.j - 1})) {
                if (rims_.inside(first) && rims_.inside({first.i + 1, first.j + 1}))
                    touched[rims_.index(first)] = 1;
            }
        }
        const auto end = touched.end();
        for (auto cell = std::find(touched.begin(), end, 1); cell != end;
             cell = std::find(cell + 1, end, 1))
            add_cell_under(static_cast<std::size_t>(cell - touched.begin()));
    }

  private:
    /// The numbers of a rim, from 1, as a vertex of the layers behind and in front, on its own face
    /// or on the other one, and of the layer under the near face; 0: none yet.
    struct Numbers {
        std::uint32_t behind_on_own{0}, behind_on_other{0}, front_on_own{0}, front_on_other{0};
        std::uint32_t under{0};
    };

    [[nodiscard]] LayerVertex on_own_face(const Rim& rim) const {
        LayerVertex made = at_outline(rim, rims_.elevation_px(rim.at), rim.at);
        made.fill =
            bytes(rim.own_colour ? rim.own_colour : rim.colour);  // its own face is not under
        return made;
    }

    /// The triangle of three corners from `first` on. From one face to another it is a side.
    void add_behind(const OutlineCell& cell, std::size_t first) {
        std::array<LayerVertex, 3> made{};
        for (std::size_t n = 0; n < 3; ++n) made[n] = behind_at(cell, kTriangles[first + n]);
        const auto [low, high] = std::minmax_element(
            made.begin(), made.end(), [](const LayerVertex& a, const LayerVertex& b) {
                return a.elevation_px < b.elevation_px;
            });
        const bool one_face = rims_.is_one_face(low->elevation_px, high->elevation_px);
        for (std::size_t n = 0; n < 3; ++n) {
            const std::size_t k = kTriangles[first + n];
            Numbers& numbers = numbers_[cell.rims[k]];
            std::uint32_t unshared = 0;
            std::uint32_t& shared =
                cell.face[k] == Face::far ? numbers.behind_on_own : numbers.behind_on_other;
            if (one_face)
                add_in_cell(layers_.behind, shared, cell, made[n]);
            else
                add(layers_.behind, unshared, side_of(made[n], *low));
        }
    }

    [[nodiscard]] LayerVertex behind_at(const OutlineCell& cell, std::size_t k) const {
        const Rim& rim = rims_[cell.rims[k]];
        if (cell.face[k] == Face::far) return on_own_face(rim);
        return at_outline(rim, rim.far.value_or(cell.ends_px.x), rim.far_source);
    }

    /// The side of a face that ends behind looks like what is behind it: nobody knows where that
    /// face really ends.
    [[nodiscard]] static LayerVertex side_of(LayerVertex made, const LayerVertex& behind) {
        made.source = behind.source;
        made.fill = behind.fill;
        made.fill[3] = kUnlit;
        return made;
    }

    void add_front(const OutlineCell& cell, std::size_t k) {
        Numbers& numbers = numbers_[cell.rims[k]];
        const Rim& rim = rims_[cell.rims[k]];
        if (cell.face[k] == Face::near)
            add_in_cell(layers_.front, numbers.front_on_own, cell, on_own_face(rim));
        else
            add_in_cell(layers_.front, numbers.front_on_other, cell,
                        at_outline(rim, near_in(cell, rim), rim.near_source));
    }

    /// False: a triangle has corners on a near face and on one between that and the far one, and
    /// would stand out as a splinter.
    [[nodiscard]] bool has_one_front(const OutlineCell& cell, std::size_t first) const {
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (std::size_t n = first; n < first + 3; ++n) {
            const std::size_t k = kTriangles[n];
            const Rim& rim = rims_[cell.rims[k]];
            const float end_px =
                cell.face[k] == Face::near ? rims_.elevation_px(rim.at) : cell.ends_px.y;
            low = std::min(low, end_px);
            high = std::max(high, end_px);
        }
        const float most = std::max(kSameEnd * (cell.ends_px.y - cell.ends_px.x),
                                    kSteepFace * static_cast<float>(rims_.grid().step));
        return high - low <= most;
    }

    /// Whether an end of a face around a vertex is the one in the cell, too.
    [[nodiscard]] static bool is_same(const OutlineCell& cell, float around_px, float in_cell_px) {
        return std::abs(around_px - in_cell_px) <= kSameEnd * (cell.ends_px.y - cell.ends_px.x);
    }
    /// A front that was joined to another step's would rise to it; behind, it would leave a gap.
    [[nodiscard]] static float near_in(const OutlineCell& cell, const Rim& rim) {
        return rim.near && is_same(cell, *rim.near, cell.ends_px.y) ? *rim.front : cell.ends_px.y;
    }

    /// Cells share a vertex, unless their steps are of different faces.
    static void add_in_cell(SilhouetteLayer& layer, std::uint32_t& number, const OutlineCell& cell,
                            LayerVertex made) {
        if (is_same(cell, made.far_px, cell.ends_px.x) &&
            is_same(cell, made.near_px, cell.ends_px.y)) {
            add(layer, number, made);
            return;
        }
        made.far_px = cell.ends_px.x;
        made.near_px = cell.ends_px.y;
        std::uint32_t unshared = 0;
        add(layer, unshared, made);
    }

    [[nodiscard]] Numbers& numbers_at(const Rim& rim) {
        return numbers_[static_cast<std::size_t>(&rim - &rims_[0])];
    }

    void add_cell_under(std::size_t number) {
        const std::array<GridPlace, 4> corners = corners_of(rims_.place(number));
        std::array<const Rim*, 4> rims{};
        for (std::size_t k = 0; k < 4; ++k) rims[k] = rims_.known(corners[k]);
        if (relief_.cuts.cut[number] > 0.0F && !is_two_deep(rims)) return;
        const auto is_under = [](const Rim* rim) { return rim != nullptr && rim->far; };
        const Rim& under = **std::find_if(rims.begin(), rims.end(), is_under);
        for (std::size_t k = 0; k < kTriangles.size(); k += 3) {
            const auto corner = [k](std::size_t n) { return kTriangles[k + n]; };
            const std::array<const Rim*, 3> of{rims[corner(0)], rims[corner(1)], rims[corner(2)]};
            if (std::none_of(of.begin(), of.end(), is_under)) continue;
            const Rim* const behind = farthest_of_two(of);
            for (std::size_t n = 0; n < 3; ++n) {
                std::uint32_t unshared = 0;
                if (!is_under(of[n]))
                    add_end_of_fill(corners[corner(n)], under);
                else if (behind != nullptr)
                    add(layers_.under, unshared, side_of(under_at(*of[n]), under_at(*behind)));
                else
                    add(layers_.under, numbers_at(*of[n]).under, under_at(*of[n]));
            }
        }
    }

    [[nodiscard]] static LayerVertex under_at(const Rim& rim) {
        return at_outline(rim, *rim.far, rim.far_source);
    }

    /// Where two faces meet under the near one, the farther of them; null: there is one.
    [[nodiscard]] const Rim* farthest_of_two(const std::array<const Rim*, 3>& corners) const {
        const Rim* low = nullptr;
        const Rim* high = nullptr;
        for (const Rim* const rim : corners) {
            if (rim == nullptr || !rim->far) continue;
            if (low == nullptr || *rim->far < *low->far) low = rim;
            if (high == nullptr || *rim->far > *high->far) high = rim;
        }
        return low == nullptr || rims_.is_one_face(*low->far, *high->far) ? nullptr : low;
    }

    /// Where the fill ends at the near face, so that there is no gap.
    void add_end_of_fill(GridPlace end, const Rim& from) {
        LayerVertex made = at_outline(from, rims_.elevation_px(end), from.far_source);
        made.corner = vertex(end);
        std::uint32_t unshared = 0;
        add(layers_.under, unshared, made);
    }

    /// Whether a cut cell has another face behind its far one.
    [[nodiscard]] static bool is_two_deep(const std::array<const Rim*, 4>& rims) {
        return std::any_of(rims.begin(), rims.end(),
                           [](const Rim* rim) { return rim->is_far && rim->far; });
    }

    const CutRelief& relief_;
    const Rims& rims_;
    std::vector<Numbers> numbers_;  // of each rim
    SilhouetteLayers& layers_;
};

}  // namespace

void build_layers(const CutRelief& relief, SilhouetteLayers& layers) {
    for (SilhouetteLayer* layer : {&layers.behind, &layers.under, &layers.front}) {
        layer->vertices.clear();
        layer->indices.clear();
    }
    if (relief.cuts.cells.empty()) return;
    Rims rims(relief);
    const std::vector<OutlineCell> cells = join_faces(relief, rims);
    fill_under(rims, FaceColour(relief.colour, relief.depth));
    LayerMesher mesher(relief, rims, layers);
    for (const OutlineCell& cell : cells) mesher.add_cut_cell(cell);
    mesher.add_cells_under();
}

}  // namespace dibhr
