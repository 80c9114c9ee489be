"""One picture of a film, or one part of a large image: drawn by either renderer or by both.

Workers on other machines call draw_shot() with the scene that they have been sent.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import ENLARGEMENT
from lucida.renderer.images import encode_image, picture
from lucida.renderer.images.frame import Frame
from lucida.renderer.images.png import png_of
from lucida.renderer.scene.model import Scene

if TYPE_CHECKING:
    from lucida.renderer.raster import Rasterizer
    from lucida.renderer.trace import Tracer

GAP = 8  # black columns between both images
Renderer = Literal["raster", "ray", "both"]


@dataclass(frozen=True)
class Shot:
    """A picture to draw. size: of the camera's image. rows: the first, and the one past the last;
    None for all.
    """

    camera: Camera
    size: Size
    rows: tuple[int, int] | None = None


@dataclass(frozen=True)
class Look:
    """The settings of pictures; all but threads decide what they look like.

    samples: per pixel. shadows, mirrors: of the ray tracer. threads: None for one per processor.
    channel, ending: what is written of each, and its format; both renderers have colour in PNGs.
    """

    renderer: Renderer = "raster"
    samples: int = 1
    shadows: bool = False
    mirrors: int = 0
    exposure: float = 0.0
    backend: str = "auto"
    threads: int | None = None
    channel: str = "color"
    ending: str = ".png"
    enlargement: int = ENLARGEMENT

    def frame_size(self, size: Size) -> Size:
        """Return the size of a film's frame, in which each image has that size."""
        width, height = size
        return (2 * width + GAP if self.renderer == "both" else width), height


class Drawing:
    """The renderers of one scene, kept from picture to picture."""

    def __init__(self, scene: Scene, look: Look) -> None:
        self.scene, self.look = scene, look
        self._open = ExitStack()
        self._rasterizer: Rasterizer | None = None
        self._tracer: Tracer | None = None
        if look.renderer != "ray":
            from lucida.renderer.raster import Rasterizer

            self._rasterizer = self._open.enter_context(Rasterizer(scene, look.backend))
        if look.renderer != "raster":
            from lucida.renderer.trace import Tracer

            tracer = Tracer(scene, look.threads, "packets", look.shadows, look.mirrors)
            self._tracer = self._open.enter_context(tracer)

    def encoded(self, shot: Shot) -> bytes:
        """Return the bytes of the picture's file."""
        look, frames = self.look, self._frames(shot)
        if len(frames) == 1:
            return encode_image(look.ending, frames[0], look.channel, look.exposure)
        gap = np.zeros((shot.size[1], GAP, 3), np.uint8)
        one, other = (picture(frame, "color", look.exposure) for frame in frames)
        return png_of(np.concatenate([one, gap, other], axis=1))

    def _frames(self, shot: Shot) -> list[Frame]:
        look, camera, size = self.look, shot.camera, shot.size
        frames = []
        if self._rasterizer is not None:
            if shot.rows is not None:
                camera = camera.cropped(shot.rows, size)
                size = size[0], shot.rows[1] - shot.rows[0]
            frames.append(
                self._rasterizer.render(
                    camera, size, (look.channel,), look.samples, None, look.enlargement
                )
            )
        if self._tracer is not None:
            frames.append(
                self._tracer.render(
                    shot.camera, shot.size, (look.channel,), look.samples, None, shot.rows
                )
            )
        return frames

    def close(self) -> None:
        self._open.close()


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
