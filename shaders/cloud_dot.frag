#version 330 core
// A point's pixels, a square, or those of a thin line. Colours are multiplied by their opacity.

flat in vec4 dot_color;

out vec4 color;

void main() {
    color = vec4(dot_color.rgb * dot_color.a, dot_color.a);
}
