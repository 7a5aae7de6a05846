// One picture: backdrop, relief, markers, in the bound framebuffer or off-screen.
#include "render/scene_view.hpp"

#include <algorithm>
#include <cstddef>

#include "render/gl_objects.hpp"
#include "render/marker_pass.hpp"
#include "render/relief_pass.hpp"
#include "shader_sources.hpp"

namespace dibhr {
namespace {

/// The wall behind the relief: its colours at the upper and lower end.
struct Wall {
    glm::vec3 top, bottom;
};
constexpr Wall kDarkWall{{0.165F, 0.172F, 0.190F}, {0.055F, 0.058F, 0.066F}};
constexpr Wall kLightWall{{0.90F, 0.91F, 0.92F}, {0.76F, 0.77F, 0.79F}};

constexpr int kSamples = 4;  // for each pixel off-screen; by software, four times the work

}  // namespace

struct SceneView::Objects {
    GlLimits limits{read_limits()};
    ReliefPass relief{limits};
    MarkerPass markers{};
    ShaderProgram backdrop{shaders::kBackdropVert, shaders::kBackdropFrag};
    GlVertexArray no_vertices{};
};

SceneView::SceneView() : objects_(std::make_unique<Objects>()) {}
SceneView::~SceneView() = default;

void SceneView::draw(const SceneContent& content, const Camera& camera, glm::ivec2 size) {
    if (size.x <= 0 || size.y <= 0) return;
    glViewport(0, 0, size.x, size.y);
    glScissor(0, 0, size.x, size.y);
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);

    const double aspect = static_cast<double>(size.x) / size.y;
    const glm::mat4 clip_from_world(camera.clip_from_view(aspect) * camera.view_from_world());
    if (content.depth.makes_surface()) objects_->relief.draw(content, clip_from_world);
    // After the relief, so that it fills only pixels without relief.
    objects_->backdrop.use();
    objects_->backdrop.set("height_px", static_cast<float>(size.y));
    const Wall& wall = content.light_wall ? kLightWall : kDarkWall;
    objects_->backdrop.set("top", wall.top);
    objects_->backdrop.set("bottom", wall.bottom);
    glBindVertexArray(objects_->no_vertices.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (content.depth.makes_surface()) objects_->relief.draw_outlines(content, clip_from_world);
    objects_->markers.draw(content.markers, camera, size);

    glBindVertexArray(0);
    glUseProgram(0);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
}

ColourImage SceneView::capture(const SceneContent& content, const Camera& camera, glm::ivec2 size) {
    const int samples =
        objects_->limits.software ? 0 : std::min(kSamples, objects_->limits.samples);
    Offscreen offscreen(size, samples);
    draw(content, camera, size);
    offscreen.resolve();
    return read_framebuffer(size);
}

ColourImage read_framebuffer(glm::ivec2 size) {
    ColourImage image;
    image.columns = std::max(size.x, 0);
    image.rows = std::max(size.y, 0);
    const std::size_t row_bytes = static_cast<std::size_t>(image.columns) * 3;
    image.rgb.resize(row_bytes * static_cast<std::size_t>(image.rows));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.columns, image.rows, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    // OpenGL counts rows from the bottom.
    for (int j = 0; j < image.rows / 2; ++j) {
        const auto top = image.rgb.begin() + static_cast<std::ptrdiff_t>(row_bytes) * j;
        const auto bottom =
            image.rgb.begin() + static_cast<std::ptrdiff_t>(row_bytes) * (image.rows - 1 - j);
        std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row_bytes), bottom);
    }
    return image;
}

void clear_area(glm::ivec2 lower_left, glm::ivec2 size, glm::vec3 colour) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(lower_left.x, lower_left.y, size.x, size.y);
    glClearColor(colour.x, colour.y, colour.z, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace dibhr
