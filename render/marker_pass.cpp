// The strokes of the markers, and how they are drawn over the relief.
#include "render/marker_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <utility>

#include "shader_sources.hpp"

namespace dibhr {

namespace {

// After Okabe and Ito's palette, which colour-blind people can distinguish; the shapes differ, too.
constexpr glm::vec4 kProxyTint{0.16F, 0.56F, 0.95F, 1.0F};
constexpr glm::vec4 kRecordedTint{0.88F, 0.92F, 0.98F, 0.85F};
constexpr glm::vec4 kFingerTint{0.16F, 0.56F, 0.95F, 0.9F};
constexpr glm::vec4 kGoalTint{0.95F, 0.55F, 0.05F, 1.0F};
constexpr glm::vec4 kSpringTint{0.86F, 0.86F, 0.86F, 1.0F};
constexpr glm::vec4 kNormalTint{0.10F, 0.78F, 0.60F, 1.0F};
constexpr glm::vec4 kForceTint{0.98F, 0.90F, 0.25F, 1.0F};
constexpr glm::vec4 kGaugeGround{0.30F, 0.30F, 0.26F, 0.55F};
constexpr glm::vec3 kTraceTint{0.45F, 0.74F, 1.0F};

// Radii on the screen [px] in a picture 800 pixels high.
constexpr double kProxyRadius = 7.0;
constexpr double kFingerRadius = 1.2;
constexpr double kFingerContactRadius = 4.5;
constexpr double kOtherRadius = 5.5;
constexpr double kOtherStep = 2.2;  // between proxies at one place
constexpr double kOtherLineRadius = 0.9;
constexpr float kOtherLineOpacity = 0.8F;
constexpr double kGoalRadius = 11.0;
constexpr float kGoalHollow = 0.66F;
constexpr double kCatchingUpRadius = 15.0;  // clear of the goal's ring when the proxy is there
constexpr float kCatchingUpHollow = 0.84F;
constexpr double kGaugeRadius = 22.0;  // clear of both rings
constexpr float kGaugeHollow = 0.85F;
constexpr double kTraceRadius = 2.0;
constexpr float kTraceOpacity = 0.8F;
constexpr double kSpringRadius = 1.4;
constexpr double kDash = 16.0;
constexpr double kNormalRadius = 1.6;
constexpr double kShaftRadius = 2.6;
constexpr double kHeadRadius = 7.5;

constexpr double kNormalLength_px = 60.0;  // grid
constexpr double kHeadLength_px = 16.0;    // grid; a short arrow has a shorter head
constexpr double kSamePlace_px = 0.5;      // grid
constexpr double kLeastForce_newton = 1e-3;
constexpr double kLeastConeHeight_px = 0.5;

glm::vec4 ball(const Camera& camera, Vec3 centre_in_grid, double radius) {
    return {glm::vec3(camera.world_from_grid(centre_in_grid)), static_cast<float>(radius)};
}

/// A direction of grid space in world space: y has the other sign.
Vec3 upright(Vec3 direction) {
    return {direction.x, -direction.y, direction.z};
}

/// Any unit vector at a right angle to this unit vector.
Vec3 perpendicular(Vec3 unit) {
    const Vec3 other = std::abs(unit.x) < 0.7 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(unit, other));
}

void add_force_arrow(std::vector<MarkerStroke>& strokes, const TouchMarkers& touch,
                     const Camera& camera, double scale) {
    const double newton = glm::length(touch.force_newton);
    if (!(newton > kLeastForce_newton) || !(touch.newton_per_px > 0.0)) return;
    const Vec3 direction = touch.force_newton / newton;
    const double length_px = newton / touch.newton_per_px;
    const double head_px = std::min(kHeadLength_px, 0.5 * length_px);
    const Vec3 tip = touch.proxy + direction * length_px;
    const Vec3 neck = tip - direction * head_px;
    const double slim = std::min(1.0, length_px / kHeadLength_px);  // weak forces, small arrows
    strokes.push_back({ball(camera, touch.proxy, kShaftRadius * scale),
                       ball(camera, neck, kShaftRadius * scale), kForceTint});
    strokes.push_back({ball(camera, neck, kHeadRadius * scale * slim),
                       ball(camera, tip, 0.8 * scale), kForceTint});
}

/// The force as a share of the force limit: a ring that always faces the viewer.
void add_force_gauge(std::vector<MarkerStroke>& strokes, const TouchMarkers& touch,
                     const Camera& camera, double scale) {
    const double newton = glm::length(touch.force_newton);
    if (!(newton > kLeastForce_newton) || !(touch.most_newton > 0.0)) return;
    const glm::vec4 around = ball(camera, touch.proxy, kGaugeRadius * scale);
    const auto share = static_cast<float>(std::min(newton / touch.most_newton, 1.0));
    strokes.push_back(
        {.ball_a = around, .ball_b = around, .tint = kGaugeGround, .hollow = kGaugeHollow});
    strokes.push_back({.ball_a = around,
                       .ball_b = around,
                       .tint = kForceTint,
                       .hollow = kGaugeHollow,
                       .share = share});
}

/// Dots at earlier contacts of the proxy, which fade with time.
void add_trace(std::vector<MarkerStroke>& strokes, const TouchMarkers& touch, const Camera& camera,
               double scale) {
    for (const TracePoint& point : touch.trace) {
        if (!is_finite(point.place)) continue;
        const glm::vec4 dot = ball(camera, point.place, kTraceRadius * scale);
        const float opacity = kTraceOpacity * static_cast<float>(point.strength);
        strokes.push_back({dot, dot, glm::vec4(kTraceTint, opacity)});
    }
}

/// The ball's three great circles, dashed.
void add_finger(std::vector<MarkerStroke>& strokes, const TouchMarkers& touch, const Camera& camera,
                double scale) {
    constexpr int kSegments = 72;  // every second is drawn, so that no two ends overlap
    const Vec3 centre = touch.proxy + Vec3(0.0, 0.0, touch.finger_px);
    const std::array<Vec3, 3> axes{Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)};
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const auto at = [&](int k) {
            const double angle = 2.0 * std::numbers::pi * k / kSegments;
            const Vec3 outwards =
                std::cos(angle) * axes[n] + std::sin(angle) * axes[(n + 1) % axes.size()];
            return ball(camera, centre + touch.finger_px * outwards, kFingerRadius * scale);
        };
        for (int k = 0; k < kSegments; k += 2) strokes.push_back({at(k), at(k + 1), kFingerTint});
    }
}

