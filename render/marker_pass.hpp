// Draws the markers over the relief: clear where they are in sight, faint where the relief hides
// them.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "render/gl_objects.hpp"
#include "render/markers.hpp"

namespace dibhr {

class MarkerPass {
  public:
    MarkerPass();

    /// Into a framebuffer that holds the relief's depth.
    void draw(const TouchMarkers& touch, const Camera& camera, glm::ivec2 size);

  private:
    void draw_cone(const FrictionCone& cone, const glm::mat4& clip_from_world) const;
    void draw_strokes(std::vector<Stroke> strokes, const glm::mat4& view_from_world,
                      const glm::mat4& clip_from_view, glm::ivec2 size);

    ShaderProgram stroke_program_;
    ShaderProgram cone_program_;
    GlVertexArray stroke_array_{};
    GlBuffer stroke_buffer_{};
    GlVertexArray cone_array_{};
};

}  // namespace dibhr
