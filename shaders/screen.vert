#version 330 core
// One triangle that covers the whole framebuffer, at a depth of choice.

uniform float window_depth;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(4.0 * corner - 1.0, 2.0 * window_depth - 1.0, 1.0);
}
