// Draws the textured relief and its walls.
#pragma once

#include <compare>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "render/frame_texture.hpp"
#include "render/gl_objects.hpp"
#include "render/relief_grid.hpp"
#include "render/scene_view.hpp"
#include "render/silhouette_cuts.hpp"
#include "render/silhouette_layers.hpp"

namespace dibhr {

/// The OpenGL objects of a layer at silhouettes.
struct LayerMesh {
    GlVertexArray array{};
    GlBuffer vertices{};
    GlBuffer indices{};
};

class ReliefPass {
  public:
    explicit ReliefPass(const GlLimits& limits) : limits_(limits) {}

    /// `content.depth` has two frames with depth images of the same size.
    void draw(const SceneContent& content, const glm::mat4& clip_from_world);

    /// The near faces up to their smooth outlines, over what draw() has drawn and all that is
    /// behind the relief. For the same content.
    void draw_outlines(const SceneContent& content, const glm::mat4& clip_from_world);

  private:
    /// The options of a shader program; one program for each combination in use.
    struct Variant {
        bool wall{false};
        bool behind{false};
        bool front{false};
        bool rough{false};
        bool painted{false};
        bool look{false};
        int colour_textures{0};  ///< see textures_of(); 0: not in the video's colour
        bool by_depth{false};
        bool silhouettes{false};
        bool unseen{false};
        auto operator<=>(const Variant&) const = default;  // NOLINT(modernize-use-nullptr)
    };

    /// With the cuts, what the layers are built from.
    struct LayerSource {
        ObjectMark colour{};
        glm::vec4 eye{0.0F};
        bool operator==(const LayerSource&) const = default;
    };

    void build(const ReliefGrid& grid);
    void lift(const SceneContent& content, const Variant& variant);
    void cut(const SceneContent& content, const Variant& variant, const glm::mat4& clip_from_world);
    void draw_surface() const;
    [[nodiscard]] Variant variant_for(const SceneContent& content) const;
    void bind_textures(const SceneContent& content, const Variant& variant);
    const ShaderProgram& use_program(const Variant& variant, const SceneContent& content,
                                     const glm::mat4& clip_from_world);

    GlLimits limits_{};
    std::map<Variant, std::unique_ptr<ShaderProgram>> programs_{};
    ElevationTexture depth_{};
    ElevationTexture detail_{};  ///< at full resolution if possible, for the outlines
    UnseenTexture unseen_{};
    BumpTexture bump_{};
    HeightTexture heights_{};
    FrameTexture colour_{};
    ColourTexture depth_colours_{};
    ReliefGrid grid_{};
    ReliefGrid detail_grid_{};
    GlVertexArray surface_{};
    GlBuffer surface_vertices_{};
    GlBuffer surface_indices_{};
    GlVertexArray rest_{};  ///< the uncut cells of tiles with cut ones
    GlBuffer rest_indices_{};
    GlVertexArray wall_{};
    GlBuffer wall_vertices_{};
    LayerMesh behind_{};
    LayerMesh under_{};
    LayerMesh front_{};
    std::vector<GridTile> tiles_{};
    UncutMesh uncut_{};
    SilhouetteCuts cuts_{};
    double cut_slope_{0.0};  ///< with which cuts_ was found; 0: it was not
    SilhouetteLayers layers_{};
    std::optional<LayerSource> layers_of_{};
    GridTexture cut_{};
    std::uint32_t index_count_{0};  ///< of the whole surface
    GLsizei wall_count_{0};
};

}  // namespace dibhr
