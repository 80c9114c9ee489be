// Ray and sphere, exactly. Source: Haines, Günther and Akenine-Möller, Precision Improvements for
// Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7.

#include "chunks/camera.glsl"
#include "chunks/tables.glsl"

uniform sampler2D spheres;  // sphere_rows() in setup.py

struct Sphere {
    vec3 center;       // in image coordinates
    float radius;
    vec3 from_center;  // to the origin of the ray through the image's centre
    float power;       // |from_center|^2 - radius^2: negative where that is inside
    vec3 from_anchor;  // to the centre, in the world
    int object;
};

Sphere sphere_at(int number) {
    vec4 center = texelFetch(spheres, texel(SPHERE_TEXELS * number), 0);
    vec4 origin = texelFetch(spheres, texel(SPHERE_TEXELS * number + 1), 0);
    vec4 anchor = texelFetch(spheres, texel(SPHERE_TEXELS * number + 2), 0);
    return Sphere(center.xyz, center.w, origin.xyz, origin.w, anchor.xyz, int(anchor.w));
}

// t of the nearest hit that counts, or -1, and the vector from the sphere's centre to the hit.
float sphere_t(Sphere sphere, vec2 xy, out vec3 normal) {
    vec3 d = ray_direction(xy);
    float a = dot(d, d);
    // A small sphere far away: seen from beside its centre, not from the eye, nothing large cancels.
    vec3 beside = to_ray(sphere.center, xy);
    float along = -dot(beside, d) / a;
    vec3 off = beside + along * d;
    float square = sphere.radius * sphere.radius - dot(off, off);
    // A large sphere close by: there the classic form cancels less; what is large in it was
    // composed in float64 (setup.py).
    vec3 moved = (1.0 - perspective) * (xy.x * step_x + xy.y * step_y);
    vec3 from_center = sphere.from_center + moved;
    float power = sphere.power + dot(2.0 * sphere.from_center + moved, moved);
    float middle = -dot(from_center, d) / a;
    if (a * middle * middle < sphere.radius * sphere.radius) {
        square = a * middle * middle - power;
    }
    if (square < 0.0) {
        return -1.0;
    }
    // The product of both hits is known: the one that cancels is a quotient.
    float half_chord = sqrt(square / a);
    float t_near = middle - half_chord;
    float t_far = middle + half_chord;
    if (middle > 0.0) {
        t_near = power / (a * t_far);
    } else {
        t_far = power / (a * t_near);
    }
    float t = counts(t_near, xy) ? t_near : counts(t_far, xy) ? t_far : -1.0;
    float from_beside = t == t_near ? along - half_chord : along + half_chord;
    normal = is_far(abs(from_beside), t) ? beside + from_beside * d : from_center + t * d;
    return t;
}
