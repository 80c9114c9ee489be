// From a cloud's world to the screen of the camera that looks. Positions are in pixels from the
// image's middle, y down; t counts along that camera's rays.

uniform mat4x3 screen_from_cloud;  // (X, Y, t) of (x, y, z, 1); X and Y multiplied by t in perspective
uniform float perspective;         // 1, or 0: parallel
uniform float near;                // the least t that is drawn
uniform float far;                 // where depths end: in parallel projection
uniform vec2 half_size;            // of the image, in pixels

vec3 spot_of(vec3 place) {
    return screen_from_cloud * vec4(place, 1.0);
}

// From 0 to 1, affine on the screen.
float depth_of(float t) {
    return perspective > 0.5 ? 1.0 - near / t : (t - near) / (far - near);
}
