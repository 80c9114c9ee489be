"""Thousands of points and lines, drawn at their places into a picture of their own.

Their buffers are written only once. The picture, with its depths, is drawn part by part, so that a
slow device does not delay a frame. Hidden parts are determined when the picture is composited over
another one (overlay.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from renderer.raster.programs import set_uniform
from renderer.raster.resources import Owner, check, new_texture
from renderer.raster.sources import link

Size = tuple[int, int]
Rgba = tuple[float, float, float, float]

PREMULTIPLIED = (moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA)
LINES = 1 << 14  # per buffer, each drawn in one call
# place: in world units, from the cloud's origin. color: sRGB.
POINT = np.dtype([("place", np.float32, 3), ("color", np.uint8, 3), ("unused", np.uint8)])


@dataclass(frozen=True)
class CloudLook:
    """The camera and the style of a cloud. Widths are in pixels.

    screen_from_cloud: (3, 4), as screen_from_world() in overlay.py, from the cloud's origin. near:
    the least t that is drawn. far: the end of the depth range in parallel projection. ink: the
    lines' colour. casing: the colour of their edges. Both colours are display values.
    """

    screen_from_cloud: NDArray[np.float64]
    is_parallel: bool
    near: float
    far: float
    ink: Rgba
    casing: Rgba
    line_px: float
    casing_px: float
    point_px: float


@dataclass(frozen=True)
class CloudPicture:
    """A cloud's picture.

    color: premultiplied by opacity; row 0 is the top row. s_of_depth: (a, b) with s = a + b * depth
    (chunks/outside.glsl).
    """

    color: moderngl.Texture
    depth: moderngl.Texture
    s_of_depth: tuple[float, float]


class CloudRenderer:
    """Draws one cloud in a context, which must be current. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._programs = Owner()
        self._dots = self._programs.own(link(context, "cloud_dot.vert", "cloud_dot.frag"))
        self._wide = self._programs.own(link(context, "cloud_line.vert", "cloud_line.frag"))
        self._point_buffers, self._line_buffers = Owner(), Owner()
        self._points: moderngl.VertexArray | None = None
        self._lines: list[tuple[int, moderngl.VertexArray, moderngl.VertexArray]] = []
        self._targets = Owner()
        self._target: moderngl.Framebuffer | None = None
        self._picture: CloudPicture | None = None

    def take_points(self, points: NDArray[Any]) -> None:
        """Replace the points by others, of dtype POINT; an empty array frees their memory."""
        self._point_buffers.release()
        self._points = None
        own, gl = self._point_buffers.own, self._gl
        _ = gl.error  # clear errors left by other code
        if len(points):
            buffer = own(gl.buffer(np.ascontiguousarray(points, POINT)))
            content = [(buffer, "3f4 3f1 x1", "place", "color")]
            self._points = own(gl.vertex_array(self._dots, content))
        check(gl, f"{len(points)} points")

    def take_lines(self, ends: NDArray[np.float32]) -> None:
        """Replace the lines by others, (n, 2, 3), relative to the cloud's origin."""
        self._line_buffers.release()
        self._lines = []
        own, gl = self._line_buffers.own, self._gl
        _ = gl.error
        for first in range(0, len(ends), LINES):
            part = np.ascontiguousarray(ends[first : first + LINES], np.float32)
            buffer = own(gl.buffer(part))
            wide = own(gl.vertex_array(self._wide, [(buffer, "3f4 3f4/i", "start", "end")]))
            thin = own(gl.vertex_array(self._dots, [(buffer, "3f4", "place")]))
            self._lines.append((len(part), wide, thin))
        check(gl, f"{len(ends)} lines")

    def begin(self, size: Size, look: CloudLook) -> CloudPicture:
        """Return an empty picture, into which the following add_*() calls draw."""
        gl = self._gl
        if self._target is None or self._target.size != size:
            self._targets.release()
            own = self._targets.own
            color = own(new_texture(gl, size, 4, np.uint8))
            depth = own(gl.depth_texture(size))
            depth.compare_func, depth.filter = "", (moderngl.NEAREST, moderngl.NEAREST)
            self._target = own(gl.framebuffer([color], depth))
            check(gl, f"a picture of {size[0]}x{size[1]}")
            self._picture = CloudPicture(color, depth, (0.0, 0.0))
        assert self._picture is not None
        before = gl.detect_framebuffer()
        self._target.use()
        self._target.clear(depth=1.0)
        before.use()
        scale = (look.near, look.far - look.near) if look.is_parallel else (1 / look.near,) * 2
        s_of_depth = scale if look.is_parallel else (scale[0], -scale[1])
        self._picture = CloudPicture(self._picture.color, self._picture.depth, s_of_depth)
        shared: dict[str, Any] = {
            # OpenGL's matrices are column-major: NumPy's transposed.
            "screen_from_cloud": tuple(look.screen_from_cloud.T.ravel().tolist()),
            "perspective": float(not look.is_parallel),
            "near": look.near,
            "far": look.far,
            "half_size": (size[0] / 2, size[1] / 2),
            "dot_px": look.point_px,
            "width": look.line_px,
            "edge": look.casing_px,
            "edge_color": look.casing,
        }
        for name, value in shared.items():
            set_uniform(self._dots, name, value)
            set_uniform(self._wide, name, value)
        set_uniform(self._wide, "ink", look.ink)
        self._ink = look.ink
        return self._picture

    @property
    def parts(self) -> int:
        """The number of parts in which the lines are drawn."""
        return len(self._lines)

    def add_points(self, first: int, count: int) -> None:
        if self._points is not None and count > 0:
            set_uniform(self._dots, "ink", (0.0, 0.0, 0.0, 0.0))
            self._add(self._points, moderngl.POINTS, vertices=count, first=first)

    def add_thin_lines(self, most: int) -> None:
        """Draw the first `most` lines, one pixel wide and aliased: a fraction of the work."""
        set_uniform(self._dots, "ink", self._ink)
        for count, _, thin in self._lines:
            self._add(thin, moderngl.LINES, vertices=2 * min(count, most))
            most -= min(count, most)
            if most <= 0:
                break

    def add_lines(self, part: int) -> None:
        """Draw one of the parts in full width, over its thin lines if there are any."""
        count, wide, _ = self._lines[part]
        self._add(wide, moderngl.TRIANGLE_STRIP, vertices=4, instances=count)

    def _add(self, array: moderngl.VertexArray, mode: int, **counts: int) -> None:
        gl = self._gl
        before = gl.detect_framebuffer()
        assert self._target is not None
        try:
            gl.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND | moderngl.PROGRAM_POINT_SIZE)
            gl.blend_func, gl.depth_func, gl.wireframe = PREMULTIPLIED, "<=", False
            self._target.use()
            array.render(mode, **counts)
        finally:
            gl.enable_only(moderngl.NOTHING)
            before.use()

    def release(self) -> None:
        self._point_buffers.release()
        self._line_buffers.release()
        self._targets.release()
        self._programs.release()
