#version 330 core
// Of moved triangles, keep the nearest hit: its primitive, and where it is on that.
// HAS_HOLES: a constant that is put in above, whether any object has a cutout.

#include "chunks/meeting.glsl"
#include "chunks/texture.glsl"

uniform int triangle_count;

in vec3 place;
in float t;
flat in int seen;

layout(location = 0) out int primitive;
layout(location = 1) out vec4 where;  // weights, or the normal; t

void main() {
    if (!counts(t, vec2(0.0))) {
        discard;
    }
    if (HAS_HOLES && seen < triangle_count) {
        ivec4 face = texelFetch(faces, texel(seen), 0);
        if (has_holes(face.w) && is_hole(face.w, place_between(face.xyz, place))) {
            discard;
        }
    }
    primitive = seen;
    where = vec4(place, t);
    gl_FragDepth = depth(t);
}
