#version 330 core
// The scene of the outside view as it is shown: exposure, clamp, sRGB. Kept while it stays the same.

#include "chunks/color.glsl"

uniform sampler2D linear_color;
uniform float exposure;  // a factor
uniform ivec2 target_size;

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) * textureSize(linear_color, 0) / target_size;
    vec3 light = texelFetch(linear_color, pixel, 0).rgb;
    color = vec4(srgb_from_linear(clamp(exposure * light, 0.0, 1.0)), 1.0);
}
