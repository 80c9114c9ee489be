#version 330 core
// A rectangle round the other camera's picture on the screen: all other pixels are spared.

#include "chunks/outside.glsl"

out vec2 position;

void main() {
    vec2 low = max(plane_box.xy - 2.0, -half_size);
    vec2 high = min(plane_box.zw + 2.0, half_size);
    vec2 corner = mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    position = corner + half_size;
    gl_Position = vec4(corner / half_size, 0.0, 1.0);
}
