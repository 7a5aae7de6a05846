#version 330 core
// The relief: one corner of the drawn grid, lifted by its elevation and the bump map.
// Defines: ROUGH (there is a bump map), PAINTED (there are painted heights), WALL (the sides that close
// the relief; every second vertex is on the ground), LAYER (at a silhouette: a corner with its own elevation, in
// the smooth slope of another vertex), SILHOUETTES (the cut cells are left out), LOOK (of a material).

layout(location = 0) in uvec2 corner;  // column and row in the drawn grid
#ifdef LAYER
layout(location = 1) in uvec2 source;
layout(location = 2) in vec3 layer_px;  // elevation without bumps; far face, near face
layout(location = 3) in vec4 fill;
out vec2 faces_px;  // far, near
out vec4 continued;  // colour of the far face under the near one; 1: without light of its own
#endif

uniform sampler2D elevations;  // px, without bumps and painted heights
uniform sampler2D bump;  // height in [0, 1]
uniform sampler2D heights;  // px
uniform float roughness_px;
uniform float ground_px;
uniform vec4 dent;  // column, row, radius, depth [px]
uniform float shadow;  // of the proxy, where it is on the surface; 0: none
uniform int grid_step;
uniform ivec2 drawn;  // columns and rows of the drawn grid
uniform ivec2 image;  // columns and rows of the depth image
uniform float light;
uniform mat4 clip_from_world;

#ifdef SILHOUETTES
uniform sampler2D cut_around;  // of each drawn vertex, which cells around it are cut: 1: upper left, 2: upper right,
                               // 4: lower left, 8: lower right
#endif
out vec3 lifted;  // normalised place in the picture, elevation
#ifdef TEXTURED
out vec2 colour_place;  // in the texture; here, as it takes software a fifth of its time for each pixel
uniform vec3 colour_across;  // of one in the picture, whose video may be turned
uniform vec3 colour_down;
#endif
#ifdef LOOK
uniform vec2 finish;  // gloss, fuzz
out float shine;  // white light on top of the colour
#endif
out float shade;  // factor on the colour; on walls, height over the ground in [0, 1]

const vec3 kKey = vec3(-0.46, 0.55, 0.70);  // from the upper left, towards the viewer
const vec3 kFill = vec3(0.64, -0.10, 0.76);
const vec3 kGloss = vec3(-0.25, 0.30, 0.92);  // half way between key and eye
const float kGleam = 60.0;       // how small a highlight is
const float kShadowReach = 1.3;  // of the dent's radius
const float kFringe = 2.0;       // px of 640 in a row

vec2 in_image(ivec2 at) { return vec2(min(at * grid_step, image - 1)); }

// How far the skin is pressed in under the proxy.
float pressed_in(ivec2 at) {
    if (dent.w <= 0.0) return 0.0;
    vec2 off = (in_image(at) - dent.xy) / dent.z;
    return dent.w * exp(-dot(off, off));
}

// What the proxy's shadow leaves of the light.
float unshadowed(vec2 here) {
    if (shadow <= 0.0) return 1.0;
    vec2 off = (here - dent.xy) / (kShadowReach * dent.z);
    return 1.0 - shadow * exp(-dot(off, off));
}

float smooth_elevation(ivec2 at) { return texelFetch(elevations, at, 0).r; }

// By bumps and paint, less the dent. They go on over what is continued, whose smooth part is another vertex's.
float raised(ivec2 at) {
    float z = -pressed_in(at);
#ifdef ROUGH
    z += roughness_px * texelFetch(bump, at, 0).r;
#endif
#ifdef PAINTED
    z += texelFetch(heights, at, 0).r;
#endif
    return z;
}

// Of the sides that the relief is not cut on: its rim keeps the light of its face.
float slope(float before, float here, float after, vec2 reach, bvec2 is_cut) {
    if (is_cut.x && is_cut.y) return 0.0;
    if (is_cut.x) return (after - here) / max(reach.y, 1.0);
    if (is_cut.y) return (here - before) / max(reach.x, 1.0);
    return (after - before) / (reach.x + reach.y);
}

