// Draws the textured relief and its walls.
#include "render/relief_pass.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
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
    kElevationsUnit,
    kDetailUnit,
    kCutUnit,
    kUnseenUnit,
    kBumpUnit,
    kHeightsUnit,
    kColourUnit  ///< the first of FrameTexture::kUnits
};

void bind(GLint unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
}

void use_vertices(const GlVertexArray& array, const GlBuffer& buffer) {
    glBindVertexArray(array.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_SHORT, sizeof(GridVertex), nullptr);
}

void fill_vertices(const GlVertexArray& array, const GlBuffer& buffer,
                   const std::vector<GridVertex>& vertices) {
    use_vertices(array, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(GridVertex)),
                 vertices.data(), GL_STATIC_DRAW);
}

void upload_indices(const GlVertexArray& array, const GlBuffer& buffer,
                    const std::vector<std::uint32_t>& indices, GLenum usage) {
    glBindVertexArray(array.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
                 usage);
}

void upload(const LayerMesh& mesh, const SilhouetteLayer& layer) {
    const std::vector<LayerVertex>& vertices = layer.vertices;
    upload_indices(mesh.array, mesh.indices, layer.indices, GL_STREAM_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.get());
    constexpr GLsizei kBytes = sizeof(LayerVertex);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(LayerVertex)),
                 vertices.data(), GL_STREAM_DRAW);
    for (GLuint attribute = 0; attribute < 4; ++attribute) glEnableVertexAttribArray(attribute);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_SHORT, kBytes,
                           attribute_offset(offsetof(LayerVertex, corner)));
    glVertexAttribIPointer(1, 2, GL_UNSIGNED_SHORT, kBytes,
                           attribute_offset(offsetof(LayerVertex, source)));
    glVertexAttribPointer(2, 3, GL_FLOAT, GL_FALSE, kBytes,
                          attribute_offset(offsetof(LayerVertex, elevation_px)));
    glVertexAttribPointer(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, kBytes,
                          attribute_offset(offsetof(LayerVertex, fill)));
}

void draw_layer(const LayerMesh& mesh, const SilhouetteLayer& layer) {
    glBindVertexArray(mesh.array.get());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(layer.indices.size()), GL_UNSIGNED_INT,
                   nullptr);
}

/// Where the picture is seen from, homogeneous: w is 0 for parallel rays.
glm::vec4 eye_in_grid(const glm::mat4& clip_from_world, const ReliefGrid& grid) {
    const glm::vec4 eye = glm::inverse(clip_from_world) * glm::vec4(0.0F, 0.0F, -1.0F, 0.0F);
    const float sign = eye.w < 0.0F || (eye.w == 0.0F && eye.z < 0.0F) ? -1.0F : 1.0F;
    const float half_columns = 0.5F * static_cast<float>(grid.image_columns - 1);
    const float half_rows = 0.5F * static_cast<float>(grid.image_rows - 1);
    return sign * glm::vec4(eye.x + eye.w * half_columns, eye.w * half_rows - eye.y, eye.z, eye.w);
}

}  // namespace

