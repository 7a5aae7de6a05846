// The markers: which strokes show the touch, and how they are drawn over the relief: opaque where
// they are visible, faint where the relief hides them.
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
    float hollow{0.0F};    ///< of a ring: inner radius / radius; 0: solid
    float dash{0.0F};      ///< from dash to dash [screen px]; 0: not dashed
    float share{1.0F};     ///< of a ring: the drawn part, clockwise from the top
};

/// Proxy: a blue ball. Goal: an orange ring. Spring: a thin grey line. Normal: a thin green line.
/// Force: a yellow arrow from the proxy. Recorded proxy: a pale ball. While the proxy catches up, a
/// thin ring is around it, and the spring is dashed and drawn even without contact. Fingertip:
/// three dashed circles on its ball, and a green ball at its contact. Another algorithm's proxy: a
/// smaller ball and a line to the goal. Empty if the markers are not visible. `scale` 1 is for a
/// picture 800 pixels high.
[[nodiscard]] std::vector<MarkerStroke> touch_strokes(const TouchMarkers& touch,
                                                      const Camera& camera, double scale);

/// The friction cone in world space: apex at the goal, opening atan(mu), as high as the goal is
/// deep. Inside its rim the proxy sticks.
struct FrictionCone {
    glm::vec3 apex{0.0F};
    glm::vec3 axis{0.0F};  ///< from the apex to the middle of the rim
    glm::vec3 rim_u{0.0F};
    glm::vec3 rim_v{0.0F};
};

/// Nothing without contact, friction or penetration, or while the proxy catches up: its final place
/// is then not on its current plane.
[[nodiscard]] std::optional<FrictionCone> friction_cone(const TouchMarkers& touch,
                                                        const Camera& camera);

class MarkerPass {
  public:
    MarkerPass();

    /// Draws into a framebuffer that has the relief's depth.
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
