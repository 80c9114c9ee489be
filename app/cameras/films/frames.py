"""One picture of a film, or one part of a large image.

Workers on other machines call draw_shot() with the scene that they have been sent.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images import encode_image
from lucida.renderer.images.frame import Frame, stored
from lucida.renderer.scene.model import Scene


@dataclass(frozen=True)
class Shot:
    """A picture to draw. size: the camera's image size. rows: the first row, and the one past the
    last; None for all.
    """

    camera: Camera
    size: Size
    rows: tuple[int, int] | None = None


@dataclass(frozen=True)
class Look:
    """The settings of pictures; all but threads affect their look.

    samples: samples per pixel. shadows, mirrors: the ray tracer's effects. threads: None for one
    per processor. channel, ending: the channel that is written (a frame's, or z), and its format.
    """

    renderer: Literal["raster", "ray"] = "raster"
    samples: int = 1
    shadows: bool = False
    mirrors: int = 0
    exposure: float = 0.0
    backend: str = "auto"
    threads: int | None = None
    channel: str = "color"
    ending: str = ".png"


class Drawing:
    """The renderer of one scene, kept from picture to picture. Only the one in use is loaded."""

    def __init__(self, scene: Scene, look: Look) -> None:
        self.scene, self.look = scene, look
        self._open = ExitStack()
        self.close = self._open.close
        if look.renderer == "ray":
            from lucida.renderer.trace import Tracer

            tracer = Tracer(scene, look.threads, "packets", look.shadows, look.mirrors)
            self._tracer = self._open.enter_context(tracer)
        else:
            from lucida.renderer.raster import Rasterizer

            self._rasterizer = self._open.enter_context(Rasterizer(scene, look.backend))

    def encoded(self, shot: Shot) -> bytes:
        """Return the bytes of the picture's file."""
        look, frame = self.look, self.frame(shot, (stored(self.look.channel),))
        if look.channel == "z":
            camera = shot.camera.cropped(shot.rows, shot.size) if shot.rows else shot.camera
            frame = with_z(frame, camera)
        return encode_image(look.ending, frame, stored(look.channel), look.exposure)

    def frame(
        self,
        shot: Shot,
        channels: tuple[str, ...],
        progress: Callable[[float], None] | None = None,
    ) -> Frame:
        """Draw channels of a picture. progress is called with fractions 0 to 1."""
        camera, size, samples = shot.camera, shot.size, self.look.samples
        if self.look.renderer == "ray":
            return self._tracer.render(camera, size, channels, samples, progress, shot.rows)
        if shot.rows is not None:
            camera = camera.cropped(shot.rows, size)
            size = size[0], shot.rows[1] - shot.rows[0]
        return self._rasterizer.render(camera, size, channels, samples, progress)


def with_z(frame: Frame, camera: Camera) -> Frame:
    """Return a frame with the distances z along -w in place of its ray parameters t."""
    z = camera.z_from_t(frame.channel("depth"), frame.size)
    return replace(frame, depth=z.astype(np.float32))


_kept: Drawing | None = None  # of this process


def draw_shot(scene: Scene, look: Look, shot: Shot) -> bytes:
    """Return the bytes of a picture. The renderers are kept for the next one of the same scene."""
    global _kept
    if _kept is None or _kept.scene is not scene or _kept.look != look:
        close_kept()
        _kept = Drawing(scene, look)
    return _kept.encoded(shot)


def close_kept() -> None:
    """Release the renderers that draw_shot() has kept."""
    global _kept
    if _kept is not None:
        _kept.close()
        _kept = None
