"""Lines and filled shapes over an image of a scene, hidden where the scene is nearer.

Their geometry is projected: positions in pixels, with their depths. Lines are antialiased
rectangles on the screen, of any width, because OpenGL's own lines may be limited to one pixel.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from .programs import set_uniform
from .resources import Owner
from .sources import link

# Flags of segments and corners.
ON_PLANE = 1  # part of the image plane, which does not hide it
ROUND_START, ROUND_END = 2, 4  # end in a half disc instead of being cut off
DASHED = 8  # even where not hidden
BARE = 16  # without a casing

# start, end: pixels from the target's upper left corner, y down. depth: s at both ends: 1 / t in
# perspective and t in parallel projection, both affine on the screen. color: display values, with
# opacity. width: pixels. before: the length in pixels of the line before this segment, for dashes.
# hidden: a factor for the opacity where something is nearer. flags: see above. A segment of length
# 0 is a disc.
SEGMENT = np.dtype(
    [
        ("start", np.float32, 2),
        ("end", np.float32, 2),
        ("depth", np.float32, 2),
        ("color", np.float32, 4),
        ("width", np.float32),
        ("before", np.float32),
        ("hidden", np.float32),
        ("flags", np.float32),
    ]
)

# A corner of a triangle.
CORNER = np.dtype(
    [
        ("corner", np.float32, 2),
        ("depth", np.float32),
        ("color", np.float32, 4),
        ("hidden", np.float32),
        ("flags", np.float32),
    ]
)

# The display colour of lines' edges, dark in every theme, because the lines are pale and the scene
# is behind them.
CASING = (0.03, 0.035, 0.04, 0.6)
BLENDING = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)  # the usual one

# Shapes and lines that are drawn together, shapes first.
Layer = tuple[NDArray[Any], NDArray[Any]]  # dtypes CORNER and SEGMENT


class LineRenderer:
    """A renderer of layers into the bound framebuffer of a context, which must be current.

    The alpha channel is also blended; mask it to preserve it. set() sets the uniforms of
    chunks/outside.glsl for all of them.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = Owner()
        own = self._owner.own
        self._lines = own(link(context, "line.vert", "line.frag"))
        self._fills = own(link(context, "fill.vert", "fill.frag"))
        self._segments = _Stream(
            context, self._lines, SEGMENT, "2f4 2f4 2f4 4f4 4f4/i", _SEGMENT_NAMES
        )
        self._corners = _Stream(context, self._fills, CORNER, "2f4 1f4 4f4 2f4", _CORNER_NAMES)

    def set(self, uniforms: dict[str, Any]) -> None:
        """Set the uniforms that both programs share."""
        for name, value in uniforms.items():
            set_uniform(self._lines, name, value)
            set_uniform(self._fills, name, value)

    def draw(
        self,
        layers: Sequence[Layer],
        dash_px: float,
        casing_px: float,
    ) -> None:
        """Draw the layers, one over the other.

        Lines have a casing, an edge of another colour, which makes them visible on any background
        and shows which line is in front.
        """
        gl = self._gl
        gl.enable_only(moderngl.BLEND)
        gl.blend_func = BLENDING
        set_uniform(self._lines, "dash", dash_px)
        set_uniform(self._lines, "edge_color", CASING)
        for corners, segments in layers:
            if len(corners):
                self._corners.write(corners)
                self._corners.array.render(moderngl.TRIANGLES, vertices=len(corners))
            if not len(segments):
                continue
            self._segments.write(segments)
            is_bare = (segments["flags"].astype(int) & BARE).all()
            for edge in (0.0,) if is_bare or casing_px <= 0 else (casing_px, 0.0):
                set_uniform(self._lines, "edge", edge)
                self._segments.array.render(
                    moderngl.TRIANGLE_STRIP, vertices=4, instances=len(segments)
                )
        gl.enable_only(moderngl.NOTHING)

    def release(self) -> None:
        self._segments.release()
        self._corners.release()
        self._owner.release()


_SEGMENT_NAMES = ("start", "end", "depth", "color", "style")
_CORNER_NAMES = ("corner", "depth", "color", "style")


class _Stream:
    """A growing buffer, and the vertex array over it."""

    def __init__(
        self,
        context: moderngl.Context,
        program: moderngl.Program,
        dtype: np.dtype[Any],
        layout: str,
        names: tuple[str, ...],
    ) -> None:
        self._gl, self._program, self._dtype = context, program, dtype
        self._layout, self._names = layout, names
        self._reserve(64)

    def write(self, rows: NDArray[Any]) -> None:
        data = np.ascontiguousarray(rows, self._dtype)
        if data.nbytes > self._buffer.size:
            self.release()
            self._reserve(2 * len(data))
        self._buffer.orphan()
        self._buffer.write(data)

    def _reserve(self, rows: int) -> None:
        self._buffer = self._gl.buffer(reserve=rows * self._dtype.itemsize, dynamic=True)
        content = [(self._buffer, self._layout, *self._names)]
        self.array = self._gl.vertex_array(self._program, content)

    def release(self) -> None:
        self.array.release()
        self._buffer.release()
