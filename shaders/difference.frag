#version 330 core
// The difference of two images of one channel, as false colour: renderer/images/difference.py's, on the GPU.

#include "chunks/color.glsl"

const int COLOR = 0, DEPTH = 1, NORMAL = 2;  // else: id

uniform sampler2D raster;  // colour; depth and normal: the normal, and t in alpha
uniform sampler2D ray;     // colour, normal, or t in red
uniform isampler2D raster_object;
uniform isampler2D ray_object;
uniform sampler2D colors;  // one row
uniform int channel;
uniform int component;  // 0 to 2: that channel of light alone
uniform float gain;     // divided by the full scale
uniform bool has_sign;

out vec4 color;

float most(vec3 v) {
    float low = min(min(v.x, v.y), v.z), high = max(max(v.x, v.y), v.z);
    return high >= -low ? high : low;
}

bool unusable(vec3 v) { return isnan(v.x) || isnan(v.y) || isnan(v.z); }

float difference(ivec2 at) {
    if (channel == COLOR) {
        vec3 first = texelFetch(raster, at, 0).rgb, second = texelFetch(ray, at, 0).rgb;
        if (component >= 0) {
            first = vec3(first[component]);
            second = vec3(second[component]);
        }
        if (unusable(first) || unusable(second)) return 1e30;
        return most(srgb_from_linear(clamp(second, 0.0, 1.0))
            - srgb_from_linear(clamp(first, 0.0, 1.0)));
    }
    if (channel == DEPTH) {
        float first = texelFetch(raster, at, 0).a, second = texelFetch(ray, at, 0).r;
        if (isnan(first) || isnan(second)) return 1e30;
        if (isinf(first)) return isinf(second) ? 0.0 : -1e30;
        return isinf(second) ? 1e30 : (second - first) / second;
    }
    if (channel == NORMAL) {
        vec3 v = texelFetch(ray, at, 0).rgb - texelFetch(raster, at, 0).rgb;
        return unusable(v) ? 1e30 : most(v);
    }
    return texelFetch(raster_object, at, 0).r == texelFetch(ray_object, at, 0).r ? 0.0 : 1e30;
}

void main() {
    float scaled = clamp(gain * difference(ivec2(gl_FragCoord.xy)), -1.0, 1.0);
    float part = has_sign ? 0.5 * scaled + 0.5 : abs(scaled);
    int last = textureSize(colors, 0).x - 1;
    color = texelFetch(colors, ivec2(int(part * float(last) + 0.5), 0), 0);
}
