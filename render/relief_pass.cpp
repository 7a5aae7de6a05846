// Draws the textured relief and its walls.
#include "render/relief_pass.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shader_sources.hpp"

namespace dibhr {
namespace {

constexpr std::size_t kMostVerticesHardware = 1'000'000;
constexpr std::size_t kMostVerticesSoftware = 50'000;  // llvmpipe: 0.15 us a triangle, all in all
constexpr std::size_t kMostDetail = 1'000'000;         // vertices of `detail_`
constexpr int kMostColourSideSoftware = 2048;          // an upload costs processor time there
constexpr double kGroundDepth = 0.03;                  // of the image's width, below level 0
// Like the wall behind the relief, since an outline around the picture would distract.
constexpr glm::vec3 kDarkSide{0.125F, 0.130F, 0.140F};
constexpr glm::vec3 kLightSide{0.64F, 0.65F, 0.67F};

enum Unit : GLint {
    kDepthFromUnit,
    kDepthToUnit,
    kDetailFromUnit,
    kDetailToUnit,
    kTornUnit,
    kUnseenUnit,
    kBumpUnit,
    kHeightsUnit,
    kColourUnit
};

void bind(GLint unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
}

void fill_vertices(const GlVertexArray& array, const GlBuffer& buffer,
                   const std::vector<GridVertex>& vertices) {
    glBindVertexArray(array.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(GridVertex)),
                 vertices.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_SHORT, sizeof(GridVertex), nullptr);
}

}  // namespace

void ReliefPass::draw(const SceneContent& content, const glm::mat4& clip_from_world) {
    const DepthImage& image = *content.depth.from->drawn();
    ReliefGrid grid = plan_grid(image.columns, image.rows,
                                limits_.software ? kMostVerticesSoftware : kMostVerticesHardware,
                                limits_.texture_side);
    if (!grid.drawable()) return;
    if (content.relief_style.coarse) grid.step *= 2;
    if (grid != grid_) build(grid);

    Variant variant;
    variant.rough = content.bump != nullptr && content.shape.roughness_px != 0.0;
    variant.painted = content.maps && content.maps->at_vertices.columns == image.columns &&
                      content.maps->at_vertices.rows == image.rows;
    variant.textured = content.relief_style.paint == ReliefPaint::video && content.colour &&
                       content.colour->colour && !content.colour->colour->rgb.empty();
    variant.by_depth = depth_colours(content.relief_style.paint) != nullptr;
    variant.silhouettes = content.relief_style.discard_silhouettes;
    variant.unseen = content.depth.nearest().unseen != nullptr;
    if (variant.silhouettes) tear(content);
    bind_textures(content, variant);

    use_program(variant, content, clip_from_world);
    glBindVertexArray(surface_.get());
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);

    if (variant.silhouettes) {
        Variant rim = variant;
        rim.rim = true;
        rim.silhouettes = false;
        use_program(rim, content, clip_from_world);
        glBindVertexArray(rim_.get());
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(rims_.layers.size()));
    }

    Variant wall;
    wall.wall = true;
    wall.rough = variant.rough;
    wall.painted = variant.painted;
    use_program(wall, content, clip_from_world);
    glBindVertexArray(wall_.get());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, wall_count_);
    glActiveTexture(GL_TEXTURE0);
}

void ReliefPass::build(const ReliefGrid& grid) {
    const GridMesh mesh = tile_grid(grid);
    fill_vertices(surface_, surface_vertices_, mesh.vertices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, surface_indices_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                 mesh.indices.data(), GL_STATIC_DRAW);
    index_count_ = static_cast<GLsizei>(mesh.indices.size());

    const std::vector<GridVertex> strip = border_strip(grid);
    fill_vertices(wall_, wall_vertices_, strip);
    wall_count_ = static_cast<GLsizei>(strip.size());
    grid_ = grid;
    detail_grid_ =
        plan_grid(grid.image_columns, grid.image_rows, kMostDetail, limits_.texture_side);
    if (detail_grid_.step >= grid.step) detail_grid_ = grid;
}

void ReliefPass::tear(const SceneContent& content) {
    const DepthImage& from = *content.depth.from->drawn();
    const BlendedDepth depth{from, *content.depth.to->drawn(),
                             std::clamp(content.depth.blend, 0.0, 1.0),
                             content.shape.relief_px / from.highest_level};
    drawn_elevations(depth, grid_, elevations_);
    tear_rims(depth, grid_, elevations_, content.relief_style.silhouette_slope, rims_);
    torn_.upload(grid_.columns(), grid_.rows(), rims_.torn.data());
    glBindVertexArray(rim_.get());
    glBindBuffer(GL_ARRAY_BUFFER, rim_vertices_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rims_.layers.size() * sizeof(RimVertex)),
                 rims_.layers.data(), GL_STREAM_DRAW);
    for (GLuint attribute = 0; attribute < 3; ++attribute) glEnableVertexAttribArray(attribute);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_SHORT, sizeof(RimVertex),
                           attribute_offset(offsetof(RimVertex, corner)));
    glVertexAttribIPointer(1, 2, GL_UNSIGNED_SHORT, sizeof(RimVertex),
                           attribute_offset(offsetof(RimVertex, source)));
    glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, sizeof(RimVertex),
                          attribute_offset(offsetof(RimVertex, tolerance_px)));
}

