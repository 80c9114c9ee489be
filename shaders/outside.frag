#version 330 core
// The outside view's ground: the scene as seen from outside, and the other camera's picture on its
// image plane, hidden where the scene is nearer.

#include "chunks/outside.glsl"

uniform sampler2D scene;      // as shown (scene.frag)
uniform sampler2D picture;    // as shown, row 0 at the top
uniform float opacity;        // of the picture
uniform float picture_light;  // of the picture: its back is darker

out vec4 color;

const int TAPS = 4;  // a side of a pixel, of the picture

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    color = vec4(texelFetch(scene, pixel, 0).rgb, 1.0);
    if (!has_plane || !may_be_on_plane(gl_FragCoord.xy)) {
        return;
    }
    float t = texelFetch(surface, pixel, 0).w;
    ivec2 last = textureSize(picture, 0) - 1;
    vec3 shown = vec3(0.0);
    float covered = 0.0;
    for (int k = 0; k < TAPS * TAPS; ++k) {
        vec2 within = (vec2(k % TAPS, k / TAPS) + 0.5) / float(TAPS);
        vec3 at = plane_at(vec2(pixel) + within);
        if (at.z > 0.0 && at.z < t && all(equal(at.xy, clamp(at.xy, 0.0, 1.0)))) {
            ivec2 source = min(ivec2(at.xy * vec2(last + 1)), last);
            shown += texelFetch(picture, source, 0).rgb;
            covered += 1.0;
        }
    }
    float part = opacity / float(TAPS * TAPS);
    color.rgb = (1.0 - part * covered) * color.rgb + part * picture_light * shown;
}
