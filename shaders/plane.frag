#version 330 core
// The other camera's picture on its image plane in the outside view, hidden where the scene is
// nearer; over the scene by blending.

#include "chunks/outside.glsl"

uniform sampler2D picture;    // as shown, row 0 at the top
uniform float opacity;        // of the picture
uniform float picture_light;  // of the picture: its back is darker

in vec2 position;

out vec4 color;

const int TAPS = 4;  // a side of a pixel, of the picture

void main() {
    if (!may_be_on_plane(position)) {
        discard;
    }
    float t = scene_t(position);
    ivec2 last = textureSize(picture, 0) - 1;
    vec3 shown = vec3(0.0);
    float covered = 0.0;
    for (int k = 0; k < TAPS * TAPS; ++k) {
        vec2 within = (vec2(k % TAPS, k / TAPS) + 0.5) / float(TAPS);
        vec3 at = plane_at(floor(position) + within);
        if (at.z > 0.0 && at.z < t && all(equal(at.xy, clamp(at.xy, 0.0, 1.0)))) {
            ivec2 source = min(ivec2(at.xy * vec2(last + 1)), last);
            shown += texelFetch(picture, source, 0).rgb;
            covered += 1.0;
        }
    }
    if (covered == 0.0) {
        discard;
    }
    color = vec4(picture_light * shown / covered, opacity * covered / float(TAPS * TAPS));
}
