#version 330 core
// Object order: for each triangle, for each pixel that it covers, keep the nearest hit.

#include "chunks/triangle.glsl"
#include "chunks/tables.glsl"

uniform sampler2D triangle_rows;
uniform int first_triangle;  // of this draw

out int primitive;

void main() {
    int number = first_triangle + gl_PrimitiveID;
    vec3 row = texelFetch(triangle_rows, texel(number), 0).xyz;
    float t = triangle_t(row, image_position(gl_FragCoord.xy));
    if (!counts(t)) {
        discard;
    }
    primitive = number;
    gl_FragDepth = depth(t);
}
