// Builds the two layers that are drawn where the relief is cut.
#include "render/silhouette_layers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "core/video/frames/colour_image.hpp"

namespace dibhr {
namespace {

constexpr float kMostSlope = 4.0F;     // with which a face is continued [px/px]
constexpr float kSameFace_px = 10.0F;  // a larger difference is another face
constexpr int kSmoothings = 3;
constexpr int kEndSmoothings = 2;
constexpr float kSameEnd_px = 30.0F;
constexpr int kMostRings = 100;  // of vertices under the near face: bounds the work
constexpr int kMostPasses = 3;   // of vertices along an outline, that take a face from the next
constexpr float kLeastGap_px = 2.0F;  // between the near face and what is behind

struct Place {
    int i{0};
    int j{0};
};
using Corners = std::array<Place, 4>;

template <class Value>
struct Mean {
    Value sum{0.0F};
    float count{0.0F};

    void add(const Value& value) {
        sum += value;
        count += 1.0F;
    }
    [[nodiscard]] bool known() const { return count > 0.0F; }
    [[nodiscard]] Value value() const { return sum / count; }

    /// From another one, where this one is not known yet. Whether it was.
    bool take(const Mean& other) {
        if (known() || !other.known()) return false;
        add(other.value());
        return true;
    }
};

/// A drawn vertex at an outline, or under a near face.
struct Rim {
    Place at{};
    Mean<float> far{};         ///< of the face behind, where this vertex is not on it [px]
    Mean<float> near{};        ///< of the face in front, where this vertex is not on it [px]
    Mean<glm::vec2> faces{};   ///< far and near one, where they end at the outline [px]
    Mean<glm::vec3> colour{};  ///< of the face behind
    Place far_source{};        ///< a vertex of the face behind
    Place near_source{};
    bool has_own_colour{false};
    bool is_far{false};       ///< in a cut cell
    int ring{0};              ///< how many vertices from the outline, under the near face
    glm::vec2 outward{0.0F};  ///< from the near face
    /// Its number, from 1, as a vertex of the layer behind or in front, on its own face or on the
    /// other one; 0: none yet.
    std::uint32_t behind_on_own{0}, behind_on_other{0}, front_on_own{0}, front_on_other{0};
    std::uint32_t under{0};  ///< its number, from 1, in the layer under the near face
};

/// The colour of a face around a vertex, from pixels that are well inside of the face.
class FaceColour {
  public:
    explicit FaceColour(const CutRelief& relief)
        : image_(relief.colour), depth_(relief.depth.from), elevation_(relief.depth) {}

    /// The mean around a pixel of the depth image; nothing where an outline is near on all sides.
    [[nodiscard]] Mean<glm::vec3> around(int x, int y) const {
        Mean<glm::vec3> mean;
        if (image_ == nullptr || image_->rgb.empty()) return mean;
        const float face = elevation_(depth_.index(x, y));
        for (int dy = -kReach; dy <= kReach; dy += kApart) {
            for (int dx = -kReach; dx <= kReach; dx += kApart) {
                if (is_inside(x + dx, y + dy, face)) mean.add(pixel(x + dx, y + dy));
            }
        }
        return mean.count < kFewest ? Mean<glm::vec3>{} : mean;
    }

  private:
    static constexpr float kFewest = 4.0F;  // pixels; fewer are in the shade of the near face
    static constexpr int kReach = 6;        // pixels of the depth image
    static constexpr int kApart = 3;
    static constexpr int kFringe =
        2;  // beside an outline, where the colours of both sides are mixed

    [[nodiscard]] bool is_inside(int x, int y, float face) const {
        for (const auto& [dx, dy] :
             {std::pair{0, 0}, {-kFringe, 0}, {kFringe, 0}, {0, -kFringe}, {0, kFringe}}) {
            const int column = x + dx;
            const int row = y + dy;
            if (column < 0 || row < 0 || column >= depth_.columns || row >= depth_.rows)
                return false;
            if (std::abs(elevation_(depth_.index(column, row)) - face) > kSameFace_px) return false;
        }
        return true;
    }
    [[nodiscard]] glm::vec3 pixel(int x, int y) const {
        const auto column =
            static_cast<std::size_t>((2 * x + 1) * image_->columns / (2 * depth_.columns));
        const auto row = static_cast<std::size_t>((2 * y + 1) * image_->rows / (2 * depth_.rows));
        const std::uint8_t* rgb =
            &image_->rgb[3 * (row * static_cast<std::size_t>(image_->columns) + column)];
        return {rgb[0], rgb[1], rgb[2]};
    }

