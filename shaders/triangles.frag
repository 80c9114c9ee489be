#version 330 core
// Object order: for each triangle, for each pixel that it covers, keep the nearest hit.

#include "chunks/triangle.glsl"
#include "chunks/tables.glsl"

uniform sampler2D triangle_rows;

out int primitive;

void main() {
    vec3 row = texelFetch(triangle_rows, texel(gl_PrimitiveID), 0).xyz;
    float t = triangle_t(row, image_position(gl_FragCoord.xy));
    if (!counts(t)) {
        discard;
    }
    primitive = gl_PrimitiveID;
    gl_FragDepth = depth(t);
}
