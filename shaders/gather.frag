#version 330 core
// One of several pictures whose mean is shown: added by blending.

uniform sampler2D linear_color;
uniform float weight;

out vec4 color;

void main() {
    color = weight * texelFetch(linear_color, ivec2(gl_FragCoord.xy), 0);
}
