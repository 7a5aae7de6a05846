#version 330 core
// The relief's colour. Defines: TEXTURED or BY_DEPTH (else clay), SILHOUETTES (leave out the torn cells), WALL,
// RIM (a layer that goes on beyond a silhouette: only what agrees with the depth image is shown),
// UNSEEN (somewhere no surface was ever seen: dimmed and hatched).

in vec3 lifted;
in float shade;
#ifdef SILHOUETTES
flat in float cell_torn;
#endif
#ifdef RIM
in vec2 layer;
uniform sampler2D detail_from;  // levels, as fine as can be
uniform sampler2D detail_to;
uniform float blend;
uniform float px_per_level;
#endif
#ifdef UNSEEN
uniform sampler2D unseen;  // 1: no surface was ever seen, as fine as can be
#endif

uniform sampler2D colour;  // BY_DEPTH: one row, from far to near
uniform float relief_px;
uniform int detail_step;
uniform ivec2 image;
uniform vec3 side;  // WALL: its colour in full light

out vec4 pixel;

const vec3 kClay = vec3(0.70, 0.66, 0.61);
const float kBackside = 0.35;  // seen from behind, as through a gap

// Where this place is in a texture of every `detail_step`-th vertex.
vec2 in_detail(ivec2 size) {
    return ((lifted.xy * vec2(image) - 0.5) / float(detail_step) + 0.5) / vec2(size);
}

#ifdef UNSEEN
const float kHatches = 110.0;  // across the picture
const float kLine = 0.26;      // of a hatch

// Thin lines up to the right, fixed to the picture, smoothed over a pixel of the screen; where they are too
// fine for it, their mean.
float hatch() {
    float along = (lifted.x * float(image.x) - lifted.y * float(image.y)) * kHatches / float(image.x);
    float soft = fwidth(along);
    float off = abs(fract(along) - 0.5);
    float line = 1.0 - smoothstep(0.5 * kLine - 0.5 * soft, 0.5 * kLine + 0.5 * soft, off);
    return mix(line, kLine, smoothstep(0.35, 0.7, soft));
}

// Nearly grey and dark, with lighter lines: there, but not to be relied on.
vec3 not_seen(vec3 body) {
    vec3 grey = vec3(dot(body, vec3(0.299, 0.587, 0.114)));
    vec3 dim = 0.32 * mix(body, grey, 0.65) + vec3(0.030, 0.032, 0.036);
    return dim + hatch() * vec3(0.085, 0.088, 0.095);
}
#endif

void main() {
#ifdef WALL
    pixel = vec4(side * (0.45 + 0.55 * shade), 1.0);
#else
#ifdef RIM
    vec2 at = in_detail(textureSize(detail_from, 0));
    float there = px_per_level * mix(texture(detail_from, at).r, texture(detail_to, at).r, blend);
    if (abs(there - layer.x) > layer.y) discard;
#endif
#ifdef SILHOUETTES
    if (cell_torn > 0.5) discard;
#endif
#if defined(TEXTURED)
    vec3 body = texture(colour, lifted.xy).rgb;
#elif defined(BY_DEPTH)
    vec3 body = texture(colour, vec2(clamp(lifted.z / max(relief_px, 1e-6), 0.002, 0.998), 0.5)).rgb;
#else
    vec3 body = kClay;
#endif
#ifdef UNSEEN
    float none = texture(unseen, in_detail(textureSize(unseen, 0))).r;
    body = mix(body, not_seen(body), smoothstep(0.3, 0.7, none));
#endif
    pixel = vec4(body * (gl_FrontFacing ? shade : shade * kBackside), 1.0);
#endif
}
