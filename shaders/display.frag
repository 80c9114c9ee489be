#version 330 core
// The display transform: exposure, clamp, sRGB.

#include "chunks/color.glsl"

uniform sampler2D linear_color;
uniform float exposure;  // a factor

out vec4 color;

void main() {
    vec3 rgb = texelFetch(linear_color, ivec2(gl_FragCoord.xy), 0).rgb;
    color = vec4(srgb_from_linear(clamp(exposure * rgb, 0.0, 1.0)), 1.0);
}
