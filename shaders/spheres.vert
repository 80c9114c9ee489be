#version 330 core
// A box around each sphere, without vertex data: the far sides of a box cover every ray that meets it,
// wherever the eye is. An instance is a sphere.

#include "chunks/sphere.glsl"

const float AROUND = 1.01;
const vec3 CORNERS[8] = vec3[8](
    vec3(-1, -1, -1), vec3(1, -1, -1), vec3(-1, 1, -1), vec3(1, 1, -1),
    vec3(-1, -1, 1), vec3(1, -1, 1), vec3(-1, 1, 1), vec3(1, 1, 1));
// Two triangles a side, counter-clockwise from outside.
const int SIDES[36] = int[36](
    0, 4, 6, 0, 6, 2,   1, 3, 7, 1, 7, 5,
    0, 1, 5, 0, 5, 4,   2, 6, 7, 2, 7, 3,
    0, 2, 3, 0, 3, 1,   4, 5, 7, 4, 7, 6);

uniform sampler2D objects;  // object_rows() in setup.py

flat out int number;

void main() {
    number = gl_InstanceID;
    Sphere sphere = sphere_at(number);
    vec3 corner = AROUND * sphere.radius * CORNERS[SIDES[gl_VertexID]];
    float near = texelFetch(objects, texel(OBJECT_TEXELS * sphere.object + ROW_INSIDE), 0).w;
    gl_Position = clip_from_image(sphere.center + image_from_world * corner, near);
}
