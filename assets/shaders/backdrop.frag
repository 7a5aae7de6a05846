#version 330 core
// A calm wall, a little lighter at the top; dithered, or the few greys would show as bands.
uniform float height_px;
uniform vec3 top;
uniform vec3 bottom;
out vec4 pixel;

void main() {
    // Interleaved gradient noise (Jimenez 2014, "Next generation post processing in Call of Duty").
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    pixel = vec4(mix(bottom, top, gl_FragCoord.y / height_px) + (noise - 0.5) / 255.0, 1.0);
}
