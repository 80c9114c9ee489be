#version 330 core
// A cloud's line as a rectangle on the screen, wide enough for its edge: an instance is a line. What
// is nearer than `near` is cut off.

#include "chunks/cloud.glsl"

uniform float width;  // pixels
uniform float edge;   // beyond that, on each side

in vec3 start;
in vec3 end;

flat out vec4 ends;
out vec2 position;

vec2 on_screen(vec3 spot) {
    return perspective > 0.5 ? spot.xy / spot.z : spot.xy;
}

void main() {
    vec3 first = spot_of(start);
    vec3 last = spot_of(end);
    if (first.z < near && last.z < near) {
        ends = vec4(0.0);
        position = vec2(0.0);
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nowhere
        return;
    }
    if (first.z < near) {
        first = mix(first, last, (near - first.z) / (last.z - first.z));
    } else if (last.z < near) {
        last = mix(last, first, (near - last.z) / (first.z - last.z));
    }
    vec2 from = on_screen(first);
    vec2 to = on_screen(last);
    vec2 along = to - from;
    float size = length(along);
    along = size > 0.01 ? along / size : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float reach = 0.5 * width + edge + 1.0;
    vec2 side = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    position = (side.x < 0.0 ? from : to) + reach * (side.x * along + side.y * across);
    ends = vec4(from, to);
    float depth = depth_of(side.x < 0.0 ? first.z : last.z);
    gl_Position = vec4(position / half_size, 2.0 * depth - 1.0, 1.0);
}
