"""Thousands of points and lines, drawn at their places into a separate picture.

Their buffers are written only once. Hidden parts are determined when the picture, which has depths,
is composited over another one (overlay.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from .lines import CASING
from .programs import set_uniform
from .resources import Owner, check, new_texture
from .sources import link

Size = tuple[int, int]
Rgba = tuple[float, float, float, float]

PREMULTIPLIED = (moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA)
# place: in world units, from the cloud's origin. color: sRGB.
POINT = np.dtype([("place", np.float32, 3), ("color", np.uint8, 3), ("unused", np.uint8)])


@dataclass(frozen=True)
class CloudLook:
    """The camera and the style of a cloud. Widths are in pixels.

    screen_from_cloud: (3, 4), as Camera.image_from_world(), from the cloud's origin. near:
    the least t that is drawn. far: the end of the depth range in parallel projection. ink: the
    lines' colour, a display value.
    """

    screen_from_cloud: NDArray[np.float64]
    is_parallel: bool
    near: float
    far: float
    ink: Rgba
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
    """A renderer of one cloud in a context that must be current. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._programs = Owner()
        self._dots = self._programs.own(link(context, "cloud_dot.vert", "cloud_dot.frag"))
        self._wide = self._programs.own(link(context, "cloud_line.vert", "cloud_line.frag"))
        self._point_buffers, self._line_buffers = Owner(), Owner()
        self._points: moderngl.VertexArray | None = None
        self._lines: moderngl.VertexArray | None = None
        self._targets = Owner()
        self._target: moderngl.Framebuffer | None = None
        self._textures: tuple[moderngl.Texture, moderngl.Texture] | None = None

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
        self._lines = None
        own, gl = self._line_buffers.own, self._gl
        _ = gl.error
        if len(ends):
            buffer = own(gl.buffer(np.ascontiguousarray(ends, np.float32)))
            content = [(buffer, "3f4 3f4/i", "start", "end")]
            self._lines = own(gl.vertex_array(self._wide, content))
            self._lines.instances = len(ends)
        check(gl, f"{len(ends)} lines")

    def draw(self, size: Size, look: CloudLook) -> CloudPicture:
        """Draw all points and lines. Return the picture, which the next call overwrites."""
        gl = self._gl
        if self._target is None or self._target.size != size:
            self._targets.release()
            own = self._targets.own
            color = own(new_texture(gl, size, 4, np.uint8))
            depth = own(gl.depth_texture(size))
            depth.compare_func, depth.filter = "", (moderngl.NEAREST, moderngl.NEAREST)
            self._target = own(gl.framebuffer([color], depth))
            check(gl, f"a picture of {size[0]}x{size[1]}")
            self._textures = color, depth
        scale = (look.near, look.far - look.near) if look.is_parallel else (1 / look.near,) * 2
        s_of_depth = scale if look.is_parallel else (scale[0], -scale[1])
        shared: dict[str, Any] = {
            # OpenGL's matrices are column-major, so transpose NumPy's.
            "screen_from_cloud": tuple(look.screen_from_cloud.T.ravel().tolist()),
            "perspective": float(not look.is_parallel),
            "near": look.near,
            "far": look.far,
            "half_size": (size[0] / 2, size[1] / 2),
            "dot_px": look.point_px,
            "width": look.line_px,
            "edge": look.casing_px,
            "edge_color": CASING,
        }
        for name, value in shared.items():
            set_uniform(self._dots, name, value)
            set_uniform(self._wide, name, value)
        set_uniform(self._wide, "ink", look.ink)
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND | moderngl.PROGRAM_POINT_SIZE)
            gl.blend_func, gl.depth_func, gl.wireframe = PREMULTIPLIED, "<=", False
            self._target.use()
            self._target.clear(depth=1.0)
            if self._points is not None:  # before lines, whose edges are transparent
                self._points.render(moderngl.POINTS)
            if self._lines is not None:
                self._lines.render(moderngl.TRIANGLE_STRIP, vertices=4)
        finally:
            gl.enable_only(moderngl.NOTHING)
            before.use()
        assert self._textures is not None
        return CloudPicture(*self._textures, s_of_depth)

    def release(self) -> None:
        self._point_buffers.release()
        self._line_buffers.release()
        self._targets.release()
        self._programs.release()
