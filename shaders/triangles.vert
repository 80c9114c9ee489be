#version 330 core
// All triangles of the scene, each vertex seen from the anchor of its object.

#include "chunks/camera.glsl"
#include "chunks/tables.glsl"

uniform sampler2D objects;  // object_rows() in setup.py

in vec3 vertex;  // in its object's space
in int object;

void main() {
    vec4 anchor = texelFetch(objects, texel(14 * object), 0);
    vec4 x = texelFetch(objects, texel(14 * object + 1), 0);
    vec4 y = texelFetch(objects, texel(14 * object + 2), 0);
    vec4 t = texelFetch(objects, texel(14 * object + 3), 0);
    vec3 apart = vertex - anchor.xyz;
    vec3 point = vec3(x.w, y.w, t.w) + vec3(dot(x.xyz, apart), dot(y.xyz, apart), dot(t.xyz, apart));
    gl_Position = clip_from_image(point, anchor.w);
}
