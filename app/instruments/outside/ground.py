"""The scene from outside, without the drawing over it. Its edges are smooth once it is still."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import moderngl

from lucida.app.images.request import ImageRequest
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.renderer.images.coarseness import STILL_S, reduced
from lucida.renderer.raster.overlay import Overlay
from lucida.renderer.raster.targets import Textures

PLACES = {1: "Outside", 2: "Outside, moving"}  # by coarseness, see Rasterizer.draw
SLOW_S = 1 / 30  # time per moving picture above which pictures become coarser
# Subpixel shifts of the pictures that are averaged: no two are in a row or column. The last picture
# is not shifted, so that visibility is decided at the pixels' centres.
SHIFTS = ((-0.125, -0.375), (0.375, -0.125), (0.125, 0.375), (-0.375, 0.125), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class GroundPicture:
    """A picture of the scene from outside; each drawing makes a new one.

    changed_s: the time of the request. factor: its coarseness; 1 for full resolution. mean: its
    colour with smooth edges, once it has been still.
    """

    request: ImageRequest
    textures: Textures
    changed_s: float
    factor: int
    mean: moderngl.Texture | None = None


class Ground:
    """The scene's picture in one view. It is kept while only the other camera moves.

    shown: the newest picture.
    """

    def __init__(self) -> None:
        self.shown: GroundPicture | None = None

    @property
    def settled(self) -> bool:
        """True if the picture's edges are smooth."""
        return self.shown is None or self.shown.mean is not None

    def forget(self) -> None:
        self.shown = None

    def picture(
        self,
        request: ImageRequest,
        rasterizer: WindowRasterizer,
        overlay: Overlay,
        refines: bool = True,
    ) -> GroundPicture:
        """Draw the picture at once, and with smooth edges once it has been still.

        refines: False while frames have something else to draw. Raises LucidaError.
        """
        now_s, picture = time.monotonic(), self.shown
        if picture is None or picture.request != request:
            gap_s = STILL_S if picture is None else now_s - picture.changed_s
            is_slow = gap_s > SLOW_S or (picture is not None and picture.factor > 1)
            factor = 2 if is_slow and gap_s < STILL_S else 1
            self.shown = None
            drawn = replace(request, size=reduced(request.size, factor))
            textures = rasterizer.draw(drawn, PLACES[factor])
            self.shown = picture = GroundPicture(request, textures, now_s, factor)
        elif picture.mean is None and refines and now_s - picture.changed_s >= STILL_S:
            for number, shift in enumerate(SHIFTS):
                camera = request.camera.shifted(*shift, request.size)
                textures = rasterizer.draw(replace(request, camera=camera), PLACES[1])
                mean = overlay.gather(textures, number == 0, 1 / len(SHIFTS))
            self.shown = picture = replace(picture, textures=textures, mean=mean, factor=1)
        return picture
