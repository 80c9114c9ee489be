#version 330 core
// The least and greatest finite values of a block of SIDE x SIDE pixels: repeated until one pixel
// is left, the range of an image. In a block without any, the least exceeds the greatest.
// SIDE: a constant that is put in above (renderer/raster/depth_range.py).

uniform sampler2D source;
uniform bool is_range;  // the source is such an image of ranges already; else values, in w

out vec2 ends;

void main() {
    ivec2 first = SIDE * ivec2(gl_FragCoord.xy);
    ivec2 last = min(first + SIDE, textureSize(source, 0));
    ends = vec2(FARTHEST, -FARTHEST);
    for (int y = first.y; y < last.y; ++y) {
        for (int x = first.x; x < last.x; ++x) {
            vec4 here = texelFetch(source, ivec2(x, y), 0);
            if (is_range) {
                ends = vec2(min(ends.x, here.x), max(ends.y, here.y));
            } else if (here.w < FARTHEST) {
                ends = vec2(min(ends.x, here.w), max(ends.y, here.w));
            }
        }
    }
}
