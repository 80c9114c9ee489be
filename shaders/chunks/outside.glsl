// What hides what in the outside view: the scene by its t, the image plane by its formula.
// Positions are in pixels of the target, y down; t counts along the outside camera's rays.

uniform sampler2D surface;      // the scene's: t in w; coarser than the target while things move
uniform vec2 texels;            // of the surface in a pixel of the target
uniform float perspective;      // 1: depth s is 1 / t, 0: it is t; both are affine on the screen
uniform vec2 half_size;         // of the target, in pixels
uniform float upward;           // 1: row 0 of the target is the picture's top row, -1: its last one
uniform bool has_plane;
uniform mat3 plane_from_screen; // (X q, Y q, q) of (x, y, 1) from the middle; X, Y: 0 to 1 inside
uniform vec4 plane_box;         // left, top, right, bottom around the picture, from the middle
uniform vec3 plane_depth;       // s of (x, y, 1)

float scene_t(vec2 position) {
    ivec2 last = textureSize(surface, 0) - 1;
    return texelFetch(surface, clamp(ivec2(floor(position * texels)), ivec2(0), last), 0).w;
}

float t_of(float s) {
    return perspective > 0.5 ? 1.0 / s : s;
}

// (X, Y, t) on the image plane; t is not above 0 where the plane is not in front.
vec3 plane_at(vec2 position) {
    vec3 screen = vec3(position - half_size, 1.0);
    vec3 at = plane_from_screen * screen;
    float s = dot(plane_depth, screen);
    return s > 0.0 ? vec3(at.xy / at.z, t_of(s)) : vec3(-1.0);
}

// Whether a pixel may show any of the picture: its middle, give or take two pixels.
bool may_be_on_plane(vec2 position) {
    vec2 screen = position - half_size;
    if (any(lessThan(screen, plane_box.xy - 2.0)) || any(greaterThan(screen, plane_box.zw + 2.0))) {
        return false;
    }
    for (int k = 0; k < 9; ++k) {
        vec3 at = plane_at(position + 2.0 * vec2(k % 3 - 1, k / 3 - 1));
        if (at.z > 0.0 && all(equal(at.xy, clamp(at.xy, 0.0, 1.0)))) {
            return true;
        }
    }
    return false;
}

// Whether what is drawn at a position with depth s lies behind the scene, or, unless it is part of
// the image plane, behind the picture.
bool is_hidden(vec2 position, float s, bool on_plane) {
    float t = t_of(s);
    if (t > 1.001 * scene_t(position)) {
        return true;
    }
    if (!has_plane || on_plane) {
        return false;
    }
    vec3 at = plane_at(position);
    return at.z > 0.0 && t > 1.0001 * at.z && all(equal(at.xy, clamp(at.xy, 0.0, 1.0)));
}