/// Each with a line to the goal. At one place each ball is larger than the next: all are visible.
void add_others(std::vector<MarkerStroke>& strokes, const TouchMarkers& touch, const Camera& camera,
                double scale) {
    const std::vector<OtherProxy>& others = touch.others;
    for (auto other = others.begin(); other != others.end(); ++other) {
        if (!is_finite(other->place)) continue;
        const auto on_it = std::count_if(std::next(other), others.end(), [&](const OtherProxy& o) {
            return glm::distance(o.place, other->place) < kSamePlace_px;
        });
        const double radius = kOtherRadius + kOtherStep * static_cast<double>(on_it);
        const glm::vec4 at = ball(camera, other->place, radius * scale);
        strokes.push_back({ball(camera, touch.goal, kOtherLineRadius * scale),
                           ball(camera, other->place, kOtherLineRadius * scale),
                           glm::vec4(other->tint, kOtherLineOpacity)});
        strokes.push_back({at, at, glm::vec4(other->tint, 1.0F)});
    }
}

constexpr int kConeSegments = 64;
constexpr float kHiddenOpacity = 0.55F;  // of marks behind the relief
constexpr double kScaleHeight_px = 800.0;

void stroke_attribute(GLuint location, GLint count, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(MarkerStroke),
                          attribute_offset(offset));
    glVertexAttribDivisor(location, 1);
}

}  // namespace

