"""The outside view's picture: a scene, another camera's picture placed in it, and lines.

Everything is drawn into 8-bit targets of one size.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.memo import Memo
from renderer.raster.cloud import PREMULTIPLIED, CloudPicture
from renderer.raster.lines import BLENDING, Layer, LineRenderer
from renderer.raster.programs import set_uniform
from renderer.raster.resources import Owner, check, new_surface, new_texture
from renderer.raster.sources import link
from renderer.raster.targets import Textures

Size = tuple[int, int]
Rgba = tuple[float, float, float, float]
FAR_PX = 1e6  # outside every image
BACK_LIGHT = 0.55  # brightness of a picture seen from behind
CLOUD_HIDDEN = 0.25  # brightness of a cloud where something is nearer
_THINNEST = 1e-7  # an image plane that is closer to edge-on does not show its picture


@dataclass(frozen=True)
class Plane:
    """An image plane on the screen.

    from_screen: (3, 3), from (x, y, 1), in pixels from the image's centre, x right, y down, to
    (X q, Y q, q). X and Y run from 0 to 1 rightwards and downwards over the picture.
    depth: (3,), s as a linear function of (x, y, 1).
    is_front: seen from the side of its eye.
    box: (left, top, right, bottom) around the picture, from the image's centre.
    """

    from_screen: NDArray[np.float64]
    depth: NDArray[np.float64]
    is_front: bool
    box: tuple[float, float, float, float]


def screen_from_world(camera: Camera, size: Size) -> NDArray[np.float64]:
    """Return the matrix (3, 4) from a world point (x, y, z, 1) to x and y, in pixels from the
    image's centre, x right, y down, and t. In perspective, x and y are multiplied by t.
    """
    left, right, bottom, top = camera.viewport
    rows = camera.camera_from_world[:3].copy()
    t = -rows[2] if camera.is_parallel else -rows[2] / camera.distance
    unit = np.array([0.0, 0.0, 0.0, 1.0]) if camera.is_parallel else t
    x = (rows[0] - (left + right) / 2 * unit) * (size[0] / (right - left))
    y = (rows[1] - (bottom + top) / 2 * unit) * (size[1] / (top - bottom))
    return np.stack([x, -y, t])


def plane_on_screen(
    camera: Camera, size: Size, corners: NDArray[np.float64], eye: NDArray[np.float64]
) -> Plane | None:
    """Return the plane with three corners (3, 3) of a picture: upper left, upper right, lower left.

    Returns None if it is seen edge-on. eye: a point on the side from which the picture is not
    mirrored.
    """
    first, across, down = corners[0], corners[1] - corners[0], corners[2] - corners[0]
    matrix = screen_from_world(camera, size)
    of_plane = np.column_stack([matrix[:, :3] @ across, matrix[:, :3] @ down, matrix @ [*first, 1]])
    t_row = of_plane[2].copy()
    if camera.is_parallel:
        of_plane[2] = 0, 0, 1
    lengths = np.linalg.norm(of_plane, axis=0)
    if not np.isfinite(of_plane).all() or not (lengths > 0).all():
        return None
    if abs(np.linalg.det(of_plane / lengths)) < _THINNEST:
        return None
    from_screen = np.linalg.inv(of_plane)
    if not np.isfinite(from_screen).all():
        return None
    depth = t_row @ from_screen if camera.is_parallel else from_screen[2].copy()
    normal = np.cross(across, down)
    toward = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye) - first
    is_front = bool((normal @ toward) * (normal @ (np.asarray(eye) - first)) >= 0)
    if not camera.is_parallel:  # a common factor cancels; this keeps floats in range
        from_screen = from_screen / np.abs(from_screen).max()
    spots = np.array([of_plane @ corner for corner in ((0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1))])
    box = (-FAR_PX, -FAR_PX, FAR_PX, FAR_PX)
    if (spots[:, 2] > 0).all():
        places = spots[:, :2] / spots[:, 2:]
        low, high = np.clip((places.min(axis=0), places.max(axis=0)), -FAR_PX, FAR_PX)
        box = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
    return Plane(from_screen, depth, is_front, box)


def _show_scene(
    program: moderngl.Program,
    screen: moderngl.VertexArray,
    framebuffer: moderngl.Framebuffer,
    linear: moderngl.Texture,
    number: Hashable,
    exposure_ev: float,
    rows: int,
) -> None:
    """Draw linear light with the display transform. number: a key of the texture's content."""
    framebuffer.use()
    linear.use(0)
    set_uniform(program, "linear_color", 0)
    set_uniform(program, "window_depth", 0.5)
    set_uniform(program, "rows", rows)
    set_uniform(program, "exposure", 2.0 ** min(max(exposure_ev, -100.0), 100.0))
    screen.render(moderngl.TRIANGLES, vertices=3)


