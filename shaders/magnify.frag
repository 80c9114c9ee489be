#version 330 core
// A picture at another size: each pixel of the target takes the picture's nearest one.

uniform sampler2D picture;
uniform vec2 texels_per_pixel;

out vec4 color;

void main() {
    ivec2 last = textureSize(picture, 0) - 1;
    color = texelFetch(picture, min(ivec2(gl_FragCoord.xy * texels_per_pixel), last), 0);
}
