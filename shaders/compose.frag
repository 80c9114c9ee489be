#version 330 core
// Two pictures side by side in one place, muted if they are not to be trusted, with marked pixels.

uniform sampler2D left;    // of any size: coarse ones are enlarged, to the nearest pixel
uniform sampler2D right;
uniform sampler2D marks;   // labels as bytes, row 0 at the top
uniform sampler2D colors;  // of the labels, one row; label 0 is nothing
uniform vec2 extent;       // of the target
uniform float divider;     // the first column of `right`
uniform float rise;        // 0 to 1: the opacity of `right` over `left`
uniform float muted;       // 0 to 1
uniform bool has_marks;

out vec4 color;

vec3 fetch(sampler2D picture) {
    ivec2 full = textureSize(picture, 0);
    ivec2 at = min(ivec2(gl_FragCoord.xy * vec2(full) / extent), full - 1);
    return texelFetch(picture, at, 0).rgb;
}

void main() {
    vec3 rgb = mix(fetch(left), fetch(right), gl_FragCoord.x < divider ? 0.0 : rise);
    rgb = mix(rgb, vec3(MUTED * dot(rgb, LUMINANCE)), muted);
    if (has_marks) {
        int label = int(255.0 * texelFetch(marks, ivec2(gl_FragCoord.xy), 0).r + 0.5);
        if (label > 0) rgb = texelFetch(colors, ivec2(label, 0), 0).rgb;
    }
    color = vec4(rgb, 1.0);
}