    const ColourImage* image_;
    const DepthImage& depth_;  // used for the size only
    PixelElevation elevation_;
};

class LayerBuilder {
  public:
    LayerBuilder(const CutRelief& relief, SilhouetteLayers& layers)
        : grid_(relief.grid),
          elevations_(relief.elevations),
          cuts_(relief.cuts),
          image_(relief.depth.from),
          elevation_(relief.depth),
          colour_(relief),
          eye_(relief.eye),
          columns_(grid_.columns()),
          rows_(grid_.rows()),
          layers_(layers) {}

    void run() {
        for (SilhouetteLayer* layer : {&layers_.behind, &layers_.under, &layers_.front}) {
            layer->vertices.clear();
            layer->indices.clear();
        }
        if (cuts_.cells.empty()) return;
        rim_number_.assign(elevations_.size(), 0);
        for (const std::size_t cell : cuts_.cells) join_faces(cell);
        // A cell may touch one face only.
        bool more = true;
        for (int pass = 0; more && pass < kMostPasses; ++pass) {
            more = false;
            for (const std::size_t cell : cuts_.cells) more = complete(cell) || more;
        }
        smooth_ends();
        fill_under();
        smooth_fill();
        for (const std::size_t cell : cuts_.cells) add_cut_cell(cell);
        add_cells_under();
    }

  private:
    enum class Face : std::uint8_t { far, near, between };

    /// The corners of a cell, and on which face each of them is.
    struct CellFaces {
        Corners corners{};
        std::array<Face, 4> face{};
    };

    [[nodiscard]] std::size_t index(Place p) const {
        return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(p.i);
    }
    [[nodiscard]] Place place(std::size_t index) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
    }
    [[nodiscard]] float at(Place p) const { return elevations_[index(p)]; }
    [[nodiscard]] bool inside(Place p) const {
        return p.i >= 0 && p.j >= 0 && p.i < columns_ && p.j < rows_;
    }
    [[nodiscard]] glm::vec2 in_image(Place p) const {
        return {static_cast<float>(grid_.image_i(p.i)), static_cast<float>(grid_.image_j(p.j))};
    }
    static Corners corners(Place first) {
        return {first, {first.i + 1, first.j}, {first.i, first.j + 1}, {first.i + 1, first.j + 1}};
    }

    Rim& rim(Place p) {
        std::uint32_t& number = rim_number_[index(p)];
        if (number == 0) {
            rims_.push_back({p});
            number = static_cast<std::uint32_t>(rims_.size());
        }
        return rims_[number - 1];
    }
    [[nodiscard]] const Rim* known_rim(Place p) const {
        const std::uint32_t number = rim_number_[index(p)];
        return number == 0 ? nullptr : &rims_[number - 1];
    }

    [[nodiscard]] CellFaces faces(std::size_t cell) const {
        CellFaces found{corners(place(cell)), {}};
        const float middle = middle_of(found.corners);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t vertex = index(found.corners[k]);
            found.face[k] = cuts_.between[vertex]          ? Face::between
                            : elevations_[vertex] > middle ? Face::near
                                                           : Face::far;
        }
        return found;
    }

    /// Half way between the highest and the lowest vertex on a face: of a cell, or, where a corner
    /// lies between the faces, of the cells around it.
    [[nodiscard]] float middle_of(const Corners& cell) const {
        const bool blurred = std::any_of(cell.begin(), cell.end(), [this](Place corner) {
            return cuts_.between[index(corner)];
        });
        const int more = blurred ? 1 : 0;
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (int j = std::max(cell[0].j - more, 0); j <= std::min(cell[3].j + more, rows_ - 1);
             ++j) {
            for (int i = std::max(cell[0].i - more, 0);
                 i <= std::min(cell[3].i + more, columns_ - 1); ++i) {
                if (cuts_.between[index({i, j})]) continue;
                low = std::min(low, at({i, j}));
                high = std::max(high, at({i, j}));
            }
        }
        return 0.5F * (low + high);
    }

    [[nodiscard]] int nearest(float image_px) const {
        return static_cast<int>(image_px / static_cast<float>(grid_.step) + 0.5F);
    }

