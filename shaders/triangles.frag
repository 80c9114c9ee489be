#version 330 core
// Object order: for each triangle, for each pixel that it covers, keep the nearest hit.
// HAS_HOLES: a constant that is put in above, whether any object has a cutout; HAS_TURNED: see
// meeting.glsl.

#include "chunks/meeting.glsl"
#include "chunks/texture.glsl"

out int primitive;

void main() {
    int number = gl_PrimitiveID;
    vec2 xy = image_position(gl_FragCoord.xy);
    float t = triangle_t(texelFetch(triangle_rows, texel(number), 0).xyz, xy);
    if (!counts(t, xy)) {
        discard;
    }
    if (HAS_HOLES && has_holes(texelFetch(faces, texel(number), 0).w)) {
        Meeting met = meet(number, xy, ray_direction(xy), t);
        if (is_hole(met.face.w, place_between(met.face.xyz, met.weights))) {
            discard;
        }
    }
    primitive = number;
    gl_FragDepth = depth(t);
}
