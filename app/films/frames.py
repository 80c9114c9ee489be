"""One frame of a film: drawn by either renderer or by both, as a PNG.

Workers on other machines call draw_frame() with the scene that they have been sent.
"""

from __future__ import annotations

import io
from contextlib import ExitStack
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from renderer.camera import Camera, Size
from renderer.images import picture
from renderer.images.display import Bytes
from renderer.images.png import write_png
from renderer.scene.model import Scene

if TYPE_CHECKING:
    from renderer.raster import Rasterizer
    from renderer.trace import Tracer

GAP = 8  # black columns between both images
Renderer = Literal["raster", "ray", "both"]


@dataclass(frozen=True)
class Look:
    """The settings of a film's frames; all but threads decide what they look like.

    size: of each image. samples: per pixel. shadows, mirrors: of the ray tracer. threads: None for
    one per processor.
    """

    size: Size
    renderer: Renderer = "raster"
    samples: int = 1
    shadows: bool = False
    mirrors: int = 0
    exposure: float = 0.0
    backend: str = "auto"
    threads: int | None = None

    @property
    def frame_size(self) -> Size:
        width, height = self.size
        return (2 * width + GAP if self.renderer == "both" else width), height


class Drawing:
    """The renderers of one scene, kept from frame to frame."""

    def __init__(self, scene: Scene, look: Look) -> None:
        self.scene, self.look = scene, look
        self._open = ExitStack()
        self._renderers: list[Rasterizer | Tracer] = []
        if look.renderer != "ray":
            from renderer.raster import Rasterizer

            self._renderers.append(self._open.enter_context(Rasterizer(scene, look.backend)))
        if look.renderer != "raster":
            from renderer.trace import Tracer

            tracer = Tracer(scene, look.threads, "packets", look.shadows, look.mirrors)
            self._renderers.append(self._open.enter_context(tracer))

    def image(self, camera: Camera) -> Bytes:
        """Return a frame, uint8 sRGB (height, width, 3)."""
        images = []
        for renderer in self._renderers:
            frame = renderer.render(camera, self.look.size, ("color",), self.look.samples)
            images.append(picture(frame, "color", self.look.exposure))
            images.append(np.zeros((self.look.size[1], GAP, 3), np.uint8))
        return np.concatenate(images[:-1], axis=1)

    def close(self) -> None:
        self._open.close()


_kept: Drawing | None = None  # of this process


def draw_frame(scene: Scene, look: Look, camera: Camera) -> bytes:
    """Return a frame as a PNG. The renderers are kept for the next frame of the same scene."""
    global _kept
    if _kept is None or _kept.scene is not scene or _kept.look != look:
        close_kept()
        _kept = Drawing(scene, look)
    file = io.BytesIO()
    write_png(file, _kept.image(camera))
    return file.getvalue()


def close_kept() -> None:
    """Release the renderers that draw_frame() has kept."""
    global _kept
    if _kept is not None:
        _kept.close()
        _kept = None