void ReliefPass::draw(const SceneContent& content, const glm::mat4& clip_from_world) {
    const DepthImage& image = *content.depth.from->drawn();
    ReliefGrid grid = plan_grid(image.columns, image.rows,
                                limits_.software ? kMostVerticesSoftware : kMostVerticesHardware,
                                limits_.texture_side);
    if (!grid.drawable()) {
        layers_ = {};
        layers_of_.reset();
        return;
    }
    if (content.relief_style.coarse) grid.step *= 2;
    if (grid != grid_) build(grid);

    const Variant variant = variant_for(content);
    lift(content, variant);
    cut(content, variant, clip_from_world);
    bind_textures(content, variant);

    use_program(variant, content, clip_from_world);
    draw_surface();

    if (variant.silhouettes && !layers_.behind.indices.empty()) {
        Variant behind = variant;
        behind.behind = true;
        use_program(behind, content, clip_from_world);
        draw_layer(behind_, layers_.behind);
        draw_layer(under_, layers_.under);
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

void ReliefPass::draw_outlines(const SceneContent& content, const glm::mat4& clip_from_world) {
    Variant front = variant_for(content);
    if (!front.silhouettes || layers_.front.indices.empty()) return;
    front.front = true;
    use_program(front, content, clip_from_world);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_layer(front_, layers_.front);
    glDisable(GL_BLEND);
}

ReliefPass::Variant ReliefPass::variant_for(const SceneContent& content) const {
    Variant variant;
    variant.rough = content.bump != nullptr && content.shape.roughness_px != 0.0;
    variant.painted = content.maps && content.maps->at_vertices.columns == grid_.image_columns &&
                      content.maps->at_vertices.rows == grid_.image_rows;
    const bool textured = content.relief_style.paint == ReliefPaint::video &&
                          content.colour != nullptr && content.colour->has_colour();
    if (textured) variant.colour_textures = textures_of(*content.colour, limits_);
    variant.by_depth = depth_colours(content.relief_style.paint) != nullptr;
    variant.look = !content.look.is_plain() && !variant.by_depth;
    variant.silhouettes = content.relief_style.discard_silhouettes;
    variant.unseen = content.depth.nearest().unseen != nullptr;
    return variant;
}

void ReliefPass::build(const ReliefGrid& grid) {
    const GridMesh mesh = tile_grid(grid);
    fill_vertices(surface_, surface_vertices_, mesh.vertices);
    use_vertices(rest_, surface_vertices_);
    upload_indices(surface_, surface_indices_, mesh.indices, GL_STATIC_DRAW);
    index_count_ = static_cast<std::uint32_t>(mesh.indices.size());
    tiles_ = mesh.tiles;

    const std::vector<GridVertex> strip = border_strip(grid);
    fill_vertices(wall_, wall_vertices_, strip);
    wall_count_ = static_cast<GLsizei>(strip.size());
    grid_ = grid;
    detail_grid_ =
        plan_grid(grid.image_columns, grid.image_rows, kMostDetail, limits_.texture_side);
    if (detail_grid_.step >= grid.step) detail_grid_ = grid;
}

void ReliefPass::lift(const SceneContent& content, const Variant& variant) {
    DepthBlend depth = content.depth;
    depth.blend = std::clamp(depth.blend, 0.0, 1.0);
    const double px_per_level = content.shape.relief_px / depth.from->drawn()->highest_level;
    if (depth_.show(depth, px_per_level, grid_)) cut_slope_ = 0.0;
    if (variant.silhouettes && detail_grid_ != grid_)
        detail_.show(depth, px_per_level, detail_grid_);
}

/// Finds cuts and layers again where they may have changed: while only the hand moves, they stay.
void ReliefPass::cut(const SceneContent& content, const Variant& variant,
                     const glm::mat4& clip_from_world) {
    if (!variant.silhouettes) {
        uncut_ = {.whole = {{0, index_count_}}};
        cut_slope_ = 0.0;
        return;
    }
    const DepthImage& from = *content.depth.from->drawn();
    const BlendedDepth depth{from, *content.depth.to->drawn(),
                             std::clamp(content.depth.blend, 0.0, 1.0),
                             content.shape.relief_px / from.highest_level};
    if (const double slope = content.relief_style.silhouette_slope; slope != cut_slope_) {
        find_cuts(depth, grid_, depth_.elevations(), slope, cuts_);
        cut_.upload(grid_.columns(), grid_.rows(), cuts_.around.data());
        leave_out(cuts_.cut, grid_, tiles_, uncut_);
        upload_indices(rest_, rest_indices_, uncut_.rest, GL_STREAM_DRAW);
        cut_slope_ = slope;
        layers_of_.reset();
    }
    const Frame* const colour = variant.colour_textures > 0 ? content.colour : nullptr;
    const LayerSource source{ObjectMark(colour != nullptr ? colour->colour_object() : nullptr),
                             eye_in_grid(clip_from_world, grid_)};
    if (layers_of_ == source) return;
    build_layers({depth, grid_, depth_.elevations(), cuts_, colour, source.eye}, layers_);
    upload(behind_, layers_.behind);
    upload(under_, layers_.under);
    upload(front_, layers_.front);
    layers_of_ = source;
}

void ReliefPass::draw_surface() const {
    glBindVertexArray(surface_.get());
    for (const IndexRun& run : uncut_.whole)
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.count), GL_UNSIGNED_INT,
                       attribute_offset(run.first * sizeof(std::uint32_t)));
    if (uncut_.rest.empty()) return;
    glBindVertexArray(rest_.get());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(uncut_.rest.size()), GL_UNSIGNED_INT,
                   nullptr);
}

