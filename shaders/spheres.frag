#version 330 core
// Object order: for each sphere, for each pixel of its box, keep the nearest hit.

#include "chunks/sphere.glsl"

uniform int triangle_count;

flat in int number;

out int primitive;

void main() {
    vec3 normal;
    float t = sphere_t(sphere_at(number), image_position(gl_FragCoord.xy), normal);
    if (!counts(t)) {
        discard;
    }
    primitive = triangle_count + number;
    gl_FragDepth = depth(t);
}
