// What one pixel of an image looks like: the display transform of its colour, or false colours of
// its other channels, as in renderer/images/display.py; numbers: renderer/shared_numbers.py.
// SHOWS_COLOR, SHOWS_DEPTH, SHOWS_NORMAL (none: object numbers), IS_LINEAR: constants that
// are put in above (renderer/raster/display.py): software OpenGL works out every branch of the rest.

#include "chunks/color.glsl"

uniform sampler2D values;       // colour: linear light; depth: in w; normal
uniform isampler2D numbers;     // objects, -1: none
uniform sampler2D depth_range;  // one pixel: the nearest and the farthest hit
uniform float exposure;         // a factor

vec3 exposed(vec3 light) {
    vec3 result = clamp(exposure * light, 0.0, 1.0);
    return mix(result, vec3(0.0), isnan(light));
}

// Before encoded(): linear light for colours, what the screen shows for the others. Means of
// several pixels are taken of this.
vec3 seen(ivec2 texel) {
    if (SHOWS_COLOR) {
        return exposed(texelFetch(values, texel, 0).rgb);
    }
    if (SHOWS_DEPTH) {
        float t = texelFetch(values, texel, 0).w;
        vec2 ends = texelFetch(depth_range, ivec2(0), 0).xy;
        float behind = ends.y > ends.x ? clamp((t - ends.x) / (ends.y - ends.x), 0.0, 1.0) : 0.0;
        return t < FARTHEST ? vec3(1.0 - (1.0 - FARTHEST_GRAY) * behind) : vec3(0.0);
    }
    if (SHOWS_NORMAL) {
        vec3 n = texelFetch(values, texel, 0).xyz;
        return n == vec3(0.0) ? vec3(0.0) : clamp(0.5 * n + 0.5, 0.0, 1.0);
    }
    int number = texelFetch(numbers, texel, 0).x;
    return number < 0 ? vec3(0.0) : ID_PALETTE[number % ID_PALETTE.length()] / 255.0;
}

vec3 encoded(vec3 value) {
    return SHOWS_COLOR && !IS_LINEAR ? srgb_from_linear(value) : value;
}
