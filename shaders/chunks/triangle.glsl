// Ray and triangle.

#include "chunks/camera.glsl"

// t of the ray's hit with a triangle's plane; the row is that of triangle_rows() in setup.py.
float triangle_t(vec3 row, vec2 xy) {
    float value = row.x * xy.x + row.y * xy.y + row.z;
    return perspective > 0.5 ? 1.0 / value : value;
}

// The unit normal of a triangle's edges; `otherwise` where float32 has none for it. Divided first:
// the square of a small triangle's normal would be 0.
vec3 unit_across(vec3 first, vec3 second, vec3 otherwise) {
    vec3 normal = cross(first, second);
    float largest = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    return largest > 0.0 ? normalize(normal * (1.0 / largest)) : otherwise;
}

// A triangle's normal by the two shorter of its edges, one after the other: they keep a sliver's digits.
vec3 face_normal(vec3 e, vec3 f, vec3 g, vec3 otherwise) {
    float longest = max(max(dot(e, e), dot(f, f)), dot(g, g));
    if (longest == dot(g, g)) {
        return unit_across(e, f, otherwise);
    }
    return longest == dot(e, e) ? unit_across(f, g, otherwise) : unit_across(g, e, otherwise);
}

// A triangle's longest side over its height: at least 2 / sqrt(3).
float slenderness(vec3 a, vec3 b, vec3 c) {
    float longest = max(max(dot(b - a, b - a), dot(c - b, c - b)), dot(a - c, a - c));
    return longest / length(cross(b - a, c - a));
}

// Barycentrics from the areas that a point makes with the edges. Vertices are snapped to a fraction of
// a pixel, so that a centre may lie just outside: pulled back in.
vec3 from_areas(vec3 areas) {
    float whole = areas.x + areas.y + areas.z;
    if (whole == 0.0) {
        return vec3(1.0, 0.0, 0.0);
    }
    vec3 inside = max(areas / whole, 0.0);
    return inside / (inside.x + inside.y + inside.z);
}

// Weights of p, q and r that give 0, where qr is the longest side: of p by the height over that side,
// which a sliver hardly knows; then of r along the side, whatever p's is, so that the place stays right.
vec3 over_longest(vec2 p, vec2 q, vec2 r) {
    vec2 side = r - q;
    vec2 other = p - q;
    float whole = side.x * other.y - side.y * other.x;
    if (whole == 0.0) {
        return vec3(1.0, 0.0, 0.0);
    }
    float of_p = clamp((q.x * side.y - q.y * side.x) / whole, 0.0, 1.0);
    float of_r = clamp(-dot(q + of_p * other, side) / dot(side, side), 0.0, 1.0 - of_p);
    return vec3(of_p, 1.0 - of_p - of_r, of_r);
}

// Barycentrics of the ray's hit, from the corners' image coordinates, with the pixel as origin, pulled
// back in like from_areas'. doubt: how much larger the areas that the pixel makes with the sides are
// composed from than the triangle's area is: much, where it is seen as a sliver.
vec3 barycentrics(vec3 a, vec3 b, vec3 c, vec2 xy, out float doubt) {
    vec2 p = a.xy - xy * weight(a.z);
    vec2 q = b.xy - xy * weight(b.z);
    vec2 r = c.xy - xy * weight(c.z);
    float whole = (r.x - q.x) * (p.y - q.y) - (r.y - q.y) * (p.x - q.x);
    doubt = (length(q) * length(r) + length(r) * length(p) + length(p) * length(q)) / abs(whole);
    float of_p = dot(r - q, r - q);
    float of_q = dot(p - r, p - r);
    float of_r = dot(q - p, q - p);
    if (of_p >= max(of_q, of_r)) {
        return over_longest(p, q, r);
    }
    return of_q >= of_r ? over_longest(q, r, p).zxy : over_longest(r, p, q).yzx;
}

// The same of a point of the triangle: for one that is near the eye or seen edge on, whose areas in the
// image have no digits left.
vec3 barycentrics_at(vec3 a, vec3 b, vec3 c, vec3 point) {
    vec3 p = a - point;
    vec3 q = b - point;
    vec3 r = c - point;
    return from_areas(cross(b - a, c - a) * mat3(cross(q, r), cross(r, p), cross(p, q)));
}
