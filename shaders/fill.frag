#version 330 core
// A filled shape's pixels; paler where they are hidden.

#include "chunks/outside.glsl"

in vec2 position;
in float s;
in vec4 plane;  // see plane_under()
flat in vec4 fill_color;
flat in vec2 fill_style;

out vec4 color;

void main() {
    bool hidden = is_hidden(position, s, (int(fill_style.y + 0.5) & 1) != 0, plane);
    color = vec4(fill_color.rgb, fill_color.a * (hidden ? fill_style.x : 1.0));
}
