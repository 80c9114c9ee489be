#version 330 core
// A line's pixels, smooth at its edges, with a casing round it. Colours are multiplied by their
// opacity.

uniform float width;
uniform float edge;
uniform vec4 ink;
uniform vec4 edge_color;

flat in vec4 ends;
in vec2 position;

out vec4 color;

void main() {
    vec2 along = ends.zw - ends.xy;
    float size = length(along);
    vec2 unit = size > 0.01 ? along / size : vec2(1.0, 0.0);
    vec2 from_start = position - ends.xy;
    float away = length(from_start - clamp(dot(from_start, unit), 0.0, size) * unit);
    float line = ink.a * clamp(0.5 * width + 0.5 - away, 0.0, 1.0);
    float casing = edge_color.a * clamp(0.5 * width + edge + 0.5 - away, 0.0, 1.0) * (1.0 - line);
    if (line + casing < 0.02) {
        discard;
    }
    color = vec4(line * ink.rgb + casing * edge_color.rgb, line + casing);
}
