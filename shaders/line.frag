#version 330 core
// A line's pixels, smooth at its edges. What hides it is asked for at the line's middle, so that it
// ends all across where it goes behind something; hidden parts are dashed and pale.

#include "chunks/outside.glsl"

uniform float edge;       // 0: the line; else its casing, this much wider on each side, at most
uniform vec4 edge_color;
uniform float dash;       // pixels from one dash to the next

flat in vec4 ends;
flat in vec2 depths;
flat in vec4 line_color;
flat in vec4 line_style;
in vec2 position;

out vec4 color;

void main() {
    int flags = int(line_style.w + 0.5);
    if (edge > 0.0 && (flags & 16) != 0) {
        discard;
    }
    vec2 along = ends.zw - ends.xy;
    float size = length(along);
    vec2 unit = size > 1e-6 ? along / size : vec2(1.0, 0.0);
    vec2 from_start = position - ends.xy;
    float x = dot(from_start, unit);
    float inside = clamp(x, 0.0, size);
    float away = length(from_start - inside * unit);
    float reach = 0.5 * line_style.x + min(edge, 0.7 * line_style.x);
    // A line thinner than a pixel is a paler one.
    float covered = clamp(reach + 0.5 - away, 0.0, 1.0) * min(1.0, 2.0 * reach);
    if ((flags & 2) == 0) {
        covered *= clamp(x + 0.5, 0.0, 1.0);
    }
    if ((flags & 4) == 0) {
        covered *= clamp(size - x + 0.5, 0.0, 1.0);
    }
    float s = mix(depths.x, depths.y, size > 1e-6 ? inside / size : 0.0);
    vec2 middle = ends.xy + inside * unit;
    bool hidden = is_hidden(middle, s, (flags & 1) != 0, plane_under(middle));
    if (hidden || (flags & 8) != 0) {
        float phase = fract((line_style.y + x) / dash) * dash;
        covered *= clamp(min(phase, 0.55 * dash - phase) + 0.5, 0.0, 1.0);
    }
    vec4 ink = edge > 0.0 ? vec4(edge_color.rgb, edge_color.a * line_color.a * line_color.a) : line_color;
    float pale = hidden ? line_style.z * (edge > 0.0 ? 0.3 : 1.0) : 1.0;
    color = vec4(ink.rgb, ink.a * covered * pale);
}
