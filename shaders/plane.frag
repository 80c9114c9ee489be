#version 330 core
// The other camera's picture on its image plane in the outside view, hidden where the scene is
// nearer; over the scene by blending.
// TAPS: a constant that is put in above: points that are taken of the picture, a side of a pixel.

#include "chunks/outside.glsl"

uniform sampler2D picture;    // as shown, row 0 at the top
uniform float opacity;        // of the picture
uniform float picture_light;  // of the picture: its back is darker

in vec2 position;

out vec4 color;

// Whether a pixel may show any of the picture: its middle, give or take two pixels.
bool may_be_on_plane() {
    for (int k = 0; k < 5; ++k) {
        vec2 aside = k < 4 ? vec2(k & 1, k >> 1) * 4.0 - 2.0 : vec2(0.0);
        vec4 plane = plane_under(position + aside);
        if (plane.w > 0.0 && is_in_picture(plane)) {
            return true;
        }
    }
    return false;
}

void main() {
    if (TAPS > 1 && !may_be_on_plane()) {
        discard;
    }
    float t = scene_t(position);
    ivec2 last = textureSize(picture, 0) - 1;
    vec3 shown = vec3(0.0);
    float covered = 0.0;
    for (int k = 0; k < TAPS * TAPS; ++k) {
        vec2 within = (vec2(k % TAPS, k / TAPS) + 0.5) / float(TAPS);
        vec4 at = plane_under(floor(position) + within);
        if (at.w > 0.0 && is_in_picture(at) && (perspective > 0.5 ? at.w * t > 1.0 : at.w < t)) {
            ivec2 source = clamp(ivec2(at.xy / at.z * vec2(last + 1)), ivec2(0), last);
            shown += texelFetch(picture, source, 0).rgb;
            covered += 1.0;
        }
    }
    if (covered == 0.0) {
        discard;
    }
    color = vec4(picture_light * shown / covered, opacity * covered / float(TAPS * TAPS));
}
