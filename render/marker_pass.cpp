// Draws the markers over the relief.
#include "render/marker_pass.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "shader_sources.hpp"

namespace dibhr {
namespace {

constexpr int kConeSegments = 64;
constexpr float kHiddenOpacity = 0.55F;  // of what lies behind the relief
constexpr double kScaleHeight_px = 800.0;

void stroke_attribute(GLuint location, GLint count, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(Stroke),
                          reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset)));
    glVertexAttribDivisor(location, 1);
}

}  // namespace

MarkerPass::MarkerPass()
    : stroke_program_(shaders::kStrokeVert, shaders::kStrokeFrag),
      cone_program_(shaders::kConeVert, shaders::kConeFrag) {
    glBindVertexArray(stroke_array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, stroke_buffer_.get());
    stroke_attribute(0, 4, offsetof(Stroke, ball_a));
    stroke_attribute(1, 4, offsetof(Stroke, ball_b));
    stroke_attribute(2, 4, offsetof(Stroke, tint));
    stroke_attribute(3, 1, offsetof(Stroke, hollow));
    glBindVertexArray(0);
}

void MarkerPass::draw(const TouchMarkers& touch, const Camera& camera, glm::ivec2 size) {
    const double scale = std::clamp(size.y / kScaleHeight_px, 0.6, 4.0);
    std::vector<Stroke> strokes = touch_strokes(touch, camera, scale);
    if (strokes.empty()) return;
    const glm::mat4 view(camera.view_from_world());
    const glm::mat4 clip(camera.clip_from_view(static_cast<double>(size.x) / size.y));

    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    if (const auto cone = friction_cone(touch, camera)) draw_cone(*cone, clip * view);
    draw_strokes(std::move(strokes), view, clip, size);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void MarkerPass::draw_cone(const FrictionCone& cone, const glm::mat4& clip_from_world) const {
    cone_program_.use();
    cone_program_.set("apex", cone.apex);
    cone_program_.set("axis", cone.axis);
    cone_program_.set("rim_u", cone.rim_u);
    cone_program_.set("rim_v", cone.rim_v);
    cone_program_.set("segments", kConeSegments);
    cone_program_.set("clip_from_world", clip_from_world);
    glBindVertexArray(cone_array_.get());
    const auto draw_where = [&](GLenum depth, float opacity) {
        glDepthFunc(depth);
        cone_program_.set("opacity", opacity);
        glDrawArrays(GL_TRIANGLES, 0, 3 * kConeSegments);
    };
    draw_where(GL_GREATER, kHiddenOpacity);
    draw_where(GL_LEQUAL, 1.0F);
}

void MarkerPass::draw_strokes(std::vector<Stroke> strokes, const glm::mat4& view_from_world,
                              const glm::mat4& clip_from_view, glm::ivec2 size) {
    // Soft edges blend with what lies behind them: far strokes first.
    const auto nearness = [&](const Stroke& s) {
        const glm::vec3 middle = 0.5F * (glm::vec3(s.ball_a) + glm::vec3(s.ball_b));
        return (view_from_world * glm::vec4(middle, 1.0F)).z;
    };
    std::stable_sort(strokes.begin(), strokes.end(),
                     [&](const Stroke& a, const Stroke& b) { return nearness(a) < nearness(b); });
    glBindBuffer(GL_ARRAY_BUFFER, stroke_buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(strokes.size() * sizeof(Stroke)),
                 strokes.data(), GL_STREAM_DRAW);
    stroke_program_.use();
    stroke_program_.set("view_from_world", view_from_world);
    stroke_program_.set("clip_from_view", clip_from_view);
    stroke_program_.set("viewport", glm::vec2(size));
    glBindVertexArray(stroke_array_.get());
    const auto draw_where = [&](GLenum depth, float opacity) {
        glDepthFunc(depth);
        stroke_program_.set("opacity", opacity);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(strokes.size()));
    };
    draw_where(GL_GREATER, kHiddenOpacity);
    draw_where(GL_LEQUAL, 1.0F);
}

}  // namespace dibhr
