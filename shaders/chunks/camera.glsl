// The camera: the uniform block (renderer/raster/setup.py), and the ray through a pixel's centre.
// Image coordinates: pixels from the image's centre, x right, y up; row 0 of the framebuffer is the
// image's top row. In perspective a point's x and y are kept multiplied by its t.
// HAS_LENS: a constant that is put in above: the image is a face in which a lens's pixels are
// looked up (renderer/camera/lens_faces.py).

layout(std140) uniform Camera {
    mat3 image_from_world;  // of vectors; points are taken relative to an anchor
    vec3 step_x;            // world vector of one pixel to the right, at t = 1 in perspective
    float perspective;      // 1: perspective, 0: parallel
    vec3 step_y;            // of one pixel up
    float depth_scale;
    vec3 direction;         // of the ray through the image's centre
    int depth_low;
    vec3 background;
    int light_count;
    vec3 ambient;
    float padding;
    vec2 half_size;         // of the image, in pixels
    vec2 t_range;           // a hit counts for t_range.x < t < t_range.y
    vec2 clip_half;         // half the viewport, in pixels: the image and a margin around it
    vec2 clip_z;            // z in clip space is clip_z.x * t + clip_z.y, before the near plane is set
    vec4 plane;             // of a face: the image's middle on the plane at distance 1, a pixel's steps
    vec3 unit;              // see stretch()
};

// window: gl_FragCoord.xy, whose centres of pixels are halves: exact.
vec2 image_position(vec2 window) {
    return vec2(window.x - half_size.x, half_size.y - window.y);
}

vec3 ray_direction(vec2 xy) {
    return direction + perspective * (xy.x * step_x + xy.y * step_y);
}

// The factor that a point's x and y are kept multiplied by.
float weight(float t) {
    return mix(1.0, t, perspective);
}

// From a point, given in image coordinates, to the ray's point with the same t: a world vector.
vec3 to_ray(vec3 point, vec2 xy) {
    vec2 pixels = xy * weight(point.z) - point.xy;
    return pixels.x * step_x + pixels.y * step_y;
}

// near: of the point's object. In perspective z is t - 2 near: nothing is cut but t < near.
vec4 clip_from_image(vec3 point, float near) {
    float z = clip_z.x * point.z + clip_z.y - 2.0 * near;
    return vec4(point.x / clip_half.x, -point.y / clip_half.y, z, weight(point.z));
}

// The lens's ray parameter of what is hit at t = 1 of a face's ray.
float stretch(vec2 xy) {
    return HAS_LENS ? length(unit * vec3(plane.xy + xy * plane.zw, 1.0)) : 1.0;
}

bool counts(float t, vec2 xy) {
    float along = HAS_LENS ? t * stretch(xy) : t;
    return along > t_range.x && along < t_range.y;
}

// Window depth: the place of t among the floats. The farthest depth of all stays for "nothing"
// (renderer/raster/scene_data.py).
float depth(float t) {
    return clamp(float(floatBitsToInt(t) - depth_low) * depth_scale, 0.0, 0.999999);
}

// Whether a hit at t is better located from something near it, `reach` away, than from the eye.
bool is_far(float reach, float t) {
    return reach < t;
}
