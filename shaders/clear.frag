#version 330 core
// No primitive: an integer framebuffer is cleared by drawing.

out int primitive;

void main() {
    primitive = -1;
}
