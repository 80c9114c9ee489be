"""The scene from outside, without the drawing over it: at once, and smooth when it is still.

Where OpenGL runs on the CPU, a full picture takes longer than a frame. There it is coarse while the
view moves.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import moderngl

from app.images.request import ImageRequest
from app.images.window_rasterizer import WindowRasterizer
from renderer.coarseness import STILL_S, Coarseness, reduced
from renderer.memo import Memo
from renderer.raster.overlay import Overlay
from renderer.raster.targets import Textures

PLACE, COARSE = "Outside", "Outside, coarse"  # see Rasterizer.draw
FRAME_S = 0.008  # what a picture may take of a frame while the view moves
# Parts of a pixel by which the pictures of a mean are shifted: no two in a row or column. The last
# is not, so that what lies behind is decided at the pixels' centres.
SHIFTS = ((-0.125, -0.375), (0.375, -0.125), (0.125, 0.375), (-0.375, 0.125), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class GroundPicture:
    """The scene from outside.

    changed_s: since when it has been requested. number: of its drawing. parts: the number of SHIFTS
    in its mean. factor: its coarseness.
    """

    request: ImageRequest
    textures: Textures
    changed_s: float
    number: int
    parts: int = 0
    mean: moderngl.Texture | None = None
    factor: int = 1

    @property
    def smooth(self) -> bool:
        return self.mean is not None and self.parts == len(SHIFTS)


class Ground:
    """The scene's picture in one view, in its context. It stays while only the other camera moves.

    shown: the newest picture. coarseness: from the times of earlier ones.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.shown: GroundPicture | None = None
        self._drawn = 0
        self._t_at = Memo(_t_at)
        self._timer = context.query(time=True)
        # Factor and pixels of the picture whose time has not been read yet.
        self._timed: tuple[int, int] | None = None
        self.coarseness = Coarseness(FRAME_S)

    @property
    def settled(self) -> bool:
        """True if the picture is full and its edges are as smooth as they will be."""
        picture = self.shown
        return picture is None or (picture.parts == len(SHIFTS) and picture.factor == 1)

    @property
    def factor(self) -> int:
        """Return the coarseness of the last picture; 1 if it is full."""
        return self.shown.factor if self.shown is not None else 1

    def forget(self) -> None:
        self.shown = None

    def t_at(self, part: tuple[float, float], overlay: Overlay) -> float:
        """Return the ray parameter of the visible scene at a place, infinity without a
        picture. It is read once. See Overlay.t_at().
        """
        picture = self.shown
        return self._t_at(overlay, picture, part) if picture is not None else math.inf

    def picture(
        self,
        request: ImageRequest,
        rasterizer: WindowRasterizer,
        overlay: Overlay,
        refines: bool = True,
    ) -> GroundPicture:
        """Draw the picture at once; once it has been still, in full, and then with smooth
        edges, a part of that in each call. refines: False while frames have something else to
        draw. Raises LucidaError.
        """
        now_s, picture = time.monotonic(), self.shown
        self._read_time()
        if picture is None or picture.request != request:
            if picture is None or picture.request.scene is not request.scene:
                self.coarseness.forget()
            factor = self.coarseness.changed(request.size[0] * request.size[1], now_s)
            self.shown = None
            self.shown = picture = self._draw(request, rasterizer, now_s, factor)
        elif not refines or now_s - picture.changed_s < STILL_S:
            pass
        elif picture.factor > 1:
            self.shown = picture = self._draw(request, rasterizer, picture.changed_s, 1)
        elif picture.parts < len(SHIFTS):
            self.shown = picture = self._smoother(picture, rasterizer, overlay)
        return picture

    def _draw(
        self, request: ImageRequest, rasterizer: WindowRasterizer, changed_s: float, factor: int
    ) -> GroundPicture:
        textures = self._textures(request, rasterizer, factor)
        self._drawn += 1
        return GroundPicture(request, textures, changed_s, self._drawn, factor=factor)

    def _smoother(
        self, picture: GroundPicture, rasterizer: WindowRasterizer, overlay: Overlay
    ) -> GroundPicture:
        """Return the picture with one more sample in its mean."""
        request = picture.request
        shift = request.camera.shifted(*SHIFTS[picture.parts], request.size)
        textures = self._textures(replace(request, camera=shift), rasterizer)
        mean = overlay.gather(textures, picture.parts == 0, 1 / len(SHIFTS))
        return replace(picture, textures=textures, parts=picture.parts + 1, mean=mean)

    def _textures(
        self, request: ImageRequest, rasterizer: WindowRasterizer, factor: int = 1
    ) -> Textures:
        size = reduced(request.size, factor)
        with self._timer:
            textures = rasterizer.draw(replace(request, size=size), COARSE if factor > 1 else PLACE)
        self._timed = factor, size[0] * size[1]
        return textures

    def _read_time(self) -> None:
        """Read the time of the last frame: reading that of this frame would wait for the GPU."""
        if self._timed is not None:
            self.coarseness.measured(*self._timed, self._timer.elapsed * 1e-9)
            self._timed = None


def _t_at(overlay: Overlay, picture: GroundPicture, part: tuple[float, float]) -> float:
    return overlay.t_at(picture.textures, part)