// The factor on the picture's own colour; a flat relief facing the viewer keeps it unchanged.
float lit(vec3 normal) {
    float gloss = pow(max(dot(normal, normalize(kGloss)), 0.0), 24.0);
    return 0.16 + 0.95 * max(dot(normal, kKey), 0.0) + 0.22 * max(dot(normal, kFill), 0.0) + 0.12 * gloss;
}
float brightness(vec3 normal) { return mix(1.0, lit(normal) / lit(vec3(0.0, 0.0, 1.0)), light); }

// The neighbours of a vertex, and how far away they are [px].
struct Reach {
    ivec2 low, high;  // the neighbours to the upper left and to the lower right
    vec2 to_low, to_high;
};
Reach reach_of(ivec2 at) {
    Reach reach = Reach(max(at - 1, ivec2(0)), min(at + 1, drawn - 1), vec2(0.0), vec2(0.0));
    reach.to_low = in_image(at) - in_image(reach.low);
    reach.to_high = in_image(reach.high) - in_image(at);
    return reach;
}

void main() {
    ivec2 vertex = ivec2(corner);
#ifdef LAYER
    ivec2 at = ivec2(source);
    float z = layer_px.x + raised(vertex);
    faces_px = layer_px.yz;
    continued = fill;
#else
    ivec2 at = vertex;
    float z = smooth_elevation(at) + raised(at);
#endif
    vec2 here = in_image(vertex);
#ifdef WALL
    bool ground = (gl_VertexID & 1) == 1;
    if (ground) z = ground_px;
    shade = ground ? 0.0 : 1.0;
#else
    bvec2 across = bvec2(false);  // to the left and to the right
    bvec2 along = bvec2(false);   // upwards and downwards
#ifdef SILHOUETTES
    // An edge of the grid is cut where the cells on both of its sides are.
    int cut = int(texelFetch(cut_around, at, 0).r);
    across = equal(ivec2(cut & 5, cut & 10), ivec2(5, 10));
    along = equal(ivec2(cut & 3, cut & 12), ivec2(3, 12));
#endif
    Reach face = reach_of(at);
    float middle = smooth_elevation(at);
    float dx = slope(smooth_elevation(ivec2(face.low.x, at.y)), middle, smooth_elevation(ivec2(face.high.x, at.y)),
                     vec2(face.to_low.x, face.to_high.x), across);
    float dy = slope(smooth_elevation(ivec2(at.x, face.low.y)), middle, smooth_elevation(ivec2(at.x, face.high.y)),
                     vec2(face.to_low.y, face.to_high.y), along);
#ifdef LAYER
    // What is continued soon loses the light of the vertex at the outline that it began with, or streaks would show.
    float kept = 1.0 - smoothstep(0.0, 0.1, fill.a);
    dx *= kept;
    dy *= kept;
#endif
    Reach bumps = reach_of(vertex);
    vec2 wide = bumps.to_low + bumps.to_high;
    dx += (raised(ivec2(bumps.high.x, vertex.y)) - raised(ivec2(bumps.low.x, vertex.y))) / wide.x;
    dy += (raised(ivec2(vertex.x, bumps.high.y)) - raised(ivec2(vertex.x, bumps.low.y))) / wide.y;
    vec3 normal = normalize(vec3(-dx, dy, 1.0));
    float lamp = unshadowed(here);
    shade = brightness(normal) * lamp;
#ifdef LOOK
    float gleam = 0.75 * pow(max(dot(normal, normalize(kGloss)), 0.0), kGleam);
    float halo = 0.5 * (1.0 - normal.z) * (1.0 - normal.z);
    shine = light * lamp * (finish.x * gleam + finish.y * halo);
#endif
#endif
    lifted = vec3((here + 0.5) / vec2(image), z);
#ifdef TEXTURED
    vec3 at_one = vec3(lifted.xy, 1.0);
#ifdef SILHOUETTES
    // Beside an outline the video mixes the colours of both sides: the rim has those further inside.
    ivec4 sides = min(ivec4(cut & 5, cut & 10, cut & 3, cut & 12), 1);
    float fringe = min(kFringe * max(float(image.x) / 640.0, 1.0), float(grid_step));
    at_one.xy += fringe * vec2(sides.xz - sides.yw) / vec2(image);
#endif
    colour_place = vec2(dot(colour_across, at_one), dot(colour_down, at_one));
#endif
    vec3 world = vec3(here.x - 0.5 * float(image.x - 1), 0.5 * float(image.y - 1) - here.y, z);
    gl_Position = clip_from_world * vec4(world, 1.0);
}
