// Ray and triangle.

#include "chunks/camera.glsl"

// t of the ray's hit with a triangle's plane; the row is that of triangle_rows() in setup.py.
float triangle_t(vec3 row, vec2 xy) {
    float value = row.x * xy.x + row.y * xy.y + row.z;
    return perspective > 0.5 ? 1.0 / value : value;
}

// Barycentrics of the ray's hit, from the corners' image coordinates: the three areas that the pixel
// makes with the projected edges. Source: Woop, Benthin and Wald, Watertight Ray/Triangle
// Intersection (2013), with the pixel as origin.
// Vertices are snapped to a fraction of a pixel, so that a centre may lie just outside: pulled back in.
vec3 barycentrics(vec3 a, vec3 b, vec3 c, vec2 xy) {
    vec2 p = a.xy - xy * weight(a.z);
    vec2 q = b.xy - xy * weight(b.z);
    vec2 r = c.xy - xy * weight(c.z);
    vec3 areas = vec3(q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x);
    float whole = areas.x + areas.y + areas.z;
    if (whole == 0.0) {
        return vec3(1.0, 0.0, 0.0);
    }
    vec3 inside = max(areas / whole, 0.0);
    return inside / (inside.x + inside.y + inside.z);
}

// The unit normal of a triangle's edges; `otherwise` where float32 has none for it. Divided first:
// the square of a small triangle's normal would be 0.
vec3 unit_across(vec3 first, vec3 second, vec3 otherwise) {
    vec3 normal = cross(first, second);
    float largest = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    return largest > 0.0 ? normalize(normal * (1.0 / largest)) : otherwise;
}
