"""The outside view's picture: a scene, another camera's picture placed in it, and lines.

Everything is drawn into 8-bit targets of one size.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.memo import Memo

from .cloud import PREMULTIPLIED, CloudPicture
from .display import exposure_factor
from .lines import BLENDING, Layer, LineRenderer
from .resources import Owner
from .screen_pass import SizedTarget, cover, new_array, plain_state, set_uniforms
from .targets import Textures

Size = tuple[int, int]
FAR_PX = 1e6  # outside every image
BACK_LIGHT = 0.55  # brightness of a picture seen from behind
CLOUD_HIDDEN = 0.25  # brightness of a cloud where something is nearer
TAPS = {False: 4, True: 1}  # by whether it moves: points of the placed picture a side of a pixel
_THINNEST = 1e-7  # a plane closer to edge-on does not show its picture


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


def plane_on_screen(
    camera: Camera, size: Size, corners: NDArray[np.float64], eye: NDArray[np.float64]
) -> Plane | None:
    """Return the plane with three corners (3, 3) of a picture: upper left, upper right, lower left.

    Returns None if it is seen edge-on. eye: a point on the side from which the picture is not
    mirrored.
    """
    first, across, down = corners[0], corners[1] - corners[0], corners[2] - corners[0]
    matrix = camera.image_from_world(size)
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
    screen: moderngl.VertexArray,
    framebuffer: moderngl.Framebuffer,
    linear: moderngl.Texture,
    number: Hashable,
    exposure_ev: float,
) -> None:
    """Draw linear light with the display transform. number: a key of the texture's content."""
    framebuffer.use()
    linear.use(0)
    size = framebuffer.size
    cover(screen, linear_color=0, exposure=exposure_factor(exposure_ev), target_size=size)


class ShownScene(NamedTuple):
    """A picture of the scene, and how to display it.

    mean: its colour with smooth edges, from gather(). number: a value that differs whenever the
    picture differs; None if unknown.
    """

    textures: Textures
    mean: moderngl.Texture | None = None
    exposure_ev: float = 0.0
    number: Hashable = None


class PlacedPicture(NamedTuple):
    """A picture of display values to place on a plane in the scene.

    moves: it may have jagged edges, to be drawn faster.
    """

    plane: Plane
    picture: moderngl.Texture
    opacity: float = 1.0
    moves: bool = False


class Overlay:
    """A renderer of outside views in a context, which must be current. Raises LucidaError."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._owner = own = Owner()
        self._place = {
            moves: new_array(own, context, "plane.vert", "plane.frag", {"TAPS": taps})
            for moves, taps in TAPS.items()
        }
        self._lay_cloud = new_array(own, context, "screen.vert", "cloud.frag")
        self._show = new_array(own, context, "screen.vert", "scene.frag")
        self._gather = new_array(own, context, "screen.vert", "gather.frag")
        self._shown = Memo(_show_scene)
        self._lines = own.own(LineRenderer(context))
        self._mean = own.own(SizedTarget(context, dtype="float16"))
        self._targets = {name: own.own(SizedTarget(context)) for name in ("scene", "shown")}

    def gather(self, scene: Textures, first: bool, weight: float) -> moderngl.Texture:
        """Add a picture of the scene, multiplied by `weight`, to the sum since the last call with
        `first`.

        The mean of pictures with subpixel shifts has smooth edges. Returns the texture of the sum,
        in linear light, which each call overwrites.
        """
        gl = self._gl
        texture, framebuffer = self._mean.of_size(scene.color.size)
        try:
            with plain_state(gl):
                gl.enable_only(moderngl.NOTHING if first else moderngl.BLEND)
                gl.blend_func = moderngl.ONE, moderngl.ONE
                framebuffer.use()
                scene.color.use(0)
                cover(self._gather, linear_color=0, weight=weight)
        finally:
            gl.blend_func = BLENDING
        return texture

    def draw(
        self,
        scene: ShownScene,
        camera: Camera,
        size: Size,
        layers: Sequence[Layer],
        unit_px: float = 1.0,
        placed: PlacedPicture | None = None,
        cloud: CloudPicture | None = None,
    ) -> moderngl.Texture:
        """Draw the view. Return an 8-bit picture of `size`, which the next call overwrites.

        scene: drawn by `camera`, at `size` or smaller. unit_px: the unit of dashes and edges.
        cloud: of this size, by the same camera; it is drawn below the layers.
        """
        gl = self._gl
        drawn, framebuffer = self._targets["shown"].of_size(size)
        shared: dict[str, Any] = {
            "surface": 1,
            "perspective": float(not camera.is_parallel),
            "half_size": (size[0] / 2, size[1] / 2),
            "has_plane": placed is not None,
        }
        if placed is not None:
            plane = placed.plane
            # OpenGL's matrices are column-major, so transpose NumPy's.
            shared["plane_from_screen"] = tuple(plane.from_screen.T.ravel().tolist())
            shared["plane_box"] = plane.box
            shared["plane_depth"] = tuple(plane.depth.tolist())
        with plain_state(gl, 5):
            shown = self._scene_shown(scene, size)
            gl.copy_framebuffer(framebuffer, shown)
            try:
                framebuffer.color_mask = True, True, True, False  # the target stays opaque
                framebuffer.use()  # applies the mask
                scene.textures.surface.use(1)
                gl.enable_only(moderngl.BLEND)
                if placed is not None:
                    placed.picture.use(2)
                    light = 1.0 if placed.plane.is_front else BACK_LIGHT
                    values = {"opacity": placed.opacity, "picture_light": light}
                    place = self._place[placed.moves]
                    set_uniforms(place.program, **shared, picture=2, **values)
                    gl.blend_func = BLENDING
                    place.render(moderngl.TRIANGLE_STRIP, vertices=4)
                if cloud is not None:
                    cloud.color.use(3)
                    cloud.depth.use(4)
                    gl.blend_func = PREMULTIPLIED
                    depth = {"cloud_depth": 4, "s_of_depth": cloud.s_of_depth}
                    cover(self._lay_cloud, **shared, cloud=3, **depth, hidden=CLOUD_HIDDEN)
                self._lines.set(shared)
                self._lines.draw(layers, 7.0 * unit_px, 1.25 * unit_px)
            finally:
                framebuffer.color_mask = True, True, True, True
        return drawn

    def _scene_shown(self, scene: ShownScene, size: Size) -> moderngl.Framebuffer:
        """Return the scene after the display transform, recomputed only if necessary."""
        _, framebuffer = self._targets["scene"].of_size(size)
        if scene.number is None:
            self._shown.forget()
        linear = scene.mean or scene.textures.color
        self._shown(self._show, framebuffer, linear, scene.number, scene.exposure_ev)
        return framebuffer

    def release(self) -> None:
        self._owner.release()