std::vector<MarkerStroke> touch_strokes(const TouchMarkers& touch, const Camera& camera,
                                        double scale) {
    std::vector<MarkerStroke> strokes;
    if (!touch.visible || !is_finite(touch.goal) || !is_finite(touch.proxy)) return strokes;
    const glm::vec4 goal = ball(camera, touch.goal, kGoalRadius * scale);
    const glm::vec4 proxy = ball(camera, touch.proxy, kProxyRadius * scale);
    if (touch.contact || touch.catching_up) {
        const double dash = touch.catching_up ? kDash * scale : 0.0;
        strokes.push_back({.ball_a = ball(camera, touch.goal, kSpringRadius * scale),
                           .ball_b = ball(camera, touch.proxy, kSpringRadius * scale),
                           .tint = kSpringTint,
                           .dash = static_cast<float>(dash)});
    }
    if (touch.contact) {
        const Vec3 normal_end = touch.proxy + touch.normal * kNormalLength_px;
        strokes.push_back({ball(camera, touch.proxy, kNormalRadius * scale),
                           ball(camera, normal_end, kNormalRadius * scale), kNormalTint});
    }
    if (is_finite(touch.force_newton)) {
        add_force_arrow(strokes, touch, camera, scale);
        add_force_gauge(strokes, touch, camera, scale);
    }
    add_trace(strokes, touch, camera, scale);
    if (touch.recorded_proxy && is_finite(*touch.recorded_proxy)) {
        const glm::vec4 recorded = ball(camera, *touch.recorded_proxy, kProxyRadius * scale);
        strokes.push_back({recorded, recorded, kRecordedTint});
    }
    add_others(strokes, touch, camera, scale);
    if (touch.finger_px > 0.0) add_finger(strokes, touch, camera, scale);
    if (touch.finger_contact && is_finite(*touch.finger_contact)) {
        const glm::vec4 at = ball(camera, *touch.finger_contact, kFingerContactRadius * scale);
        strokes.push_back({at, at, kNormalTint});
    }
    strokes.push_back({goal, goal, kGoalTint, kGoalHollow});
    if (touch.catching_up) {
        const glm::vec4 around = ball(camera, touch.proxy, kCatchingUpRadius * scale);
        strokes.push_back({around, around, kProxyTint, kCatchingUpHollow});
    }
    const glm::vec4 tint =
        touch.proxy_tint ? glm::vec4(*touch.proxy_tint, kProxyTint.a) : kProxyTint;
    strokes.push_back({proxy, proxy, tint});
    return strokes;
}

std::optional<FrictionCone> friction_cone(const TouchMarkers& touch, const Camera& camera) {
    if (!touch.visible || !touch.contact || touch.catching_up || !(touch.friction > 0.0)) {
        return std::nullopt;
    }
    const double length = glm::length(touch.normal);
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 normal = touch.normal / length;
    const double height_px = glm::dot(touch.proxy - touch.goal, normal);
    if (!(height_px > kLeastConeHeight_px) || !std::isfinite(height_px)) return std::nullopt;
    const Vec3 axis = upright(normal) * height_px;
    const Vec3 u = perpendicular(upright(normal));
    const Vec3 v = glm::cross(upright(normal), u);
    const double radius_px = height_px * touch.friction;
    return FrictionCone{glm::vec3(camera.world_from_grid(touch.goal)), glm::vec3(axis),
                        glm::vec3(u * radius_px), glm::vec3(v * radius_px)};
}

MarkerPass::MarkerPass()
    : stroke_program_(shaders::kStrokeVert, shaders::kStrokeFrag),
      cone_program_(shaders::kConeVert, shaders::kConeFrag) {
    glBindVertexArray(stroke_array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, stroke_buffer_.get());
    stroke_attribute(0, 4, offsetof(MarkerStroke, ball_a));
    stroke_attribute(1, 4, offsetof(MarkerStroke, ball_b));
    stroke_attribute(2, 4, offsetof(MarkerStroke, tint));
    stroke_attribute(3, 1, offsetof(MarkerStroke, hollow));
    stroke_attribute(4, 1, offsetof(MarkerStroke, dash));
    stroke_attribute(5, 1, offsetof(MarkerStroke, share));
    glBindVertexArray(0);
}

void MarkerPass::draw(const TouchMarkers& touch, const Camera& camera, glm::ivec2 size) {
    const double scale = std::clamp(size.y / kScaleHeight_px, 0.6, 4.0);
    std::vector<MarkerStroke> strokes = touch_strokes(touch, camera, scale);
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

void MarkerPass::draw_strokes(std::vector<MarkerStroke> strokes, const glm::mat4& view_from_world,
                              const glm::mat4& clip_from_view, glm::ivec2 size) {
    // Far strokes first, since soft edges blend with the picture behind them.
    const auto nearness = [&](const MarkerStroke& s) {
        const glm::vec3 middle = 0.5F * (glm::vec3(s.ball_a) + glm::vec3(s.ball_b));
        return (view_from_world * glm::vec4(middle, 1.0F)).z;
    };
    std::stable_sort(
        strokes.begin(), strokes.end(),
        [&](const MarkerStroke& a, const MarkerStroke& b) { return nearness(a) < nearness(b); });
    glBindBuffer(GL_ARRAY_BUFFER, stroke_buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(strokes.size() * sizeof(MarkerStroke)),
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