class Overlay:
    """Draws outside views in a context, which must be current. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = Owner()
        self._enlarging = self._owner.own(link(context, "picture.vert", "picture.frag"))
        self._enlarge = self._owner.own(context.vertex_array(self._enlarging, []))
        self._placing = self._owner.own(link(context, "plane.vert", "plane.frag"))
        self._place = self._owner.own(context.vertex_array(self._placing, []))
        self._clouding = self._owner.own(link(context, "screen.vert", "cloud.frag"))
        self._lay_cloud = self._owner.own(context.vertex_array(self._clouding, []))
        self._showing = self._owner.own(link(context, "screen.vert", "scene.frag"))
        self._show = self._owner.own(context.vertex_array(self._showing, []))
        self._shown = Memo(_show_scene)
        self._gathering = self._owner.own(link(context, "screen.vert", "gather.frag"))
        self._gather = self._owner.own(context.vertex_array(self._gathering, []))
        self._lines = self._owner.own(LineRenderer(context))
        # By name, and True if for a window's framebuffer. _last: the target of the last draw().
        self._targets: dict[tuple[str, bool], tuple[moderngl.Texture, moderngl.Framebuffer]] = {}
        self._last = ("shown", False)

    @property
    def target(self) -> moderngl.Framebuffer:
        """The framebuffer of the last draw(), to copy from."""
        return self._targets[self._last][1]

    def gather(self, scene: Textures, first: bool, weight: float) -> moderngl.Texture:
        """Add a picture of the scene, multiplied by `weight`, to the sum since the last call with
        `first`.

        The mean of pictures with subpixel shifts has smooth edges. Returns the texture of the sum,
        in linear light, which each call overwrites.
        """
        gl = self._gl
        texture, framebuffer = self._of_size(("mean", False), scene.color.size, "float16")
        before = gl.detect_framebuffer()
        try:
            gl.enable_only(moderngl.NOTHING if first else moderngl.BLEND)
            gl.blend_func = moderngl.ONE, moderngl.ONE
            gl.wireframe = False
            gl.clear_samplers(0, 1)
            framebuffer.use()
            scene.color.use(0)
            set_uniform(self._gathering, "linear_color", 0)
            set_uniform(self._gathering, "window_depth", 0.5)
            set_uniform(self._gathering, "weight", weight)
            self._gather.render(moderngl.TRIANGLES, vertices=3)
        finally:
            gl.blend_func = BLENDING
            gl.enable_only(moderngl.NOTHING)
            before.use()
        return texture

    def t_at(self, scene: Textures, part: tuple[float, float]) -> float:
        """Return the ray parameter of the scene at a point of its picture, relative to its width
        and height; infinity if nothing is hit. Waits for the GPU.
        """
        surface = scene.surface
        place = [
            min(max(int(where * side), 0), side - 1)
            for where, side in zip(part, surface.size, strict=True)
        ]
        before = self._gl.detect_framebuffer()
        framebuffer = self._gl.framebuffer([surface])
        try:
            pixel = framebuffer.read((*place, 1, 1), components=4, dtype="f4")
        finally:
            framebuffer.release()
            before.use()
        return float(np.frombuffer(pixel, np.float32)[3])

    def draw(
        self,
        scene: Textures,
        camera: Camera,
        size: Size,
        layers: Sequence[Layer],
        plane: Plane | None = None,
        picture: moderngl.Texture | None = None,
        exposure_ev: float = 0.0,
        opacity: float = 1.0,
        unit_px: float = 1.0,
        mean: moderngl.Texture | None = None,
        casing: Rgba = (0.03, 0.035, 0.04, 0.6),
        number: Hashable = None,
        upside_down: bool = False,
        cloud: CloudPicture | None = None,
    ) -> moderngl.Texture:
        """Return the view as an 8-bit texture of `size`, which the next call overwrites.

        scene: drawn by `camera`, at `size` or coarser. mean: the scene's colour with smooth edges,
        from gather(). plane, picture: the picture to place in the scene, as display values. A plane
        without a picture hides nothing. unit_px: the unit of dashes and edges. casing: the colour
        of the lines' edges. number: a value that differs whenever the scene's picture differs; None
        if unknown. upside_down: row 0 is the bottom row, as in a window's framebuffer; the target
        is then a new_surface(). cloud: of this size, by the same camera; below the layers.
        """
        gl = self._gl
        self._last = "shown", upside_down
        texture, framebuffer = self._of_size(self._last, size, "uint8")
        before = gl.detect_framebuffer()
        coarse = scene.surface.size
        shared: dict[str, Any] = {
            "surface": 1,
            "upward": -1.0 if upside_down else 1.0,
            "texels": (coarse[0] / size[0], coarse[1] / size[1]),
            "perspective": float(not camera.is_parallel),
            "half_size": (size[0] / 2, size[1] / 2),
            "has_plane": plane is not None and picture is not None,
        }
        if plane is not None:
            # OpenGL's matrices are column-major: NumPy's transposed.
            shared["plane_from_screen"] = tuple(plane.from_screen.T.ravel().tolist())
            shared["plane_box"] = plane.box
            shared["plane_depth"] = tuple(plane.depth.tolist())
        try:
            gl.enable_only(moderngl.NOTHING)
            gl.wireframe = False
            gl.clear_samplers(0, 5)
            shown = self._scene_shown(mean or scene.color, exposure_ev, number, upside_down)
            self._cover(shown, framebuffer)
            framebuffer.color_mask = True, True, True, False  # the target stays opaque
            framebuffer.use()  # applies the mask
            scene.surface.use(1)
            if plane is not None and picture is not None:
                picture.use(2)
                light = 1.0 if plane.is_front else BACK_LIGHT
                extra = {"picture": 2, "opacity": opacity, "picture_light": light}
                for name, value in (shared | extra).items():
                    set_uniform(self._placing, name, value)
                gl.enable_only(moderngl.BLEND)
                gl.blend_func = BLENDING
                self._place.render(moderngl.TRIANGLE_STRIP, vertices=4)
            if cloud is not None:
                self._lay(cloud, shared)
            self._lines.set(shared)
            self._lines.draw(layers, 7.0 * unit_px, 1.25 * unit_px, casing)
        finally:
            framebuffer.color_mask = True, True, True, True
            gl.enable_only(moderngl.NOTHING)
            before.use()
        return texture

    def _lay(self, cloud: CloudPicture, shared: dict[str, Any]) -> None:
        """Draw a cloud's picture over the target."""
        cloud.color.use(3)
        cloud.depth.use(4)
        own = {"cloud": 3, "cloud_depth": 4, "s_of_depth": cloud.s_of_depth}
        for name, value in (shared | own | {"hidden": CLOUD_HIDDEN, "window_depth": 0.5}).items():
            set_uniform(self._clouding, name, value)
        self._gl.enable_only(moderngl.BLEND)
        self._gl.blend_func = PREMULTIPLIED
        self._lay_cloud.render(moderngl.TRIANGLES, vertices=3)

    def _cover(
        self,
        shown: tuple[moderngl.Texture, moderngl.Framebuffer],
        target: moderngl.Framebuffer,
    ) -> None:
        """Fill the target with a picture, and bind it. If the sizes match, copy: on a CPU, a copy
        is many times cheaper than a shader.
        """
        target.use()
        picture, source = shown
        if picture.size == target.size:
            self._gl.copy_framebuffer(target, source)
            target.use()
            return
        picture.use(0)
        picture.filter = moderngl.LINEAR, moderngl.LINEAR
        set_uniform(self._enlarging, "picture", 0)
        self._enlarge.render(moderngl.TRIANGLES, vertices=6)

    def _scene_shown(
        self, linear: moderngl.Texture, exposure_ev: float, number: Hashable, upside_down: bool
    ) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        """Return the scene after the display transform, recomputed only if necessary."""
        texture, framebuffer = self._of_size(("scene", upside_down), linear.size, "uint8")
        if number is None:
            self._shown.forget()
        rows = linear.height if upside_down else 0
        self._shown(self._showing, self._show, framebuffer, linear, number, exposure_ev, rows)
        return texture, framebuffer

    def release(self) -> None:
        for key in list(self._targets):
            self._drop(key)
        self._owner.release()

    def _of_size(
        self, key: tuple[str, bool], size: Size, dtype: str
    ) -> tuple[moderngl.Texture, moderngl.Framebuffer]:
        if key not in self._targets or self._targets[key][0].size != size:
            self._drop(key)
            surface = key[1]
            texture = (
                new_surface(self._gl, size) if surface else new_texture(self._gl, size, 4, dtype)
            )
            self._targets[key] = texture, self._gl.framebuffer([texture])
            check(self._gl, "the outside view")
        return self._targets[key]

    def _drop(self, key: tuple[str, bool]) -> None:
        if key in self._targets:
            texture, framebuffer = self._targets.pop(key)
            framebuffer.release()
            texture.release()
