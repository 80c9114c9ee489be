#version 330 core
// A picture, muted if it is not to be trusted, with marked pixels.

uniform sampler2D picture;  // of any size: a coarse one is enlarged, to the nearest pixel
uniform sampler2D marks;    // labels as bytes, row 0 at the top
uniform sampler2D colors;   // of the labels, one row; label 0 is nothing
uniform vec2 extent;        // of the target
uniform float muted;        // 0 to 1
uniform bool has_marks;

out vec4 color;

void main() {
    ivec2 full = textureSize(picture, 0);
    ivec2 at = min(ivec2(gl_FragCoord.xy * vec2(full) / extent), full - 1);
    vec3 rgb = texelFetch(picture, at, 0).rgb;
    rgb = mix(rgb, vec3(MUTED * dot(rgb, LUMINANCE)), muted);
    if (has_marks) {
        int label = int(255.0 * texelFetch(marks, ivec2(gl_FragCoord.xy), 0).r + 0.5);
        if (label > 0) rgb = texelFetch(colors, ivec2(label, 0), 0).rgb;
    }
    color = vec4(rgb, 1.0);
}
