#version 330 core
// The relief's colour. Defines: TEXTURED (with 1: red, green and blue; 2: luma, and both chromas in one texture; 3: luma and each
// chroma) or BY_DEPTH (else clay), WALL,
// LAYER (at a silhouette) with FRONT (the near face, up to its outline) or BEHIND (the far face, continued under it: beside an
// outline the video mixes the colours of both; BY_DEPTH it is hatched),
// LOOK (of a material: its tint and shine),
// UNSEEN (somewhere no surface was ever seen: dimmed and hatched).

in vec3 lifted;
in float shade;
#ifdef LOOK
in float shine;
uniform vec4 tint;  // of the material; its share
#endif
#ifdef LAYER
in vec2 faces_px;
in vec4 continued;  // colour; 1: far under the near face
uniform sampler2D detail;  // elevations as fine as can be, without bumps [px]
#endif
#ifdef UNSEEN
uniform sampler2D unseen;  // 1: no surface was ever seen, as fine as can be
#endif

uniform sampler2D colour;  // BY_DEPTH: one row, from far to near
#ifdef TEXTURED
in vec2 colour_place;  // in the texture
#if TEXTURED > 1
uniform sampler2D chroma;  // blue; with 2 also red
uniform sampler2D red_chroma;
uniform vec2 chroma_scale;
uniform vec4 red_of;  // of luma, blue chroma, red chroma and 1
uniform vec4 green_of;
uniform vec4 blue_of;
#endif
#endif
uniform float relief_px;
uniform int detail_step;
uniform ivec2 image;
uniform vec3 side;  // WALL: its colour in full light

out vec4 pixel;

const vec3 kClay = vec3(0.70, 0.66, 0.61);
#ifdef BEHIND
const float kBackside = 1.0;  // the end of what is continued has no side that anybody knows
#else
const float kBackside = 0.35;  // seen from behind, as through a gap
#endif

// Where this place is in a texture of every `detail_step`-th vertex.
vec2 in_detail(ivec2 size) {
    return ((lifted.xy * vec2(image) - 0.5) / float(detail_step) + 0.5) / vec2(size);
}

#ifdef TEXTURED
vec3 of_video() {
#if TEXTURED > 1
    vec2 beside = colour_place * chroma_scale;
#if TEXTURED == 2
    vec2 chromas = texture(chroma, beside).rg;
#else
    vec2 chromas = vec2(texture(chroma, beside).r, texture(red_chroma, beside).r);
#endif
    vec4 samples = vec4(texture(colour, colour_place).r, chromas, 1.0);
    return clamp(vec3(dot(red_of, samples), dot(green_of, samples), dot(blue_of, samples)), 0.0, 1.0);
#else
    return texture(colour, colour_place).rgb;
#endif
}
#endif

#ifdef FRONT
// The depth image [px], smoothed by a cubic B-spline, so that outlines have no corners at pixels: of 4 x 4
// values, with four samples between two of them each.
float smooth_depth() {
    vec2 size = vec2(textureSize(detail, 0));
    vec2 place = in_detail(ivec2(size)) * size - 0.5;
    vec2 first = floor(place);
    vec2 f = place - first;
    vec2 g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0;
    vec2 w1 = (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
    vec2 w3 = f * f * f / 6.0;
    vec2 low_part = w0 + w1;
    vec2 low = (first - 0.5 + w1 / low_part) / size;
    vec2 high = (first + 1.5 + w3 / (1.0 - low_part)) / size;
    vec4 at[2] = vec4[2](vec4(low, high.x, low.y), vec4(low.x, high.y, high));
    float sum = 0.0;
    for (int k = 0; k < 2; ++k) {
        float left = texture(detail, at[k].xy).r;
        float right = texture(detail, at[k].zw).r;
        sum += mix(right, left, low_part.x) * (k == 0 ? low_part.y : 1.0 - low_part.y);
    }
    return sum;
}

// 0: on the far face, 1: on the near face.
float near_share() {
    return clamp((smooth_depth() - faces_px.x) / max(faces_px.y - faces_px.x, 1e-3), 0.0, 1.0);
}
#endif

#if defined(UNSEEN) || defined(BEHIND)
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
    float alpha = 1.0;
#ifdef FRONT
    float share = near_share();
    float soft = clamp(fwidth(share), 1e-3, 0.5);
    alpha = smoothstep(0.5 - soft, 0.5 + soft, share);
    if (alpha < 0.02) discard;
#endif
#if defined(TEXTURED) && defined(BEHIND)
    vec3 body = continued.rgb;
#elif defined(TEXTURED)
    vec3 body = of_video();
#elif defined(BY_DEPTH)
    vec3 body = texture(colour, vec2(clamp(lifted.z / max(relief_px, 1e-6), 0.002, 0.998), 0.5)).rgb;
#ifdef BEHIND
    body = mix(body, not_seen(body), continued.a);
#endif
#else
    vec3 body = kClay;
#endif
#ifdef LOOK
    vec3 dyed = tint.rgb * (0.2 + 1.3 * dot(body, vec3(0.299, 0.587, 0.114)));
    body = mix(body, dyed, tint.a);
#endif
#ifdef UNSEEN
    float none = texture(unseen, in_detail(textureSize(unseen, 0))).r;
    body = mix(body, not_seen(body), smoothstep(0.3, 0.7, none));
#endif
    vec3 lit = body * (gl_FrontFacing ? shade : shade * kBackside);
#ifdef LOOK
    lit += shine;
#endif
    pixel = vec4(lit, alpha);
#endif
}
