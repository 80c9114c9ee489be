"""The two images as textures that ImGui can show.

Owns the rasterizer and the display transform in the window's context, and redraws only what has
changed. Knows nothing of widgets and of how the ray image was made.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass

import moderngl

from app.live import RayImage
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import CHANNELS, Frame
from renderer.raster import Display, Rasterizer
from renderer.scene.model import Scene


@dataclass(frozen=True)
class Wanted:
    """What a raster image depends on, but for the exposure. size: (width, height)."""

    scene: Scene
    camera: Camera
    size: tuple[int, int]


class Pictures:
    """Both images, in the window's context, which must be current in every call."""

    def __init__(self, context: moderngl.Context, scene: Scene) -> None:
        self._context = context
        self._display = Display(context)
        self._rasterizer = Rasterizer(scene, context=context)
        self._scene = scene
        self._timer = context.query(time=True)
        self._timing = False
        self._linear: moderngl.Texture | None = None
        self._wanted: Wanted | None = None
        self._raster: moderngl.Texture | None = None
        self._raster_ev = 0.0
        self._ray_linear: moderngl.Texture | None = None
        self._ray: moderngl.Texture | None = None
        self._ray_ev = 0.0
        self.raster_s = 0.0
        self.raster_error: Exception | None = None

    def raster(self, wanted: Wanted, exposure_ev: float) -> moderngl.Texture | None:
        """The raster image, drawn anew if it must be; None where that failed, see raster_error."""
        if self._timing:  # a frame later: reading it at once would wait for the GPU
            self.raster_s, self._timing = self._timer.elapsed * 1e-9, False
        try:
            if wanted != self._wanted:
                self._show(wanted.scene)
                with self._timer:
                    self._linear = self._rasterizer.draw(wanted.camera, wanted.size).color
                self._wanted, self._raster, self._timing = wanted, None, True
            if self._linear is not None and (
                self._raster is None or exposure_ev != self._raster_ev
            ):
                self._raster = self._display.draw(self._linear, exposure_ev)
                self._raster_ev = exposure_ev
            self.raster_error = None
        except (LucidaError, moderngl.Error) as error:  # shown in the window, which goes on
            self._wanted = self._raster = self._linear = None
            self.raster_error = error
        return self._raster

    def take_ray(self, image: RayImage) -> None:
        """Puts a traced image on the GPU."""
        self._ray_linear = self._display.upload(image.frame.channel("color"))
        self._ray = None

    def ray(self, exposure_ev: float) -> moderngl.Texture | None:
        """The last traced image; None before the first."""
        if self._ray_linear is not None and (self._ray is None or exposure_ev != self._ray_ev):
            self._ray = self._display.draw(self._ray_linear, exposure_ev)
            self._ray_ev = exposure_ev
        return self._ray

    @property
    def timing(self) -> bool:
        """Whether the last raster image's time is still to be read, in the next frame."""
        return self._timing

    def read_back(self, wanted: Wanted) -> Frame:
        """All channels of a raster image as arrays. Raises LucidaError."""
        self._show(wanted.scene)
        self._wanted = None  # the textures are drawn over
        return self._rasterizer.render(wanted.camera, wanted.size, CHANNELS)

    @property
    def platform(self) -> str:
        """The GL renderer and its version."""
        return self._rasterizer.platform

    def release(self) -> None:
        with contextlib.suppress(moderngl.Error):
            self._rasterizer.release()
            self._display.release()

    def _show(self, scene: Scene) -> None:
        if scene is not self._scene:
            self._rasterizer.set_scene(scene)
            self._scene = scene