void ReliefPass::bind_textures(const SceneContent& content, const Variant& variant) {
    // Uploads bind to the active unit, so all uploads come before the units are set.
    const GLuint unseen =
        variant.unseen ? unseen_.show(content.depth.nearest().unseen, detail_grid_) : 0;
    const GLuint bump = variant.rough ? bump_.show(*content.bump, content.shape.bump_size_px,
                                                   *content.depth.from->drawn(), grid_)
                                      : 0;
    const GLuint heights = variant.painted ? heights_.show(content.maps, grid_) : 0;
    const int most_side = limits_.software ? std::min(kMostColourSideSoftware, limits_.texture_side)
                                           : limits_.texture_side;
    if (variant.colour_textures > 0) colour_.show(*content.colour, most_side, limits_);
    const GLuint ramp =
        variant.by_depth
            ? depth_colours_.show(depth_colours(content.relief_style.paint), most_side, false)
            : 0;
    bind(kElevationsUnit, depth_.name());
    bind(kDetailUnit, detail_grid_ != grid_ ? detail_.name() : depth_.name());
    bind(kCutUnit, cut_.name());
    bind(kUnseenUnit, unseen);
    bind(kBumpUnit, bump);
    bind(kHeightsUnit, heights);
    bind(kColourUnit, ramp);
    if (variant.colour_textures > 0) colour_.bind(kColourUnit);
}

const ShaderProgram& ReliefPass::use_program(const Variant& variant, const SceneContent& content,
                                             const glm::mat4& clip_from_world) {
    auto& program = programs_[variant];
    if (!program) {
        std::string defines;
        if (variant.wall) defines += "#define WALL\n";
        if (variant.behind) defines += "#define LAYER\n#define BEHIND\n";
        if (variant.front) defines += "#define LAYER\n#define FRONT\n";
        if (variant.rough) defines += "#define ROUGH\n";
        if (variant.painted) defines += "#define PAINTED\n";
        if (variant.look) defines += "#define LOOK\n";
        if (variant.colour_textures > 0)
            defines += "#define TEXTURED " + std::to_string(variant.colour_textures) + "\n";
        if (variant.by_depth) defines += "#define BY_DEPTH\n";
        if (variant.unseen) defines += "#define UNSEEN\n";
        if (variant.silhouettes) defines += "#define SILHOUETTES\n";
        program =
            std::make_unique<ShaderProgram>(shaders::kReliefVert, shaders::kReliefFrag, defines);
    }
    const DepthImage& image = *content.depth.from->drawn();
    program->use();
    program->set("elevations", kElevationsUnit);
    program->set("detail", kDetailUnit);
    program->set("cut_around", kCutUnit);
    program->set("unseen", kUnseenUnit);
    program->set("bump", kBumpUnit);
    program->set("heights", kHeightsUnit);
    program->set("side", content.light_wall ? kLightSide : kDarkSide);
    colour_.set(*program, kColourUnit);
    program->set("relief_px", static_cast<float>(content.shape.relief_px));
    program->set("roughness_px", static_cast<float>(content.shape.roughness_px));
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
    program->set("tint", glm::vec4(content.look.tint, content.look.tint_share));
    program->set("finish", glm::vec2(content.look.gloss, content.look.fuzz));
    program->set("clip_from_world", clip_from_world);
    return *program;
}

}  // namespace dibhr
