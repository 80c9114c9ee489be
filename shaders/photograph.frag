#version 330 core
// A picture with a photograph laid over it. The mean of both is of display values, as they are.
// EXACT: a constant that the program inserts above: true if the photograph's pixels are the image's.
// (OpenGL on the CPU takes both ways of every branch.)

uniform sampler2D picture;     // the target's size
uniform sampler2D photograph;  // display values times alpha; row 0 at the top
uniform vec2 extent;           // of the target
uniform vec4 shown;            // left, top, right, bottom of the target, in parts of the image
uniform vec4 covered;          // of the photograph, likewise
uniform float opacity;
uniform vec2 pixels;           // of the image, across and down
uniform float level;           // of the photograph's smaller versions, from 0

out vec4 color;

vec4 of_photograph(vec2 place) {
    if (!EXACT) return textureLod(photograph, place, level);
    ivec2 size = textureSize(photograph, 0);
    return texelFetch(photograph, min(ivec2(place * vec2(size)), size - 1), 0);
}

void main() {
    vec3 rgb = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    vec2 part = gl_FragCoord.xy / extent;
    vec2 at = mix(shown.xy, shown.zw, part);
    if (level == 0.0) at = (floor(at * pixels) + 0.5) / pixels;  // enlarged, pixels stay squares
    vec2 place = (at - covered.xy) / (covered.zw - covered.xy);
    bool inside = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)));
    if (inside) {
        vec4 photo = opacity * of_photograph(place);
        rgb = rgb * (1.0 - photo.a) + photo.rgb;
    }
    color = vec4(rgb, 1.0);
}
