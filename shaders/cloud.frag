#version 330 core
// A cloud's picture over the scene's: paler where the scene, or the other camera's picture, is
// nearer. Both know their depths.

#include "chunks/outside.glsl"

uniform sampler2D cloud;        // colours multiplied by their opacity, row 0 at the top
uniform sampler2D cloud_depth;
uniform vec2 s_of_depth;        // s is the first, and the second times the depth
uniform float hidden;           // light where something is nearer

out vec4 color;

void main() {
    float row = gl_FragCoord.y;
    vec2 position = vec2(gl_FragCoord.x, row);
    vec4 shown = texelFetch(cloud, ivec2(position), 0);
    if (shown.a == 0.0) {
        discard;
    }
    float s = s_of_depth.x + s_of_depth.y * texelFetch(cloud_depth, ivec2(position), 0).r;
    color = shown * (is_hidden(position, s, false, plane_under(position)) ? hidden : 1.0);
}
