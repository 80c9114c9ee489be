#version 330 core
// A picture over all of the viewport: two triangles that make a rectangle. Mesa draws a rectangle in
// half the time that one large triangle takes of which the viewport cuts off the rest.

out vec2 place;  // in the picture, 0 to 1

void main() {
    place = vec2(ivec2(0x16, 0x34) >> gl_VertexID & 1);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
