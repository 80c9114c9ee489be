#version 330 core
// One triangle that covers the whole framebuffer, as far away as depth goes.

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(4.0 * corner - 1.0, 1.0, 1.0);
}
