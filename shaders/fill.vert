#version 330 core
// Filled shapes, already on the screen: three corners a triangle.

#include "chunks/outside.glsl"

in vec2 corner;
in float depth;
in vec4 color;
in vec2 style;  // light where hidden, flags

out vec2 position;
out float s;
out vec4 plane;
flat out vec4 fill_color;
flat out vec2 fill_style;

void main() {
    position = corner;
    s = depth;
    plane = plane_under(corner);
    fill_color = color;
    fill_style = style;
    gl_Position = vec4((corner - half_size) / half_size, 0.0, 1.0);
}
