// Writes a surface as the triangles that are touched: a coloured mesh, and a solid plate.
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/surface_files/pieces.hpp"

namespace dibhr {

namespace {

/// The column and row of a VERTEX.
using GridPlace = glm::ivec2;

/// Gives the corners of every TRIANGLE to `take`, anticlockwise as the viewer sees them.
template <typename Take>
void for_each_triangle(const DepthSurface& surface, Take&& take) {
    for (int j = 0; j + 1 < surface.rows(); ++j) {
        for (int i = 0; i + 1 < surface.columns(); ++i) {
            take(GridPlace{i, j}, GridPlace{i, j + 1}, GridPlace{i + 1, j});
            take(GridPlace{i + 1, j + 1}, GridPlace{i + 1, j}, GridPlace{i, j + 1});
        }
    }
}

std::uint64_t triangles_of(const DepthSurface& surface) {
    return 2 * static_cast<std::uint64_t>(surface.columns() - 1) *
           static_cast<std::uint64_t>(surface.rows() - 1);
}

/// The colour pixel at the centre of a VERTEX's pixel.
std::string_view colour_under(const ColourImage& colour, const DepthSurface& surface,
                              GridPlace at) {
    const auto scaled = [](int k, int count, int colours) {
        return static_cast<std::size_t>((2 * static_cast<std::int64_t>(k) + 1) * colours /
                                        (2 * static_cast<std::int64_t>(count)));
    };
    const std::size_t column = scaled(at.x, surface.columns(), colour.columns);
    const std::size_t row = scaled(at.y, surface.rows(), colour.rows);
    const std::size_t pixel = row * static_cast<std::size_t>(colour.columns) + column;
    return {reinterpret_cast<const char*>(colour.rgb.data()) + 3 * pixel, 3};
}

std::string ply_header(const DepthSurface& surface, bool has_colour) {
    const auto vertices =
        static_cast<std::uint64_t>(surface.columns()) * static_cast<std::uint64_t>(surface.rows());
    std::string text =
        "ply\nformat binary_little_endian 1.0\n"
        "comment millimetres: x to the right, y up, z to the viewer\n"
        "element vertex " +
        std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n";
    if (has_colour) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    return text + "element face " + std::to_string(triangles_of(surface)) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// The border's VERTICES, anticlockwise as the viewer sees them, from the lower left one.
std::vector<GridPlace> border_of(const DepthSurface& surface) {
    const int right = surface.columns() - 1;
    const int lowest = surface.rows() - 1;
    std::vector<GridPlace> border;
    border.reserve(2 * static_cast<std::size_t>(right + lowest));
    for (int i = 0; i < right; ++i) border.emplace_back(i, lowest);
    for (int j = lowest; j > 0; --j) border.emplace_back(right, j);
    for (int i = right; i > 0; --i) border.emplace_back(i, 0);
    for (int j = 0; j < lowest; ++j) border.emplace_back(0, j);
    return border;
}

/// A closed body of triangles, whose normals point outwards; its underside is at z = 0.
class Plate {
  public:
    Plate(const ExportedSurface& exported, OutputFile& file)
        : felt_(exported),
          lift_mm_(static_cast<float>(kPlate_mm - elevation_range(exported.surface).lowest_px *
                                                      exported.pixel_pitch_mm)),
          border_(border_of(exported.surface)),
          pieces_(file) {}

    void write() {
        constexpr std::size_t kHeader_bytes = 80;
        std::string header = "binary STL: a surface on a plate, millimetres";
        header.resize(kHeader_bytes);
        pieces_.add(header);
        pieces_.add(static_cast<std::uint32_t>(triangles_of(felt_.surface) + 3 * border_.size()));
        for_each_triangle(felt_.surface, [this](GridPlace a, GridPlace b, GridPlace c) {
            add(top(a), top(b), top(c));
        });
        add_walls_and_underside();
        pieces_.send();
    }

  private:
    [[nodiscard]] glm::vec3 top(GridPlace at) const {
        const glm::vec3 place = place_mm(felt_, at.x, at.y);
        return {place.x, place.y, place.z + lift_mm_};
    }

    /// The underside is a fan, so that it has no more corners on the border than the walls.
    void add_walls_and_underside() {
        const glm::vec3 corner = top({felt_.surface.columns() - 1, 0});
        const glm::vec3 middle{corner.x / 2.0F, corner.y / 2.0F, 0.0F};
        for (std::size_t k = 0; k < border_.size(); ++k) {
            const glm::vec3 here = top(border_[k]);
            const glm::vec3 next = top(border_[(k + 1) % border_.size()]);
            const glm::vec3 under_here{here.x, here.y, 0.0F};
            const glm::vec3 under_next{next.x, next.y, 0.0F};
            add(under_here, under_next, next);
            add(under_here, next, here);
            add(middle, under_next, under_here);
        }
    }

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        pieces_.add(glm::normalize(glm::cross(b - a, c - a)));
        pieces_.add(a);
        pieces_.add(b);
        pieces_.add(c);
        constexpr std::string_view kNoAttributes("\0\0", 2);
        pieces_.add(kNoAttributes);
    }

    const ExportedSurface& felt_;
    float lift_mm_;
    std::vector<GridPlace> border_;
    Pieces pieces_;
};

}  // namespace

void write_ply(const ExportedSurface& exported, OutputFile& file) {
    const DepthSurface& surface = exported.surface;
    const bool has_colour = exported.colour != nullptr && !exported.colour->rgb.empty();
    Pieces pieces(file);
    pieces.add(ply_header(surface, has_colour));
    for (int j = 0; j < surface.rows(); ++j) {
        for (int i = 0; i < surface.columns(); ++i) {
            pieces.add(place_mm(exported, i, j));
            if (has_colour) pieces.add(colour_under(*exported.colour, surface, {i, j}));
        }
    }
    const auto number_of = [&surface](GridPlace at) {
        return static_cast<std::uint32_t>(at.y) * static_cast<std::uint32_t>(surface.columns()) +
               static_cast<std::uint32_t>(at.x);
    };
    for_each_triangle(surface, [&](GridPlace a, GridPlace b, GridPlace c) {
        pieces.add("\3");
        for (const GridPlace corner : {a, b, c}) pieces.add(number_of(corner));
    });
    pieces.send();
}

void write_stl(const ExportedSurface& exported, OutputFile& file) {
    Plate(exported, file).write();
}

}  // namespace dibhr
