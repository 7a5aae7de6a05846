#version 330 core
// Translucent, with a bright rim: where the proxy may rest without slipping.
in float height;
uniform float opacity;
out vec4 pixel;

const vec3 kColour = vec3(0.62, 0.86, 0.98);
const float kRim_px = 1.6;

void main() {
    float rim = 1.0 - smoothstep(kRim_px - 0.7, kRim_px + 0.7, (1.0 - height) / fwidth(height));
    pixel = vec4(kColour, opacity * (0.22 + 0.10 * height + 0.55 * rim));
}