void ReliefPass::bind_textures(const SceneContent& content, const Variant& variant) {
    // Uploads bind to the active unit, so all uploads come before the units are set.
    const auto depth = depth_.show(content.depth.from->drawn(), content.depth.to->drawn(), grid_);
    auto detail = depth;
    if (variant.silhouettes && detail_grid_ != grid_) {
        detail = detail_.show(content.depth.from->drawn(), content.depth.to->drawn(), detail_grid_);
    }
    const GLuint unseen =
        variant.unseen ? unseen_.show(content.depth.nearest().unseen, detail_grid_) : 0;
    const GLuint bump = variant.rough ? bump_.show(*content.bump, content.shape.bump_size_px,
                                                   *content.depth.from->drawn(), grid_)
                                      : 0;
    const GLuint heights = variant.painted ? heights_.show(content.maps, grid_) : 0;
    const int most_side = limits_.software ? std::min(kMostColourSideSoftware, limits_.texture_side)
                                           : limits_.texture_side;
    GLuint colour = 0;
    if (variant.textured)
        colour = colour_.show(content.colour->colour, most_side, !limits_.software);
    if (variant.by_depth)
        colour = depth_colours_.show(depth_colours(content.relief_style.paint), most_side, false);
    bind(kDetailFromUnit, detail.from);
    bind(kDetailToUnit, detail.to);
    bind(kDepthFromUnit, depth.from);
    bind(kDepthToUnit, depth.to);
    bind(kTornUnit, torn_.name());
    bind(kUnseenUnit, unseen);
    bind(kBumpUnit, bump);
    bind(kHeightsUnit, heights);
    bind(kColourUnit, colour);
}

const ShaderProgram& ReliefPass::use_program(const Variant& variant, const SceneContent& content,
                                             const glm::mat4& clip_from_world) {
    auto& program = programs_[variant];
    if (!program) {
        std::string defines;
        if (variant.wall) defines += "#define WALL\n";
        if (variant.rim) defines += "#define RIM\n";
        if (variant.rough) defines += "#define ROUGH\n";
        if (variant.painted) defines += "#define PAINTED\n";
        if (variant.textured) defines += "#define TEXTURED\n";
        if (variant.by_depth) defines += "#define BY_DEPTH\n";
        if (variant.unseen) defines += "#define UNSEEN\n";
        if (variant.silhouettes) defines += "#define SILHOUETTES\n";
        program =
            std::make_unique<ShaderProgram>(shaders::kReliefVert, shaders::kReliefFrag, defines);
    }
    const DepthImage& image = *content.depth.from->drawn();
    const double limit = content.relief_style.silhouette_slope;
    program->use();
    program->set("depth_from", kDepthFromUnit);
    program->set("depth_to", kDepthToUnit);
    program->set("detail_from", kDetailFromUnit);
    program->set("detail_to", kDetailToUnit);
    program->set("torn", kTornUnit);
    program->set("unseen", kUnseenUnit);
    program->set("bump", kBumpUnit);
    program->set("heights", kHeightsUnit);
    program->set("side", content.light_wall ? kLightSide : kDarkSide);
    program->set("colour", kColourUnit);
    program->set("blend", static_cast<float>(std::clamp(content.depth.blend, 0.0, 1.0)));
    program->set("px_per_level", static_cast<float>(content.shape.relief_px / image.highest_level));
    program->set("relief_px", static_cast<float>(content.shape.relief_px));
    program->set("roughness_px", static_cast<float>(content.shape.roughness_px));
    program->set("slope_limit", static_cast<float>(limit));
    program->set("ground_px", static_cast<float>(-kGroundDepth * image.columns));
    const Dent& dent = content.dent;
    program->set("dent", glm::vec4(dent.at.x, dent.at.y, std::max(dent.radius_px, 1.0),
                                   dent.radius_px > 0.0 ? dent.depth_px : 0.0));
    program->set("shadow", static_cast<float>(dent.radius_px > 0.0 ? dent.shadow : 0.0));
    program->set("grid_step", grid_.step);
    program->set("detail_step", detail_grid_.step);
    program->set("drawn", glm::ivec2(grid_.columns(), grid_.rows()));
    program->set("image", glm::ivec2(image.columns, image.rows));
    program->set("light", static_cast<float>(content.relief_style.light));
    program->set("clip_from_world", clip_from_world);
    return *program;
}

}  // namespace dibhr