    /// Gives each corner of a cut cell the elevation of the face that it is not on.
    void join_faces(std::size_t cell) {
        const CellFaces cell_faces = faces(cell);
        Mean<float> far;
        Mean<float> near;
        for (std::size_t to = 0; to < 4; ++to) {
            Rim& corner = rim(cell_faces.corners[to]);
            if (cell_faces.face[to] == Face::far && !corner.is_far) {
                corner.is_far = true;
                corner.colour =
                    colour_.around(grid_.image_i(corner.at.i), grid_.image_j(corner.at.j));
                corner.has_own_colour = corner.colour.known();
            }
            for (std::size_t k = 0; k < 4; ++k) {
                if (cell_faces.face[k] == cell_faces.face[to]) continue;
                const Place other = cell_faces.corners[k];
                const float end_px = end_of_face(other, corner.at);
                if (cell_faces.face[k] == Face::far) {
                    far.add(end_px);
                    corner.far.add(end_px);
                    corner.far_source = other;
                    corner.outward += in_image(other) - in_image(corner.at);
                } else if (cell_faces.face[k] == Face::near) {
                    near.add(end_px);
                    corner.near.add(end_px);
                    corner.near_source = other;
                }
            }
        }
        if (!far.known() || !near.known()) return;
        for (const Place corner : cell_faces.corners)
            rim(corner).faces.add({far.value(), near.value()});
    }

    /// The elevation of the face of `from` where it ends on the way to `to`: before the highest
    /// step from pixel to pixel [px].
    [[nodiscard]] float end_of_face(Place from, Place to) const {
        const int x = grid_.image_i(from.i);
        const int y = grid_.image_j(from.j);
        const int dx = grid_.image_i(to.i) - x;
        const int dy = grid_.image_j(to.j) - y;
        const int pixels = std::max(std::abs(dx), std::abs(dy));
        float end = at(from);
        float highest = 0.0F;
        float before = end;
        for (int k = 1; k <= pixels; ++k) {
            const float next = elevation_(image_.index(x + k * dx / pixels, y + k * dy / pixels));
            if (std::abs(next - before) > highest) {
                highest = std::abs(next - before);
                end = before;
            }
            before = next;
        }
        return end;
    }

    /// Takes what is not known at a corner from the other ones. Whether there was something.
    bool complete(std::size_t cell) {
        const CellFaces cell_faces = faces(cell);
        bool changed = false;
        for (std::size_t k = 0; k < 4; ++k) {
            Rim& corner = rim(cell_faces.corners[k]);
            for (const Place place : cell_faces.corners) {
                const Rim& other = rim(place);
                changed = corner.faces.take(other.faces) || changed;
                if (cell_faces.face[k] != Face::far && corner.far.take(other.far)) {
                    corner.far_source = other.far_source;
                    corner.outward = other.outward;
                    changed = true;
                }
                if (cell_faces.face[k] != Face::near && corner.near.take(other.near)) {
                    corner.near_source = other.near_source;
                    changed = true;
                }
            }
        }
        return changed;
    }

    /// How far what lies at `far_px` behind a vertex is seen beside it [px of the image].
    [[nodiscard]] glm::vec2 shift(Place vertex, float far_px) const {
        const glm::vec2 towards = glm::vec2(eye_) - eye_.w * in_image(vertex);
        const float above = eye_.z - eye_.w * far_px;
        return above > 0.0F ? towards * ((at(vertex) - far_px) / above) : glm::vec2(0.0F);
    }

    /// Continues the face behind under the near one, ring by ring, as far as it can be seen.
    void fill_under() {
        std::vector<std::size_t> frontier;
        for (std::size_t k = 0; k < rims_.size(); ++k) {
            const Rim& rim = rims_[k];
            if (rim.far.known() && glm::dot(rim.outward, shift(rim.at, rim.far.value())) > 0.0F)
                frontier.push_back(k);
        }
        std::size_t begin = 0;
        for (int ring = 1; ring <= kMostRings && begin < frontier.size(); ++ring) {
            const std::size_t end = frontier.size();
            for (std::size_t k = begin; k < end; ++k) {
                const Rim from = rims_[frontier[k]];
                const float reach = glm::length(shift(from.at, from.far.value()));
                if (static_cast<float>((ring - 1) * grid_.step) > reach) continue;
                for (const Place next :
                     {Place{from.at.i - 1, from.at.j}, Place{from.at.i + 1, from.at.j},
                      Place{from.at.i, from.at.j - 1}, Place{from.at.i, from.at.j + 1}}) {
                    if (!inside(next)) continue;
                    const Rim* known = known_rim(next);
                    if (known != nullptr && known->far.known()) continue;
                    if (continue_at(next, ring, from))
                        frontier.push_back(rim_number_[index(next)] - 1);
                }
            }
            begin = end;
        }
    }

