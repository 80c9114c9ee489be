#version 330 core
// Once a pixel: from the number of the primitive that is seen to the hit and its colour.
// HAS_TRIANGLES, HAS_TURNED (an object's directions are not the world's), HAS_SPHERES, HAS_NORMALS,
// HAS_COLORS, HAS_CHECKERS, HAS_TEXTURES: constants that are put in above,
// so that a scene does not pay for what it has not (renderer/raster/programs.py).

#include "chunks/triangle.glsl"
#include "chunks/sphere.glsl"
#include "chunks/shading.glsl"
#include "chunks/texture.glsl"

uniform isampler2D primitives;
uniform sampler2D triangle_rows;
uniform isampler2D faces;     // three vertices, object
uniform sampler2D vertices;   // position in its object's space, normal, colour of each
uniform int triangle_count;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;  // normal, t
layout(location = 2) out int object;

void main() {
    int primitive = texelFetch(primitives, ivec2(gl_FragCoord.xy), 0).x;
    vec2 xy = image_position(gl_FragCoord.xy);
    vec3 d = ray_direction(xy);
    Hit hit;
    hit.to_viewer = -normalize(d);
    hit.smooth_normal = vec3(0.0);
    hit.vertex_color = vec3(1.0);
    if (HAS_TRIANGLES && (!HAS_SPHERES || primitive < triangle_count)) {
        ivec4 face = texelFetch(faces, texel(primitive), 0);
        hit.object = face.w;
        hit.t = triangle_t(texelFetch(triangle_rows, texel(primitive), 0).xyz, xy);
        vec3 anchor = object_anchor(hit.object);
        mat3 world_from_object = HAS_TURNED ? object_matrix(hit.object) : mat3(1.0);
        vec3 anchor_inside = object_texel(hit.object, ROW_INSIDE).xyz;
        mat3 corners = mat3(
            texelFetch(vertices, texel(3 * face.x), 0).xyz,
            texelFetch(vertices, texel(3 * face.y), 0).xyz,
            texelFetch(vertices, texel(3 * face.z), 0).xyz);
        vec3 a = world_from_object * (corners[0] - anchor_inside);
        vec3 b = world_from_object * (corners[1] - anchor_inside);
        vec3 c = world_from_object * (corners[2] - anchor_inside);
        vec3 weights;
        float reach = sqrt(max(max(dot(a, a), dot(b, b)), dot(c, c)) / dot(d, d));
        float doubt = 0.0;
        float slender = slenderness(a, b, c);
        bool far = is_far(reach, hit.t);
        if (far) {
            weights = barycentrics(
                anchor + image_from_world * a,
                anchor + image_from_world * b,
                anchor + image_from_world * c, xy, doubt);
            hit.point = mat3(a, b, c) * weights;
        }
        // Where those are worse than t is, by a few roundings more: the other way round.
        bool by_ray = !far || !is_far(8.0 * doubt * reach / slender, hit.t);
        if (by_ray) {
            hit.point = to_ray(anchor, xy) + (hit.t - anchor.z) * d;
            weights = barycentrics_at(a, b, c, hit.point);
        }
        if (is_checkered(hit.object)) {
            mat3 inside = corners - mat3(anchor_inside, anchor_inside, anchor_inside);
            hit.cell = cell_of(hit.object, hit.point, inside, weights, by_ray ? slender : 1.0);
        }
        hit.normal = face_normal(
            world_from_object * (corners[1] - corners[0]),
            world_from_object * (corners[2] - corners[1]),
            world_from_object * (corners[0] - corners[2]), hit.to_viewer);
        if (HAS_NORMALS) {
            mat3 normals = mat3(
                texelFetch(vertices, texel(3 * face.x + 1), 0).xyz,
                texelFetch(vertices, texel(3 * face.y + 1), 0).xyz,
                texelFetch(vertices, texel(3 * face.z + 1), 0).xyz);
            hit.smooth_normal = smooth_normal(normals, weights, hit.normal);
        }
        if (HAS_COLORS) {
            hit.vertex_color = mat3(
                texelFetch(vertices, texel(3 * face.x + 2), 0).xyz,
                texelFetch(vertices, texel(3 * face.y + 2), 0).xyz,
                texelFetch(vertices, texel(3 * face.z + 2), 0).xyz) * weights;
        }
        if (HAS_TEXTURES) {
            hit.vertex_color *= texture_light(hit.object, place_between(face.xyz, weights));
        }
    } else if (HAS_SPHERES) {
        Sphere sphere = sphere_at(primitive - triangle_count);
        hit.object = sphere.object;
        vec3 normal;
        hit.t = sphere_t(sphere, xy, normal);
        vec3 anchor = object_anchor(hit.object);
        hit.point = is_far(sphere.radius * inversesqrt(dot(d, d)), hit.t)
            ? sphere.from_anchor + normal
            : to_ray(anchor, xy) + (hit.t - anchor.z) * d;
        hit.normal = normalize(normal);
        if (is_checkered(hit.object)) {
            hit.cell = cell_from_world(hit.object) * hit.point;
        }
        if (HAS_TEXTURES) {
            vec4 map = object_texel(hit.object, ROW_CHECKER);
            hit.vertex_color = texture_light(hit.object, place_on_sphere(hit.normal, map));
        }
    }
    face_viewer(hit);
    color = vec4(shaded(hit), 1.0);
    surface = vec4(hit.smooth_normal, hit.t);
    object = hit.object;
}
