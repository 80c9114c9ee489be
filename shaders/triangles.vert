#version 330 core
// All triangles of the scene, each vertex seen from the anchor of its object.
// HAS_TURNED: a constant that is put in above, whether an object's directions are not the world's.

#include "chunks/camera.glsl"
#include "chunks/tables.glsl"

uniform sampler2D objects;  // object_rows() in setup.py

in vec3 vertex;  // in its object's space
in int object;

void main() {
    vec4 inside = texelFetch(objects, texel(OBJECT_TEXELS * object + ROW_INSIDE), 0);
    vec3 anchor = texelFetch(objects, texel(OBJECT_TEXELS * object + ROW_ANCHOR), 0).xyz;
    mat3 image_from_object = image_from_world;
    if (HAS_TURNED) {
        image_from_object = transpose(mat3(
            texelFetch(objects, texel(OBJECT_TEXELS * object + ROW_IMAGE), 0).xyz,
            texelFetch(objects, texel(OBJECT_TEXELS * object + ROW_IMAGE + 1), 0).xyz,
            texelFetch(objects, texel(OBJECT_TEXELS * object + ROW_IMAGE + 2), 0).xyz));
    }
    vec3 point = anchor + image_from_object * (vertex - inside.xyz);
    gl_Position = clip_from_image(point, inside.w);
}
