"""The scene from outside, without anything over it: drawn at once, made smooth when it is still.

Owns the pictures of one scene and camera, and when they are drawn. Knows nothing of what stands in
the scene.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import moderngl

from app.images.pictures import Pictures, Wanted
from renderer.raster.overlay import Overlay
from renderer.raster.targets import Textures

PLACE = "Outside"  # see Rasterizer.draw
STILL_S = 0.15  # without a change of the view, before its edges are made smooth
SLOW_S = 0.06  # a scene that takes longer to prepare for a camera keeps its edges as they are
# Parts of a pixel by which the pictures of a mean are shifted: no two in a row or column. The last
# is not, so that what lies behind is decided at the pixels' centres.
SHIFTS = ((-0.125, -0.375), (0.375, -0.125), (0.125, 0.375), (-0.375, 0.125), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class Picture:
    """The scene from outside. number: of its drawing. parts: how many of the SHIFTS are in its
    mean; all of them also where there will be none."""

    wanted: Wanted
    textures: Textures
    drawn_s: float
    number: int
    parts: int
    mean: moderngl.Texture | None = None

    @property
    def smooth(self) -> bool:
        return self.mean is not None and self.parts == len(SHIFTS)


class Ground:
    """One for the view. It stays while only the other camera moves."""

    def __init__(self) -> None:
        self._picture: Picture | None = None
        self._drawn = 0

    @property
    def settled(self) -> bool:
        """Whether its edges are as smooth as they will be."""
        return self._picture is None or self._picture.parts == len(SHIFTS)

    def forget(self) -> None:
        self._picture = None

    def picture(self, wanted: Wanted, pictures: Pictures, overlay: Overlay) -> Picture:
        """Drawn at once; when it has been still, again with smooth edges, a part of that in each
        call. Raises LucidaError."""
        now_s, picture = time.monotonic(), self._picture
        if picture is None or picture.wanted != wanted:
            self._picture = None
            textures = pictures.beside(wanted, PLACE)
            self._drawn += 1
            slow = time.monotonic() - now_s > SLOW_S
            parts = len(SHIFTS) if slow else 0
            self._picture = picture = Picture(wanted, textures, now_s, self._drawn, parts)
        if picture.parts < len(SHIFTS) and now_s - picture.drawn_s > STILL_S:
            shift = wanted.camera.shifted(*SHIFTS[picture.parts], wanted.size)
            textures = pictures.beside(replace(wanted, camera=shift), PLACE)
            mean = overlay.gather(textures, picture.parts == 0, 1 / len(SHIFTS))
            self._picture = picture = replace(
                picture, textures=textures, parts=picture.parts + 1, mean=mean
            )
        return picture