    /// Evens out the fill where rings from different sides have met, and colours the vertices that
    /// have no colour of their own face.
    void smooth_fill() {
        for (int pass = 0; pass < kSmoothings; ++pass) {
            for (std::size_t k = 0; k < rims_.size(); ++k) {
                Rim& rim = rims_[pass % 2 == 0 ? k : rims_.size() - 1 - k];
                if (rim.has_own_colour) continue;
                const Continued around = continued_at(rim.at, kMostRings + 1);
                if (around.colour.known()) rim.colour = around.colour;
                if (rim.ring > 0 && at(rim.at) - around.far.value() >= kLeastGap_px)
                    rim.far = around.far;
            }
        }
    }

    /// Evens out the near face's end: it is steep there, so that its pixels end at many elevations.
    void smooth_ends() {
        for (int pass = 0; pass < kEndSmoothings; ++pass) {
            for (Rim& rim : rims_) {
                if (!rim.near.known()) continue;
                Mean<float> mean;
                each_known_around(rim.at, [&](const Rim& other) {
                    if (other.near.known() &&
                        std::abs(other.near.value() - rim.near.value()) < kSameEnd_px)
                        mean.add(other.near.value());
                });
                rim.near = mean;
            }
        }
    }

    template <class Visit>
    void each_known_around(Place middle, const Visit& visit) const {
        for (int j = std::max(middle.j - 1, 0); j <= std::min(middle.j + 1, rows_ - 1); ++j) {
            for (int i = std::max(middle.i - 1, 0); i <= std::min(middle.i + 1, columns_ - 1);
                 ++i) {
                if (const Rim* rim = known_rim({i, j})) visit(*rim);
            }
        }
    }

    struct Continued {
        Mean<float> far{};
        Mean<glm::vec3> colour{};
    };

    /// The mean of what is behind the vertices around that are in rings before `ring`.
    [[nodiscard]] Continued continued_at(Place middle, int ring) const {
        Continued mean;
        each_known_around(middle, [&](const Rim& around) {
            if (around.ring >= ring) return;
            if (around.far.known()) mean.far.add(around.far.value());
            if (around.colour.known()) mean.colour.add(around.colour.value());
        });
        return mean;
    }

    bool continue_at(Place next, int ring, const Rim& from) {
        const Continued mean = continued_at(next, ring);
        if (at(next) - mean.far.value() < kLeastGap_px) return false;
        Rim& added = rim(next);
        added.ring = ring;
        added.far = mean.far;
        if (!added.has_own_colour) added.colour = mean.colour;
        added.far_source = from.far_source;
        return true;
    }

    static GridVertex vertex(Place p) {
        return {static_cast<std::uint16_t>(p.i), static_cast<std::uint16_t>(p.j)};
    }
    static std::array<std::uint8_t, 4> bytes(const Mean<glm::vec3>& colour) {
        const glm::vec3 rgb = colour.known() ? colour.value() : glm::vec3(0.0F);
        const auto byte = [](float c) { return static_cast<std::uint8_t>(c + 0.5F); };
        return {byte(rgb.x), byte(rgb.y), byte(rgb.z), 255};
    }

    [[nodiscard]] LayerVertex behind(const Rim& rim, Face face) const {
        const bool elsewhere = face != Face::far && rim.far.known();
        return at_outline(rim, elsewhere ? rim.far.value() : at(rim.at),
                          elsewhere ? rim.far_source : rim.at);
    }

    [[nodiscard]] LayerVertex front(const Rim& rim, Face face) const {
        const bool elsewhere = face != Face::near && rim.near.known();
        return at_outline(rim, elsewhere ? rim.near.value() : at(rim.at),
                          elsewhere ? rim.near_source : rim.at);
    }

    static LayerVertex at_outline(const Rim& rim, float elevation_px, Place source) {
        const glm::vec2 faces = rim.faces.known() ? rim.faces.value() : glm::vec2(elevation_px);
        return {vertex(rim.at), vertex(source), elevation_px, faces.x, faces.y, bytes(rim.colour)};
    }

    static LayerVertex under(const Rim& rim) {
        return at_outline(rim, rim.far.value(), rim.far_source);
    }

    /// Where the fill ends at the near face, so that there is no gap.
    [[nodiscard]] LayerVertex end_of_fill(Place end, const Rim& from) const {
        LayerVertex made = at_outline(from, at(end), end);
        made.corner = vertex(end);
        return made;
    }

