#version 330 core
// Triangles whose vertices were moved to where a lens shows them (renderer/raster/moved.py).

#include "chunks/camera.glsl"

in vec3 vertex;  // in image coordinates, with t
in vec3 share;   // of the original triangle's corners; of a sphere, the normal
in int number;   // of the primitive

out vec3 place;
out float t;
flat out int seen;

void main() {
    place = share;
    t = vertex.z;
    seen = number;
    gl_Position = vec4(vertex.x / half_size.x, -vertex.y / half_size.y, 0.0, vertex.z);
}
