#version 330 core
// A line segment as a rectangle on the screen, wide enough for its edge. An instance is a segment
// (SEGMENT in renderer/raster/lines.py); no glLineWidth, which core profiles need not have.

uniform vec2 half_size;  // of the target, in pixels
uniform float edge;      // beyond the line's own width, on each side; thin lines have less

in vec2 start;
in vec2 end;
in vec2 depth;
in vec4 color;
in vec4 style;  // width, length of the line before this segment, light where hidden, flags

flat out vec4 ends;
flat out vec2 depths;
flat out vec4 line_color;
flat out vec4 line_style;
out vec2 position;

void main() {
    vec2 along = end - start;
    float size = length(along);
    along = size > 1e-6 ? along / size : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float reach = 0.5 * style.x + min(edge, 0.7 * style.x) + 1.0;
    vec2 side = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    position = (side.x < 0.0 ? start : end) + reach * (side.x * along + side.y * across);
    ends = vec4(start, end);
    depths = depth;
    line_color = color;
    line_style = style;
    vec2 middle = position - half_size;
    gl_Position = vec4(middle / half_size, 0.0, 1.0);
}
