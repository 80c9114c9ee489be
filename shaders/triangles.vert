#version 330 core
// All triangles of the scene, each vertex seen from the anchor of its object.

#include "chunks/camera.glsl"
#include "chunks/tables.glsl"

uniform sampler2D objects;  // object_rows() in setup.py

in vec3 vertex;
in int object;

void main() {
    vec4 anchor = texelFetch(objects, texel(8 * object), 0);
    vec3 anchor_world = texelFetch(objects, texel(8 * object + 1), 0).xyz;
    vec3 point = anchor.xyz + image_from_world * (vertex - anchor_world);
    gl_Position = clip_from_image(point, anchor.w);
}
