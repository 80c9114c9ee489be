#version 330 core
// The outside view's ground: the scene as seen from outside, and the other camera's picture on its
// image plane, hidden where the scene is nearer. The scene may have several samples a pixel.

#include "chunks/color.glsl"
#include "chunks/outside.glsl"

uniform sampler2D linear_color;
uniform sampler2D picture;   // linear light, row 0 at the top
uniform float exposure;      // a factor, of both
uniform float opacity;       // of the picture
uniform float picture_light; // of the picture: its back is darker

out vec4 color;

const int TAPS = 4;  // a side of a pixel, of the picture

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool near_plane = has_plane && may_be_on_plane(gl_FragCoord.xy);
    ivec2 last = textureSize(picture, 0) - 1;
    int taps = max(1, TAPS / samples);
    vec3 sum = vec3(0.0);
    for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
            ivec2 texel = pixel * samples + ivec2(column, row);
            vec3 seen = clamp(exposure * texelFetch(linear_color, texel, 0).rgb, 0.0, 1.0);
            if (near_plane) {
                float t = texelFetch(surface, texel, 0).w;
                vec3 shown = vec3(0.0);
                float covered = 0.0;
                for (int k = 0; k < taps * taps; ++k) {
                    vec2 within = (vec2(k % taps, k / taps) + 0.5) / float(taps);
                    vec3 at = plane_at((vec2(texel) + within) / float(samples));
                    if (at.z > 0.0 && at.z < t && all(equal(at.xy, clamp(at.xy, 0.0, 1.0)))) {
                        ivec2 source = min(ivec2(at.xy * vec2(last + 1)), last);
                        vec3 light = texelFetch(picture, source, 0).rgb;
                        shown += clamp(exposure * light, 0.0, 1.0);
                        covered += 1.0;
                    }
                }
                float part = 1.0 / float(taps * taps);
                seen *= 1.0 - opacity * covered * part;
                seen += opacity * picture_light * part * shown;
            }
            sum += seen;
        }
    }
    color = vec4(srgb_from_linear(sum / float(samples * samples)), 1.0);
}
