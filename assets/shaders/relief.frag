#version 330 core
// The relief's colour. Defines: TEXTURED (else clay), SILHOUETTES (leave out what is too steep), WALL,
// RIM (a layer that goes on beyond a silhouette: only what agrees with the depth image is shown).

in vec3 lifted;
in float shade;
#ifdef RIM
in vec2 layer;
uniform sampler2D detail_from;  // levels, as fine as can be
uniform sampler2D detail_to;
uniform float blend;
uniform float px_per_level;
uniform int detail_step;
#endif

uniform sampler2D colour;
uniform float slope_limit;
uniform ivec2 image;

out vec4 pixel;

const vec3 kClay = vec3(0.70, 0.66, 0.61);
const vec3 kWall = vec3(0.125, 0.130, 0.140);
const float kBackside = 0.35;  // seen from behind, as through a gap

void main() {
#ifdef WALL
    pixel = vec4(kWall * (0.45 + 0.55 * shade), 1.0);
#else
#ifdef RIM
    vec2 texel = (lifted.xy * vec2(image) - 0.5) / float(detail_step) + 0.5;
    vec2 at = texel / vec2(textureSize(detail_from, 0));
    float there = px_per_level * mix(texture(detail_from, at).r, texture(detail_to, at).r, blend);
    if (abs(there - layer.x) > layer.y) discard;
#endif
#ifdef SILHOUETTES
    vec3 in_grid = vec3(lifted.xy * vec2(image), lifted.z);
    vec3 across = cross(dFdx(in_grid), dFdy(in_grid));  // normal of this triangle
    if (dot(across.xy, across.xy) > slope_limit * slope_limit * across.z * across.z) discard;
#endif
#ifdef TEXTURED
    vec3 body = texture(colour, lifted.xy).rgb;
#else
    vec3 body = kClay;
#endif
    pixel = vec4(body * (gl_FrontFacing ? shade : shade * kBackside), 1.0);
#endif
}
