#version 330 core
// A finished pinhole image warped into that of a lens: colours between four texels, the rest from the
// nearest one; black where the pinhole sees nothing. OUTSIDE: a constant that is put in above, in place
// of the face's number where the lens sees nothing.

#include "chunks/lens.glsl"

uniform sampler2D finished;  // linear light
uniform sampler2D surfaces;  // normal, t
uniform isampler2D objects_seen;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;
layout(location = 2) out int object;

vec4 color_at(ivec2 texel) {
    return texelFetch(finished, clamp(texel, ivec2(0), textureSize(finished, 0) - 1), 0);
}

void main() {
    vec3 position = lens_position();
    if (int(position.z) == OUTSIDE) {
        discard;
    }
    if (!is_on_face(position)) {
        color = vec4(0.0, 0.0, 0.0, 1.0);
        surface = vec4(0.0, 0.0, 0.0, uintBitsToFloat(0x7f800000u));  // infinity
        object = -1;
        return;
    }
    vec2 place = vec2(position.x, -position.y) + half_size - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 part = place - vec2(corner);
    color = mix(
        mix(color_at(corner), color_at(corner + ivec2(1, 0)), part.x),
        mix(color_at(corner + ivec2(0, 1)), color_at(corner + ivec2(1, 1)), part.x), part.y);
    ivec2 nearest = looked_up(position.xy);
    surface = texelFetch(surfaces, nearest, 0);
    surface.w *= stretch(texel_middle(position.xy));
    object = texelFetch(objects_seen, nearest, 0).x;
}