    static void add(SilhouetteLayer& layer, std::uint32_t& number, const LayerVertex& vertex) {
        if (number == 0) {
            layer.vertices.push_back(vertex);
            number = static_cast<std::uint32_t>(layer.vertices.size());
        }
        layer.indices.push_back(number - 1);
    }

    void add_cut_cell(std::size_t cell) {
        const CellFaces cell_faces = faces(cell);
        for (const std::size_t k : kTriangles) {
            Rim& corner = rim(cell_faces.corners[k]);
            const Face face = cell_faces.face[k];
            add(layers_.behind, face == Face::far ? corner.behind_on_own : corner.behind_on_other,
                behind(corner, face));
            add(layers_.front, face == Face::near ? corner.front_on_own : corner.front_on_other,
                front(corner, face));
        }
    }

    [[nodiscard]] bool is_under(Place p) const {
        const Rim* rim = known_rim(p);
        return rim != nullptr && rim->far.known();
    }

    /// Adds the cells with a corner under the near face.
    void add_cells_under() {
        std::vector<std::size_t> cells;
        for (const Rim& rim : rims_) {
            if (!rim.far.known()) continue;
            for (const Place first :
                 {Place{rim.at.i - 1, rim.at.j - 1}, Place{rim.at.i, rim.at.j - 1},
                  Place{rim.at.i - 1, rim.at.j}, rim.at}) {
                if (inside(first) && inside({first.i + 1, first.j + 1}))
                    cells.push_back(index(first));
            }
        }
        // Row by row, since neighbours share shaded vertices.
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        for (const std::size_t cell : cells) add_cell_under(cell);
    }

    void add_cell_under(std::size_t number) {
        const Corners cell = corners(place(number));
        if (cuts_.cut[number] > 0.0F && !is_two_deep(cell)) return;
        if (!can_be_seen(cell)) return;
        const auto under = std::find_if(cell.begin(), cell.end(),
                                        [this](Place corner) { return is_under(corner); });
        for (std::size_t k = 0; k < kTriangles.size(); k += 3) {
            const auto is_corner_under = [&](std::size_t n) {
                return is_under(cell[kTriangles[k + n]]);
            };
            if (!is_corner_under(0) && !is_corner_under(1) && !is_corner_under(2)) continue;
            for (std::size_t n = 0; n < 3; ++n) add_under(cell[kTriangles[k + n]], *under);
        }
    }

    void add_under(Place corner, Place from) {
        std::uint32_t unshared = 0;
        if (is_under(corner))
            add(layers_.under, rim(corner).under, under(rim(corner)));
        else
            add(layers_.under, unshared, end_of_fill(corner, rim(from)));
    }

    /// Whether a cut cell has another face behind its far one.
    [[nodiscard]] bool is_two_deep(const Corners& cell) const {
        return std::any_of(cell.begin(), cell.end(), [this](Place corner) {
            const Rim* rim = known_rim(corner);
            return rim->is_far && rim->far.known();
        });
    }

    /// Whether the near face leaves a part of what is behind it in this cell to be seen.
    [[nodiscard]] bool can_be_seen(const Corners& cell) const {
        return std::any_of(cell.begin(), cell.end(), [this](Place corner) {
            if (!is_under(corner)) return false;
            const float far = known_rim(corner)->far.value();
            const glm::vec2 seen = in_image(corner) + shift(corner, far);
            const Place middle{nearest(seen.x), nearest(seen.y)};
            const float half_way = 0.5F * (far + at(corner));
            for (int j = middle.j - 1; j <= middle.j + 1; ++j) {
                for (int i = middle.i - 1; i <= middle.i + 1; ++i) {
                    if (!inside({i, j}) || at({i, j}) < half_way) return true;
                }
            }
            return false;
        });
    }

    // The two triangles of a cell by the numbers of its corners.
    static constexpr std::array<std::size_t, 6> kTriangles{0, 2, 1, 1, 2, 3};

    const ReliefGrid& grid_;
    const std::vector<float>& elevations_;
    const SilhouetteCuts& cuts_;
    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    FaceColour colour_;
    glm::vec4 eye_;
    int columns_;
    int rows_;
    std::vector<std::uint32_t> rim_number_{};  // of each vertex, from 1; 0: none
    std::vector<Rim> rims_{};
    SilhouetteLayers& layers_;
};

}  // namespace

void build_layers(const CutRelief& relief, SilhouetteLayers& layers) {
    LayerBuilder(relief, layers).run();
}

}  // namespace dibhr
