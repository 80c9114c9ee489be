// Textures: where of its image a hit is, and the light between the middles of four texels there, at
// full resolution. Texels are square roots of linear light (renderer/scene/texture.py). GL's own
// filters would do the same with fewer digits, and not alike everywhere.

#include "chunks/tables.glsl"

uniform isampler2D texels;    // of all images, one after another
uniform isampler2D textures;  // two of each object, as in FlatScene: image, more images
uniform sampler2D uv;         // of each vertex, in texels

const float PI = 3.14159265358979;

// The angle of (x, y) from the x axis; GL's own is told in few digits. Source: Moshier, Cephes, atanf.
float angle_of(float y, float x) {
    float a = abs(x);
    float b = abs(y);
    float t = max(a, b) > 0.0 ? min(a, b) / max(a, b) : 0.0;
    bool is_steep = t > 0.41421356;
    t = is_steep ? (t - 1.0) / (t + 1.0) : t;
    float square = t * t;
    float p = ((8.05374449538e-2 * square - 1.38776856032e-1) * square + 1.99777106478e-1) * square;
    float angle = t + (p - 3.33329491539e-1) * square * t + (is_steep ? 0.25 * PI : 0.0);
    angle = a < b ? 0.5 * PI - angle : angle;
    angle = x < 0.0 ? PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

// Texel coordinates of a point of a triangle.
vec2 place_between(ivec3 vertices, vec3 weights) {
    vec2 a = texelFetch(uv, texel(vertices.x), 0).xy;
    vec2 b = texelFetch(uv, texel(vertices.y), 0).xy;
    vec2 c = texelFetch(uv, texel(vertices.z), 0).xy;
    return a + (weights.y * (b - a) + weights.z * (c - a));
}

// Of a direction from a sphere's centre: longitude and latitude. map: (u, v) to texels, see flat.py.
vec2 place_on_sphere(vec3 n, vec4 map) {
    float u = 0.5 + angle_of(n.x, n.z) / (2.0 * PI);
    float v = 0.5 + angle_of(n.y, length(n.xz)) / PI;
    return vec2(map.x * u + map.y, map.z * v + map.w);
}

// The number of a texel that may lie beyond an image of `size` texels in this direction.
int wrapped(float index, int size, int wrap) {
    if (wrap == CLAMP) {
        return int(clamp(index, 0.0, float(size - 1)));
    }
    float period = float(wrap == MIRROR ? 2 * size : size);
    float inside = index - period * floor(index / period);
    // Divided less exactly than it could be, it may be off by one period.
    inside += inside < 0.0 ? period : inside >= period ? -period : 0.0;
    inside = inside > float(size - 1) ? period - 1.0 - inside : inside;
    return int(clamp(inside, 0.0, float(size - 1)));
}

vec3 texel_light(int number) {
    int word = texelFetch(texels, texel(number), 0).x;
    const int MOST = (1 << TEXEL_BITS) - 1;
    vec3 roots = vec3(word & MOST, (word >> TEXEL_BITS) & MOST, word >> (2 * TEXEL_BITS));
    return roots * roots * (1.0 / float(MOST * MOST));
}

// The four texels around a place: the upper two, the lower two. part: how far behind the middle of
// the first the place is.
ivec4 four_texels(ivec4 image, int first, vec2 place, out vec2 part) {
    vec2 corner = floor(place - 0.5);
    part = place - 0.5 - corner;
    ivec2 wraps = ivec2(image.w & ((1 << WRAP_BITS) - 1), image.w >> WRAP_BITS);
    int left = wrapped(corner.x, image.y, wraps.x);
    int right = wrapped(corner.x + 1.0, image.y, wraps.x);
    int upper = first + (image.y + 1) * wrapped(corner.y, image.z, wraps.y);
    int lower = first + (image.y + 1) * wrapped(corner.y + 1.0, image.z, wraps.y);
    return ivec4(upper + left, upper + right, lower + left, lower + right);
}

vec3 image_light(ivec4 image, int first, vec2 place) {
    vec2 part;
    ivec4 four = four_texels(image, first, place, part);
    return mix(
        mix(texel_light(four.x), texel_light(four.y), part.x),
        mix(texel_light(four.z), texel_light(four.w), part.x), part.y);
}

// Linear light of an object's texture; 1 where it has none.
vec3 texture_light(int object, vec2 place) {
    ivec4 image = texelFetch(textures, texel(2 * object), 0);
    return image.y == 0 ? vec3(1.0) : image_light(image, image.x, place);
}

// What multiplies an object's specular colour.
vec3 gloss_at(int object, vec2 place) {
    int first = texelFetch(textures, texel(2 * object + 1), 0).x;
    return first < 0
        ? vec3(1.0) : image_light(texelFetch(textures, texel(2 * object), 0), first, place);
}

bool has_holes(int object) {
    return texelFetch(textures, texel(2 * object + 1), 0).y >= 0;
}

// Whether an object that has holes has one at a place.
bool is_hole(int object, vec2 place) {
    int first = texelFetch(textures, texel(2 * object + 1), 0).y;
    vec2 part;
    ivec4 four = four_texels(texelFetch(textures, texel(2 * object), 0), first, place, part);
    vec4 opacity = vec4(
        texelFetch(texels, texel(four.x), 0).x, texelFetch(texels, texel(four.y), 0).x,
        texelFetch(texels, texel(four.z), 0).x, texelFetch(texels, texel(four.w), 0).x);
    vec4 across = vec4(vec2(1.0 - part.x, part.x), vec2(1.0 - part.x, part.x));
    return dot(opacity * across, vec4(vec2(1.0 - part.y), vec2(part.y))) < 0.0;
}
