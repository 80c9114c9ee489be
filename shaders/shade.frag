#version 330 core
// Once a pixel: from the number of the primitive that is seen to the hit and its colour.
// HAS_TRIANGLES, HAS_TURNED (an object's directions are not the world's), HAS_SPHERES, HAS_NORMALS,
// HAS_COLORS, HAS_CHECKERS, HAS_TEXTURES, HAS_METALS: constants that are put in above,
// so that a scene does not pay for what it has not (renderer/raster/programs.py). HAS_LENS: pixels
// that have looked up their primitive in a face.

#include "chunks/meeting.glsl"
#include "chunks/sphere.glsl"
#include "chunks/shading.glsl"
#include "chunks/texture.glsl"
#include "chunks/lens.glsl"

uniform isampler2D primitives;
uniform int triangle_count;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;  // normal, t
layout(location = 2) out int object;

// The parameter of the ray's hit with what it has looked up, which it may pass by.
float lens_t(int primitive, vec2 xy) {
    vec3 normal;
    return HAS_TRIANGLES && (!HAS_SPHERES || primitive < triangle_count)
        ? triangle_t(texelFetch(triangle_rows, texel(primitive), 0).xyz, xy)
        : sphere_t(sphere_at(primitive - triangle_count), xy, normal);
}

void main() {
    int primitive = texelFetch(primitives, ivec2(gl_FragCoord.xy), 0).x;
    vec2 xy = image_position(gl_FragCoord.xy);
    if (HAS_LENS) {
        vec3 position = lens_position();
        if (!is_on_face(position)) {
            discard;
        }
        xy = position.xy;
        if (!counts(lens_t(primitive, xy), xy)) {
            xy = texel_middle(xy);  // whose ray does hit it
        }
    }
    vec3 d = ray_direction(xy);
    Hit hit;
    hit.to_viewer = -normalize(d);
    hit.smooth_normal = vec3(0.0);
    hit.vertex_color = vec3(1.0);
    hit.gloss = vec3(1.0);
    if (HAS_TRIANGLES && (!HAS_SPHERES || primitive < triangle_count)) {
        hit.t = triangle_t(texelFetch(triangle_rows, texel(primitive), 0).xyz, xy);
        Meeting met = meet(primitive, xy, d, hit.t);
        ivec4 face = met.face;
        hit.object = face.w;
        hit.point = met.point;
        if (is_checkered(hit.object)) {
            mat3 inside = met.corners - mat3(met.anchor_inside, met.anchor_inside, met.anchor_inside);
            hit.cell = cell_of(
                hit.object, hit.point, inside, met.weights, met.by_ray ? met.slender : 1.0);
        }
        hit.normal = face_normal(
            met.world_from_object * (met.corners[1] - met.corners[0]),
            met.world_from_object * (met.corners[2] - met.corners[1]),
            met.world_from_object * (met.corners[0] - met.corners[2]), hit.to_viewer);
        if (HAS_NORMALS) {
            mat3 normals = mat3(
                texelFetch(vertices, texel(3 * face.x + 1), 0).xyz,
                texelFetch(vertices, texel(3 * face.y + 1), 0).xyz,
                texelFetch(vertices, texel(3 * face.z + 1), 0).xyz);
            hit.smooth_normal = smooth_normal(normals, met.weights, hit.normal);
        }
        if (HAS_COLORS) {
            hit.vertex_color = mat3(
                texelFetch(vertices, texel(3 * face.x + 2), 0).xyz,
                texelFetch(vertices, texel(3 * face.y + 2), 0).xyz,
                texelFetch(vertices, texel(3 * face.z + 2), 0).xyz) * met.weights;
        }
        if (HAS_TEXTURES) {
            vec2 place = place_between(face.xyz, met.weights);
            hit.vertex_color *= texture_light(hit.object, place);
            if (HAS_METALS) {
                hit.gloss = gloss_at(hit.object, place);
            }
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
            vec2 place = place_on_sphere(hit.normal, object_texel(hit.object, ROW_CHECKER));
            hit.vertex_color = texture_light(hit.object, place);
            if (HAS_METALS) {
                hit.gloss = gloss_at(hit.object, place);
            }
        }
    }
    face_viewer(hit);
    color = vec4(shaded(hit), 1.0);
    surface = vec4(hit.smooth_normal, HAS_LENS ? hit.t * stretch(xy) : hit.t);
    object = hit.object;
}
