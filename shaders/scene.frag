#version 330 core
// The scene of the outside view as it is shown: exposure, clamp, sRGB. Kept while it stays the same.

#include "chunks/color.glsl"

uniform sampler2D linear_color;
uniform float exposure;  // a factor
uniform int rows;        // 0: as it is, else upside down: the number of rows

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = rows > 0 ? rows - 1 - pixel.y : pixel.y;
    vec3 light = texelFetch(linear_color, pixel, 0).rgb;
    color = vec4(srgb_from_linear(clamp(exposure * light, 0.0, 1.0)), 1.0);
}
