"""The two images as textures that ImGui can show.

Owns the rasterizer and the display transform in the window's context, and redraws only what has
changed. Knows nothing of widgets and of how the ray image was made.
"""

from __future__ import annotations

import contextlib
import time
from dataclasses import dataclass

import moderngl

from app.live import RayImage, reduced
from app.shown import ShownImage
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import CHANNELS, Frame
from renderer.raster import Rasterizer
from renderer.raster.targets import Textures
from renderer.scene.model import Scene

MOVING_S = 0.1  # after a change; a raster image that is too slow for the display is coarse then
FRAME_S = 0.008  # what a raster image may take of a frame while the camera moves
COARSEST = 4


@dataclass(frozen=True)
class Wanted:
    """What a raster image depends on, but for the exposure. size: (width, height)."""

    scene: Scene
    camera: Camera
    size: tuple[int, int]


class Pictures:
    """Both images, in the window's context, which must be current in every call."""

    def __init__(self, context: moderngl.Context, scene: Scene) -> None:
        self._raster, self._ray = ShownImage(context), ShownImage(context)
        self._rasterizer = Rasterizer(scene, context=context)
        self._scene = scene
        self._timer = context.query(time=True)
        self._timed_pixels = 0  # of the image whose time is still to be read
        self._pixel_s = 0.0
        self._wanted: Wanted | None = None
        self._linear: moderngl.Texture | None = None
        self._drawn = 0
        self._changed_s = 0.0
        self.raster_factor = 1
        self.raster_s = 0.0
        self.raster_error: Exception | None = None
        self.ray_error: Exception | None = None

    def raster(
        self, wanted: Wanted, exposure_ev: float, size_px: tuple[int, int]
    ) -> moderngl.Texture | None:
        """The raster image to show at size_px framebuffer pixels, drawn anew if it must be.

        None where that failed, see raster_error. Where OpenGL runs on the CPU, the image is coarse
        while things move, and full soon after.
        """
        try:
            self._follow(wanted)
            texture = self._raster.texture(exposure_ev, size_px)
            self.raster_error = None
        except (LucidaError, moderngl.Error) as error:  # shown in the window, which goes on
            self._raster.set_linear(None)
            self._wanted, self.raster_error, self.raster_factor = None, error, 1
            return None
        return texture

    def linear(self, wanted: Wanted) -> tuple[moderngl.Texture, int]:
        """The raster image in linear light, drawn anew if it must be, and how many have been drawn:
        the number changes with the image. Raises LucidaError."""
        self._follow(wanted)
        assert self._linear is not None
        return self._linear, self._drawn

    def beside(self, wanted: Wanted, place: str) -> Textures:
        """Another camera's image of the scene, kept beside the raster image, which stays. Drawn
        by each call; place: see Rasterizer.draw. Raises LucidaError."""
        self._show(wanted.scene)
        return self._rasterizer.draw(wanted.camera, wanted.size, place)

    def take_ray(self, image: RayImage) -> None:
        """Puts a traced image on the GPU; where that fails, see ray_error."""
        try:
            self._ray.upload(image.frame.channel("color"))
            self.ray_error = None
        except (LucidaError, moderngl.Error) as error:
            self.ray_error = error

    def ray(self, exposure_ev: float, size_px: tuple[int, int]) -> moderngl.Texture | None:
        """The last traced image to show at size_px framebuffer pixels; None before the first."""
        try:
            return self._ray.texture(exposure_ev, size_px)
        except (LucidaError, moderngl.Error) as error:
            self._ray.set_linear(None)
            self.ray_error = error
            return None

    @property
    def unfinished(self) -> bool:
        """Whether the next frames have something to do: refine, or read the last image's time."""
        return self.raster_factor > 1 or self._timed_pixels > 0

    def read_back(self, wanted: Wanted) -> Frame:
        """All channels of a raster image as arrays. Raises LucidaError."""
        self._show(wanted.scene)
        self._wanted = None  # the textures are drawn over
        self._raster.set_linear(None)
        return self._rasterizer.render(wanted.camera, wanted.size, CHANNELS)

    @property
    def platform(self) -> str:
        """The GL renderer and its version."""
        return self._rasterizer.platform

    def release(self) -> None:
        with contextlib.suppress(moderngl.Error):
            self._rasterizer.release()
            self._raster.release()
            self._ray.release()

    def _follow(self, wanted: Wanted) -> None:
        self._read_time()
        if wanted != self._wanted:
            self._changed_s = time.monotonic()
            self._draw(wanted, self._moving_factor(wanted.size))
        elif self.raster_factor > 1 and time.monotonic() - self._changed_s > MOVING_S:
            self._draw(wanted, 1)

    def _draw(self, wanted: Wanted, factor: int) -> None:
        self._show(wanted.scene)
        size = reduced(wanted.size, factor)
        with self._timer:
            self._linear = self._rasterizer.draw(wanted.camera, size).color
            self._raster.set_linear(self._linear)
        self._drawn += 1
        self._wanted = wanted
        self._timed_pixels, self.raster_factor = size[0] * size[1], factor

    def _read_time(self) -> None:
        """A frame later: at once, it would wait for the GPU."""
        if self._timed_pixels:
            self.raster_s = self._timer.elapsed * 1e-9
            self._pixel_s = self.raster_s / self._timed_pixels
            self._timed_pixels = 0

    def _moving_factor(self, size: tuple[int, int]) -> int:
        factor = 1
        while factor < COARSEST and self._pixel_s * size[0] * size[1] / factor**2 > FRAME_S:
            factor *= 2
        return factor

    def _show(self, scene: Scene) -> None:
        if scene is not self._scene:
            self._rasterizer.set_scene(scene)
            self._scene = scene
