#version 330 core
// Object order: for each sphere, for each pixel of its box, keep the nearest hit.

#include "chunks/sphere.glsl"

uniform int triangle_count;

flat in int number;

out int primitive;

void main() {
    vec3 normal;
    vec2 xy = image_position(gl_FragCoord.xy);
    float t = sphere_t(sphere_at(number), xy, normal);
    if (!counts(t, xy)) {
        discard;
    }
    primitive = triangle_count + number;
    gl_FragDepth = depth(t);
}
