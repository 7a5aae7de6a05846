// Draws one picture of the scene: the textured relief, and the markers of the touch.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/camera.hpp"
#include "render/relief_paint.hpp"
#include "render/surface_look.hpp"

namespace dibhr {

/// How the relief is drawn.
struct ReliefStyle {
    bool discard_silhouettes{true};  ///< cut the relief where find_cuts() finds a step:
    double silhouette_slope{12.0};   ///< its least elevation change from pixel to pixel [px/px]
    ReliefPaint paint{ReliefPaint::video};
    double light{0.6};   ///< 0: flat colour, 1: strong shading
    bool coarse{false};  ///< half as many columns and rows as this machine would draw otherwise
    bool dent{true};     ///< a dent with a soft shadow under the proxy; drawn only, not felt
    bool trace{true};    ///< dots at the contacts of the last seconds

    bool operator==(const ReliefStyle&) const = default;
};

/// A place of an earlier contact, on the current surface. Grid space.
struct TracePoint {
    Vec3 place{0.0};
    double strength{1.0};  ///< 1: just touched, 0: faded out

    bool operator==(const TracePoint&) const = default;
};

/// A dent as of a finger in skin: drawn only, not rendered to the hand. Grid space.
struct Dent {
    Vec3 at{0.0};           ///< on the surface
    double radius_px{0.0};  ///< of the dent; 0: none
    double depth_px{0.0};
    double shadow{0.0};  ///< 0: none, 1: black

    bool operator==(const Dent&) const = default;
};

/// The proxy of another algorithm for the same goal. Grid space.
struct OtherProxy {
    Vec3 place{0.0};
    glm::vec3 tint{1.0F};  ///< red, green, blue

    bool operator==(const OtherProxy&) const = default;
};

/// The state of the touch, for the markers. Grid space.
struct TouchMarkers {
    bool visible{false};
    bool contact{false};
    bool catching_up{false};  ///< the proxy has not yet reached its final place
    Vec3 goal{0.0}, proxy{0.0};
    Vec3 normal{0.0, 0.0, 1.0};  ///< of the surface under the proxy
    double friction{0.4};        ///< the coefficient of the friction cone
    Vec3 force_newton{0.0};      ///< as sent
    double newton_per_px{0.02};  ///< length of the force arrow
    double most_newton{0.0};     ///< full scale of the gauge around the proxy; 0: no gauge
    std::vector<TracePoint> trace{};
    std::optional<Vec3> recorded_proxy{};   ///< of a session, if `proxy` is computed again
    std::optional<glm::vec3> proxy_tint{};  ///< nothing: the proxy is blue
    std::vector<OtherProxy> others{};
    double finger_px{0.0};                 ///< radius of the ball whose lowest point is `proxy`
    std::optional<Vec3> finger_contact{};  ///< where the ball touches the drawn surface

    bool operator==(const TouchMarkers&) const = default;
};

/// Everything one picture needs; a view that owns nothing.
struct SceneContent {
    DepthBlend depth{};            ///< from/to may be null: only the backdrop is drawn
    const Frame* colour{nullptr};  ///< the frame whose colour is shown
    SurfaceShape shape{};
    const BumpMap* bump{nullptr};
    std::shared_ptr<const TouchMaps> maps{};  ///< whose heights are drawn; null: none
    ReliefStyle relief_style{};
    SurfaceLook look{};      ///< of the material; not in the colours of depth
    bool light_wall{false};  ///< behind the relief; else a dark one
    Dent dent{};
    TouchMarkers markers{};
};

/// Owns the OpenGL objects; needs a current OpenGL 3.3 core context from construction to
/// destruction. Throws DeviceError when the driver offers less. Large images are subsampled, more
/// so on software OpenGL. Depth and colour are uploaded only when the frame's images have changed.
class SceneView {
  public:
    SceneView();
    ~SceneView();
    SceneView(const SceneView&) = delete;
    SceneView& operator=(const SceneView&) = delete;

    /// Draws into the bound framebuffer, in a viewport of `size` pixels from its lower left corner.
    /// Leaves depth test, blending and scissors off, and nothing but textures bound.
    void draw(const SceneContent& content, const Camera& camera, glm::ivec2 size);

    /// The same picture drawn off-screen; rows from the top. Throws DeviceError when the driver
    /// cannot make a picture of this size.
    [[nodiscard]] ColourImage capture(const SceneContent& content, const Camera& camera,
                                      glm::ivec2 size);

  private:
    struct Objects;
    std::unique_ptr<Objects> objects_;
};

/// The picture in the bound framebuffer, rows from the top (for screenshots with panels).
[[nodiscard]] ColourImage read_framebuffer(glm::ivec2 size);

/// Fills an area of the bound framebuffer [px from its lower left] with an opaque colour. Leaves
/// the scissor test on, with this area.
void clear_area(glm::ivec2 lower_left, glm::ivec2 size, glm::vec3 colour);

}  // namespace dibhr
