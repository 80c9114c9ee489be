#version 330 core
// Each pixel of a lens's image looks up its primitive in a face.

#include "chunks/lens.glsl"

uniform isampler2D primitives;  // of the face

out int primitive;

void main() {
    vec3 position = lens_position();
    if (!is_on_face(position)) {
        discard;
    }
    primitive = texelFetch(primitives, looked_up(position.xy), 0).x;
    gl_FragDepth = primitive < 0 ? 1.0 : 0.0;
}
