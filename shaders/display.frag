#version 330 core
// An image on the screen: each pixel of the target shows the image's pixel that covers its
// centre, or the mean of all that it covers, weighted by area.
// AVERAGED: a constant that is put in above, which of the two.

#include "chunks/look.glsl"

uniform vec2 origin;           // the image's upper left corner, in the target
uniform vec2 texels_per_pixel;
uniform float square;          // texels along a side of the squares that show one texel each

out vec4 color;

vec3 mean_seen(vec2 low, vec2 high, vec2 size) {
    low = clamp(low, vec2(0.0), size - 0.001);
    high = clamp(high, low + 0.0005, size);
    ivec2 first = ivec2(floor(low));
    ivec2 last = ivec2(ceil(high)) - 1;
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        float height = min(float(y + 1), high.y) - max(float(y), low.y);
        for (int x = first.x; x <= last.x; ++x) {
            float area = height * (min(float(x + 1), high.x) - max(float(x), low.x));
            sum += area * seen(ivec2(x, y));
            total += area;
        }
    }
    return sum / total;
}

void main() {
    bool has_values = SHOWS_COLOR || SHOWS_DEPTH || SHOWS_NORMAL;
    ivec2 size = has_values ? textureSize(values, 0) : textureSize(numbers, 0);
    vec2 center = gl_FragCoord.xy - origin;
    vec3 value;
    if (AVERAGED) {
        vec2 half_pixel = vec2(0.5);
        value = mean_seen((center - half_pixel) * texels_per_pixel,
                          (center + half_pixel) * texels_per_pixel, vec2(size));
    } else {
        ivec2 texel = ivec2(square * (floor(center * texels_per_pixel / square) + 0.5));
        value = seen(clamp(texel, ivec2(0), size - 1));
    }
    color = vec4(encoded(value), 1.0);
}
