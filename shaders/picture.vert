#version 330 core
// A picture over all of the viewport: two triangles that make a rectangle. Mesa draws rectangles,
// on a CPU, in half the time of what is larger and cut to them.

out vec2 place;  // in the picture, 0 to 1

void main() {
    place = vec2(ivec2(0x16, 0x34) >> gl_VertexID & 1);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
