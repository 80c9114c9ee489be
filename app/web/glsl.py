"""The rasterizer's shaders in GLSL ES 3.00, for WebGL 2. The shading has one source: shaders/.

WebGL has no primitive numbers, so triangles look up their vertices. It draws colours to the 8-bit
screen, so the display transform is part of the shading pass. A lens's pixels look up their
primitive in that pass, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from lucida.renderer.raster.programs import seeing, shading
from lucida.renderer.raster.sources import Constant, ShaderSource
from lucida.renderer.scene.flat import FlatScene

TABLE_SHIFT = 11  # WebGL 2 has textures of at least 2048 texels a side
HEADER = """#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;"""
_COMMENT = re.compile(r"[ \t]*//[^\n]*")
_BLANK = re.compile(r"\n\s*\n+")
_PULLED = (
    (
        "in vec3 vertex;\nin int object;",
        "uniform isampler2D faces;\nuniform sampler2D vertices;\nflat out int drawn;",
    ),
    (
        "void main() {",
        """void main() {
    drawn = gl_VertexID / 3;
    ivec4 face = texelFetch(faces, texel(drawn), 0);
    int object = face.w;
    vec3 vertex = texelFetch(vertices, texel(3 * face[gl_VertexID - 3 * drawn]), 0).xyz;""",
    ),
)
_NUMBERED = (
    ("gl_PrimitiveID", "drawn"),
    (
        "out int primitive;",
        "flat in int drawn;\nout int primitive;",
    ),
)
_SHOWN = (
    ("void main() {", "void shade(int primitive) {"),
    (
        "    int primitive = texelFetch(primitives, ivec2(gl_FragCoord.xy), 0).x;\n",
        "",
    ),
)
_SHOW = """
uniform float exposure;
void main() {
    if (HAS_LENS && !is_on_face(lens_position())) {
        discard;
    }
    ivec2 at = HAS_LENS ? looked_up(lens_position().xy) : ivec2(gl_FragCoord.xy);
    int primitive = texelFetch(primitives, at, 0).x;
    if (primitive < 0) {
        color = vec4(background, 1.0);
    } else {
        shade(primitive);
    }
    color = vec4(srgb_from_linear(clamp(exposure * color.rgb, 0.0, 1.0)), 1.0);
}
"""


def shaders(flat: FlatScene, has_lens: bool) -> dict[str, list[str]]:
    """Return [vertex, fragment] shaders by the name of their pass. has_lens: of a face."""
    seen, shaded = seeing(flat, has_lens), shading(flat, has_lens)
    lens: dict[str, Constant] = {"HAS_LENS": has_lens}
    screen = es_shader("screen.vert", {})
    return {
        "clear": [screen, es_shader("clear.frag", {})],
        "triangles": [
            es_shader("triangles.vert", seen, *_PULLED),
            es_shader("triangles.frag", seen, *_NUMBERED),
        ],
        "spheres": [es_shader("spheres.vert", lens), es_shader("spheres.frag", lens)],
        "shade": [screen, es_shader("shade.frag", shaded, *_SHOWN) + _display() + _SHOW],
    }


def es_shader(name: str, constants: Mapping[str, Constant], *changes: tuple[str, str]) -> str:
    """Return a shader of shaders/ in GLSL ES. changes: (old, new), each made once."""
    text = _body(ShaderSource(name, {**constants, "TABLE_SHIFT": TABLE_SHIFT}))
    for old, new in changes:
        assert text.count(old) == 1, f"{name}: {old}"
        text = text.replace(old, new)
    return HEADER + text


def _display() -> str:
    return _body(ShaderSource("chunks/color.glsl"))


def _body(source: ShaderSource) -> str:
    text = _COMMENT.sub("", source.text).replace("#version 330 core", "")
    return _BLANK.sub("\n", "\n" + text)
