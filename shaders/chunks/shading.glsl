// The one shading model, in linear light: ambient, Lambert's diffuse and Blinn's specular term.
// Source: Marschner and Shirley, Fundamentals of Computer Graphics, chapter 4 (5 from the 5th edition).
// Its numbers, and the rows of the table of objects: renderer/shared_numbers.py.

#include "chunks/meeting.glsl"

uniform sampler2D lights;   // position from the scene's near point, or direction, 1 if a point | rgb

struct Hit {
    float t;
    int object;
    vec3 point;          // relative to the object's anchor, in the world's directions
    vec3 normal;         // of the surface, unit
    vec3 smooth_normal;  // interpolated, unit; 0 where the surface is flat
    vec3 vertex_color;   // times the texture's
    vec3 gloss;          // what multiplies the specular colour: the metal's
    vec3 cell;           // the checker's coordinates, from the anchor's
    vec3 to_viewer;      // unit
};

// Interpolated vertex normal on the winding's side of the triangle, 0 where a vertex has none. Normals
// whose sum lies in the triangle's plane, up to rounding, stay as they are.
vec3 smooth_normal(mat3 normals, vec3 weights, vec3 normal) {
    if (normals[0] == vec3(0.0) || normals[1] == vec3(0.0) || normals[2] == vec3(0.0)) {
        return vec3(0.0);
    }
    vec3 mean = normals * weights;
    float size = length(mean);
    float side = dot(normals[0] + normals[1] + normals[2], normal) >= OTHER_SIDE ? 1.0 : -1.0;
    return size < SHORTEST_MEAN ? vec3(0.0) : side * mean / size;
}

// Turns both normals to the side that is seen; the smooth one never looks away from the viewer.
void face_viewer(inout Hit hit) {
    float side = dot(hit.normal, hit.to_viewer) > 0.0 ? 1.0 : -1.0;
    hit.normal *= side;
    vec3 n = hit.smooth_normal == vec3(0.0) ? hit.normal : side * hit.smooth_normal;
    float away = -dot(n, hit.to_viewer) + GRAZING;
    if (away > 0.0) {
        n = normalize(n + away * hit.to_viewer);
    }
    hit.smooth_normal = n;
}

bool is_checkered(int object) {
    return HAS_CHECKERS && object_texel(object, ROW_SPECULAR).w == float(CHECKERED);
}

mat3 cell_from_world(int object) {
    return transpose(mat3(
        object_texel(object, ROW_CELLS).xyz,
        object_texel(object, ROW_CELLS + 1).xyz,
        object_texel(object, ROW_CELLS + 2).xyz));
}

// The checker's coordinates of a point, from the anchor's; of a triangle's point with these weights,
// whose corners (from the anchor, in the object's space) are its columns. Cells lie along the object's
// axes. A coordinate is taken from the corners where their rounding, `doubt` times as large by the
// weights, is less than what the point's would be magnified to, as it is where an object is flattened.
vec3 cell_of(int object, vec3 point, mat3 corners, vec3 weights, float doubt) {
    mat3 to_cell = cell_from_world(object);
    float per_length = object_texel(object, ROW_CHECKER).w;
    mat3 rows = transpose(to_cell);
    vec3 magnified = length(point) * vec3(length(rows[0]), length(rows[1]), length(rows[2]));
    vec3 apart = doubt * per_length * max(max(abs(corners[0]), abs(corners[1])), abs(corners[2]));
    return mix(to_cell * point, per_length * (corners * weights), lessThan(apart, magnified));
}

// Diffuse reflectance: a checker is a solid pattern of cells, and a face on a border takes the cell inside.
vec3 albedo(Hit hit) {
    vec4 diffuse = object_texel(hit.object, ROW_DIFFUSE);
    if (!is_checkered(hit.object)) {
        return diffuse.rgb * hit.vertex_color;
    }
    vec3 anchor = vec3(
        object_texel(hit.object, ROW_CELLS).w,
        object_texel(hit.object, ROW_CELLS + 1).w,
        object_texel(hit.object, ROW_CELLS + 2).w);
    vec3 inward = normalize(cell_from_world(hit.object) * hit.normal);
    vec3 cell = floor(hit.cell + anchor - CELL_NUDGE * inward);
    bool other = mod(cell.x + cell.y + cell.z, 2.0) > 0.5;
    return (other ? object_texel(hit.object, ROW_CHECKER).rgb : diffuse.rgb) * hit.vertex_color;
}

vec3 shaded(Hit hit) {
    vec3 n = hit.smooth_normal;
    vec3 diffuse = albedo(hit);
    vec3 specular = object_texel(hit.object, ROW_SPECULAR).rgb * hit.gloss;
    float shininess = object_texel(hit.object, ROW_DIFFUSE).w;
    vec3 anchor = object_texel(hit.object, ROW_FROM_NEAR).xyz;
    vec3 sum = ambient * diffuse;
    for (int number = 0; number < light_count; ++number) {
        vec4 light = texelFetch(lights, texel(2 * number), 0);
        vec3 rgb = texelFetch(lights, texel(2 * number + 1), 0).rgb;
        vec3 l = light.xyz;
        if (light.w > 0.5) {
            l = (l - anchor) - hit.point;
            float away = length(l);
            if (away < NEAREST_LIGHT) {
                continue;
            }
            l /= away;
        }
        sum += rgb * diffuse * max(dot(n, l), 0.0);
        vec3 h = l + hit.to_viewer;
        float size = length(h);
        if (size >= SHORTEST_HALF) {
            sum += rgb * specular * pow(max(dot(n, h) / size, 0.0), shininess);
        }
    }
    return sum;
}
