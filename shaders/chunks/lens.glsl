// What a pixel of a lens's image looks up in a face (renderer/camera/lens_faces.py).

#include "chunks/camera.glsl"

uniform sampler2D positions;  // of each pixel: x and y on its face, from the middle; its face's number
uniform int face;

vec3 lens_position() {
    return texelFetch(positions, ivec2(gl_FragCoord.xy), 0).xyz;
}

bool is_on_face(vec3 position) {
    return int(position.z) == face;
}

// The texel of the face, whose row 0 is the top row.
ivec2 looked_up(vec2 xy) {
    return clamp(ivec2(floor(vec2(xy.x, -xy.y) + half_size)), ivec2(0), ivec2(2.0 * half_size) - 1);
}

vec2 texel_middle(vec2 xy) {
    return image_position(vec2(looked_up(xy)) + 0.5);
}
