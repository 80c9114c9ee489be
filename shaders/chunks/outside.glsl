// What hides what in the outside view: the scene by its t, the image plane by its formula.
// Positions are in pixels of the target, y down; t counts along the outside camera's rays.

uniform sampler2D surface;      // the scene's: t in w
uniform float perspective;      // 1: depth s is 1 / t, 0: it is t; both are affine on the screen
uniform vec2 half_size;         // of the target, in pixels
uniform bool has_plane;
uniform mat3 plane_from_screen; // (X q, Y q, q) of (x, y, 1) from the middle; X, Y: 0 to 1 inside
uniform vec4 plane_box;         // left, top, right, bottom around the picture, from the middle
uniform vec3 plane_depth;       // s of (x, y, 1)

float scene_t(vec2 position) {
    ivec2 size = textureSize(surface, 0);  // smaller than the target's while the scene moves
    vec2 texel = floor(position * (vec2(size) / (2.0 * half_size)));
    return texelFetch(surface, clamp(ivec2(texel), ivec2(0), size - 1), 0).w;
}

// (X q, Y q, q, s) of the image plane at a position: affine on the screen.
vec4 plane_under(vec2 position) {
    vec3 screen = vec3(position - half_size, 1.0);
    return vec4(plane_from_screen * screen, dot(plane_depth, screen));
}

// Whether a place on the plane is in the picture: X and Y from 0 to 1.
bool is_in_picture(vec4 plane) {
    return min(plane.x * (plane.z - plane.x), plane.y * (plane.z - plane.y)) >= 0.0;
}

// Whether what is drawn at a position with depth s lies behind the scene, or, unless it is part of
// the image plane, behind the picture. plane: of plane_under().
bool is_hidden(vec2 position, float s, bool on_plane, vec4 plane) {
    float t = scene_t(position);
    bool is_covered = has_plane && !on_plane && plane.w > 0.0 && is_in_picture(plane);
    return perspective > 0.5
        ? s * 1.001 * t < 1.0 || (is_covered && plane.w > 1.0001 * s)
        : s > 1.001 * t || (is_covered && s > 1.0001 * plane.w);
}
