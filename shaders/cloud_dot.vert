#version 330 core
// A point of a cloud, or an end of one of its lines where these are one pixel wide.

#include "chunks/cloud.glsl"

uniform vec4 ink;      // of all; without opacity: each has its own colour
uniform float dot_px;

in vec3 place;
in vec3 color;

flat out vec4 dot_color;

void main() {
    vec3 spot = spot_of(place);
    float w = perspective > 0.5 ? spot.z : 1.0;
    float depth = perspective > 0.5 ? spot.z - 2.0 * near : 2.0 * depth_of(spot.z) - 1.0;
    gl_Position = vec4(spot.xy / half_size, depth, w);  // row 0 is the image's top
    gl_PointSize = dot_px;
    dot_color = ink.a > 0.0 ? ink : vec4(color, 1.0);
}
