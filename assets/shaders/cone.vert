#version 330 core
// The friction cone: a fan of triangles from the apex to the rim, made from the vertex number.

uniform vec3 apex;
uniform vec3 axis;     // from the apex to the middle of the rim
uniform vec3 rim_u;    // two radii of the rim at a right angle
uniform vec3 rim_v;
uniform int segments;
uniform mat4 clip_from_world;

out float height;  // 0 at the apex, 1 at the rim

void main() {
    int part = gl_VertexID % 3;
    float angle = 6.28318530718 * float(gl_VertexID / 3 + part - 1) / float(segments);
    vec3 rim = apex + axis + rim_u * cos(angle) + rim_v * sin(angle);
    height = part == 0 ? 0.0 : 1.0;
    gl_Position = clip_from_world * vec4(part == 0 ? apex : rim, 1.0);
}
