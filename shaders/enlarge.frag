#version 330 core
// A coarse picture over the whole of a larger target, evenly from pixel to pixel.

uniform sampler2D picture;  // filtered linearly
uniform vec2 half_size;     // of the target, in pixels

out vec4 color;

void main() {
    color = texture(picture, 0.5 * gl_FragCoord.xy / half_size);
}
