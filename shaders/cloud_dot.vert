#version 330 core
// A point of a cloud.

#include "chunks/cloud.glsl"

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
    dot_color = vec4(color, 1.0);
}
