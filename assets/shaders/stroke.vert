#version 330 core
// A marker: a rounded stroke from one ball to another (a sphere when both are one), drawn as a quad
// that faces the viewer. Radii are screen pixels, so markers keep their size at any zoom.

layout(location = 0) in vec4 ball_a;  // world, radius
layout(location = 1) in vec4 ball_b;
layout(location = 2) in vec4 tint;
layout(location = 3) in float hollow;  // inner radius of a ring, as a part of its radius; 0: solid
layout(location = 4) in float dash;    // from dash to dash on the screen [px]; 0: one line
layout(location = 5) in float share;   // of a ring: clockwise from the top

uniform mat4 view_from_world;
uniform mat4 clip_from_view;
uniform vec2 viewport;

flat out vec4 a_px;  // centre, radius, hollow
flat out vec4 b_px;  // centre, radius, dash
flat out vec4 colour;
flat out float turn;  // of a ring [turns]

const float kBorder = 2.0;  // pixels around the stroke for its outline and soft edge

// The centre on the screen, and the depth of the ball's nearest point: a ball that rests on the relief
// is not cut by it.
vec3 project(vec4 ball) {
    vec4 view = view_from_world * vec4(ball.xyz, 1.0);
    vec4 clip = clip_from_view * view;
    float world_per_px = 2.0 * clip.w / (clip_from_view[1][1] * viewport.y);
    vec4 near = clip_from_view * (view + vec4(0.0, 0.0, ball.w * world_per_px, 0.0));
    return vec3((clip.xy / clip.w * 0.5 + 0.5) * viewport, near.z / near.w);
}

void main() {
    vec3 a = project(ball_a);
    vec3 b = project(ball_b);
    a_px = vec4(a.xy, ball_a.w, hollow);
    b_px = vec4(b.xy, ball_b.w, dash);
    colour = tint;
    turn = share;

    vec2 along = b.xy - a.xy;
    float len = length(along);
    vec2 direction = len > 1e-3 ? along / len : vec2(1.0, 0.0);
    vec2 across = vec2(-direction.y, direction.x);
    bool at_b = gl_VertexID >= 2;
    float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
    float wide = max(ball_a.w, ball_b.w) + kBorder;
    vec2 at = (at_b ? b.xy + direction * wide : a.xy - direction * wide) + across * side * wide;
    gl_Position = vec4(at / viewport * 2.0 - 1.0, at_b ? b.z : a.z, 1.0);
}
