// Where a ray meets a triangle: the point, and the vertices' weights there.
// HAS_TURNED: a constant that is put in above, whether an object's directions are not the world's.

#include "chunks/triangle.glsl"
#include "chunks/tables.glsl"

uniform sampler2D triangle_rows;
uniform isampler2D faces;     // three vertices, object
uniform sampler2D vertices;   // position in its object's space, normal, colour of each
uniform sampler2D objects;    // object_rows() in setup.py

struct Meeting {
    ivec4 face;
    mat3 corners;            // in the object's space
    vec3 anchor_inside;      // there
    mat3 world_from_object;  // of directions
    vec3 point;              // from the object's anchor, in the world's directions
    vec3 weights;
    float slender;
    bool by_ray;             // whether the point is the ray's, and the weights come from it
};

vec4 object_texel(int object, int row) {
    return texelFetch(objects, texel(OBJECT_TEXELS * object + row), 0);
}

// In image coordinates.
vec3 object_anchor(int object) {
    return object_texel(object, ROW_ANCHOR).xyz;
}

// Directions of the object's space to the world's.
mat3 object_matrix(int object) {
    return transpose(mat3(
        object_texel(object, ROW_WORLD).xyz,
        object_texel(object, ROW_WORLD + 1).xyz,
        object_texel(object, ROW_WORLD + 2).xyz));
}

// Where the ray at xy, of direction d, meets a triangle, at t.
Meeting meet(int number, vec2 xy, vec3 d, float t) {
    Meeting met;
    met.face = texelFetch(faces, texel(number), 0);
    met.world_from_object = HAS_TURNED ? object_matrix(met.face.w) : mat3(1.0);
    met.anchor_inside = object_texel(met.face.w, ROW_INSIDE).xyz;
    met.corners = mat3(
        texelFetch(vertices, texel(3 * met.face.x), 0).xyz,
        texelFetch(vertices, texel(3 * met.face.y), 0).xyz,
        texelFetch(vertices, texel(3 * met.face.z), 0).xyz);
    vec3 anchor = object_anchor(met.face.w);
    vec3 a = met.world_from_object * (met.corners[0] - met.anchor_inside);
    vec3 b = met.world_from_object * (met.corners[1] - met.anchor_inside);
    vec3 c = met.world_from_object * (met.corners[2] - met.anchor_inside);
    float reach = sqrt(max(max(dot(a, a), dot(b, b)), dot(c, c)) / dot(d, d));
    float doubt = 0.0;
    met.slender = slenderness(a, b, c);
    bool far = is_far(reach, t);
    if (far) {
        met.weights = barycentrics(
            anchor + image_from_world * a,
            anchor + image_from_world * b,
            anchor + image_from_world * c, xy, doubt);
        met.point = mat3(a, b, c) * met.weights;
    }
    // Where those are worse than t is, by a few roundings more: the other way round.
    met.by_ray = !far || !is_far(8.0 * doubt * reach / met.slender, t);
    if (met.by_ray) {
        met.point = to_ray(anchor, xy) + (t - anchor.z) * d;
        met.weights = barycentrics_at(a, b, c, met.point);
    }
    return met;
}
