// Ray and sphere, exactly. Source: Haines, Günther and Akenine-Möller, Precision Improvements for
// Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7.

#include "chunks/camera.glsl"
#include "chunks/tables.glsl"

uniform sampler2D spheres;  // sphere_rows() in setup.py

struct Sphere {
    vec3 center;       // in image coordinates
    float radius;
    vec3 from_center;  // to the eye
    float power;       // |from_center|^2 - radius^2: negative where the eye is inside
    int object;
};

Sphere sphere_at(int number) {
    vec4 center = texelFetch(spheres, texel(3 * number), 0);
    vec4 eye = texelFetch(spheres, texel(3 * number + 1), 0);
    vec4 rest = texelFetch(spheres, texel(3 * number + 2), 0);
    return Sphere(center.xyz, center.w, eye.xyz, eye.w, int(rest.x));
}

// t of the nearest hit that counts, or -1.
float sphere_t(Sphere sphere, vec2 xy) {
    vec3 d = ray_direction(xy);
    float a = dot(d, d);
    // Start beside the centre, not at the eye: nothing large cancels for a small sphere far away.
    vec3 f = to_ray(sphere.center, xy);
    float along = -dot(f, d) / a;
    float middle = sphere.center.z + along;
    vec3 off = f + along * d;
    float square = sphere.radius * sphere.radius - dot(off, off);
    if (perspective > 0.5) {
        // A large sphere close to the eye: there the classic form cancels less.
        float b = -dot(sphere.from_center, d);
        float ahead = b * b / a;
        square = ahead < sphere.radius * sphere.radius ? ahead - sphere.power : square;
        middle = b / a;
    }
    if (square < 0.0) {
        return -1.0;
    }
    float half_chord = sqrt(square / a);
    float t_near = middle - half_chord;
    float t_far = middle + half_chord;
    if (perspective > 0.5) {
        // The product of both is known: of the one that cancels, take the quotient.
        if (middle > 0.0) {
            t_near = sphere.power / (a * t_far);
        } else {
            t_far = sphere.power / (a * t_near);
        }
    }
    return counts(t_near) ? t_near : counts(t_far) ? t_far : -1.0;
}
