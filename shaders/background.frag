#version 330 core
// Where no primitive is seen.

#include "chunks/camera.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;
layout(location = 2) out int object;

void main() {
    color = vec4(background, 1.0);
    surface = vec4(0.0, 0.0, 0.0, uintBitsToFloat(0x7f800000u));  // infinity
    object = -1;
}
