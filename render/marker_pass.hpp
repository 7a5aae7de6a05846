// The markers: which strokes show what the hand does, and how they are drawn over the relief, clear
// where they are in sight, faint where the relief hides them.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "render/camera.hpp"
#include "render/gl_objects.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// A rounded line between two balls in world space (one ball when both ends are the same).
struct MarkerStroke {
    glm::vec4 ball_a{0.0F};  ///< centre [world], radius [screen px]
    glm::vec4 ball_b{0.0F};
    glm::vec4 tint{1.0F};  ///< red, green, blue, opacity
    float hollow{0.0F};    ///< inner radius of a ring as a part of its radius; 0: solid
    float dash{0.0F};      ///< from dash to dash [screen px]; 0: one line
    float share{1.0F};     ///< of a ring: clockwise from the top
};

/// Proxy: a blue ball. Goal: an orange ring. Spring: a thin grey line. Normal: a thin green line.
/// Force: a yellow arrow from the proxy. Recorded proxy: a pale ball. While the proxy catches up
/// it has a thin ring around it, and the line is dashed and there in the air too. A fingertip:
/// three dashed circles around its ball, and a green ball where it touches. Another algorithm's
/// proxy: a smaller ball and a line to the goal. Nothing when the markers are not
/// visible. `scale` 1 suits a picture 800 pixels high.
[[nodiscard]] std::vector<MarkerStroke> touch_strokes(const TouchMarkers& touch,
                                                      const Camera& camera, double scale);

/// The friction cone in world space: apex at the goal, opening atan(mu), as high as the goal is
/// deep, so that its rim is where the proxy may rest without slipping.
struct FrictionCone {
    glm::vec3 apex{0.0F};
    glm::vec3 axis{0.0F};  ///< from the apex to the middle of the rim
    glm::vec3 rim_u{0.0F};
    glm::vec3 rim_v{0.0F};
};

/// Nothing out of contact, without friction, when there is no depth to show, or while the proxy
/// catches up: where it will rest is not on the plane it is on.
[[nodiscard]] std::optional<FrictionCone> friction_cone(const TouchMarkers& touch,
                                                        const Camera& camera);

class MarkerPass {
  public:
    MarkerPass();

    /// Into a framebuffer that holds the relief's depth.
    void draw(const TouchMarkers& touch, const Camera& camera, glm::ivec2 size);

  private:
    void draw_cone(const FrictionCone& cone, const glm::mat4& clip_from_world) const;
    void draw_strokes(std::vector<MarkerStroke> strokes, const glm::mat4& view_from_world,
                      const glm::mat4& clip_from_view, glm::ivec2 size);

    ShaderProgram stroke_program_;
    ShaderProgram cone_program_;
    GlVertexArray stroke_array_{};
    GlBuffer stroke_buffer_{};
    GlVertexArray cone_array_{};
};

}  // namespace dibhr
