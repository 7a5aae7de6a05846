#version 330 core
// A marker's pixel: soft edge, dark outline (legible over any picture), lit as round.

flat in vec4 a_px;
flat in vec4 b_px;
flat in vec4 colour;
flat in float turn;

uniform float opacity;

out vec4 pixel;

const float kOutline_px = 1.25;
const float kHalfDash = 0.2;  // of the way from dash to dash; its round ends come on top
const float kTurn = 6.2831853;
const vec3 kOutline = vec3(0.04, 0.04, 0.05);
const vec3 kKey = vec3(-0.46, 0.55, 0.70);

void main() {
    vec2 axis = b_px.xy - a_px.xy;
    float h = clamp(dot(gl_FragCoord.xy - a_px.xy, axis) / max(dot(axis, axis), 1e-6), 0.0, 1.0);
    if (b_px.w > 0.0) {
        float dash = b_px.w / max(length(axis), 1e-3);  // in parts of the stroke, as h
        float middle = (floor(h / dash) + 0.5) * dash;
        h = clamp(h, min(middle - kHalfDash * dash, 1.0), min(middle + kHalfDash * dash, 1.0));
    }
    vec2 from_axis = gl_FragCoord.xy - mix(a_px.xy, b_px.xy, h);
    float radius = mix(a_px.z, b_px.z, h);
    float distance_px = length(from_axis) - radius;
    vec2 round_xy = from_axis / max(radius, 0.5);
    if (a_px.w > 0.0) {
        float middle = radius * 0.5 * (1.0 + a_px.w);
        float thick = radius * 0.5 * (1.0 - a_px.w);
        float off = length(from_axis) - middle;
        vec2 outwards = normalize(from_axis + 1e-4);
        distance_px = abs(off) - thick;
        float beyond = (fract(atan(from_axis.x, from_axis.y) / kTurn) - turn) * kTurn;
        if (beyond > 0.0) {  // measured from the nearer end of the arc
            float off_end = min(beyond, kTurn * (1.0 - turn) - beyond);
            distance_px = max(distance_px, min(off_end, 1.0) * middle - 0.5);
        }
        round_xy = outwards * off / max(thick, 0.5);
    }
    float coverage = clamp(0.5 + kOutline_px - distance_px, 0.0, 1.0);
    if (coverage <= 0.0) discard;
    float facing = sqrt(max(1.0 - dot(round_xy, round_xy), 0.0));
    vec3 normal = vec3(round_xy, facing);
    float lit = 0.55 + 0.55 * max(dot(normal, kKey), 0.0);
    float gloss = 0.35 * pow(max(dot(normal, normalize(kKey + vec3(0.0, 0.0, 1.0))), 0.0), 30.0);
    vec3 body = colour.rgb * lit + gloss;
    float inside = clamp(0.5 - distance_px, 0.0, 1.0);
    pixel = vec4(mix(kOutline, body, inside), coverage * colour.a * opacity);
}
