"""A raster image that is drawn over several frames, because one has no time for all its triangles,
or for all its pixels.

A GPU draws a million triangles in a part of a frame: then there is one part. With OpenGL on the
CPU, the window's own thread transforms every vertex, and waits for every pixel.
"""

from __future__ import annotations

import time

from renderer.camera import Camera
from renderer.coarseness import reduced
from renderer.lens_faces import ENLARGEMENT
from renderer.raster import Rasterizer
from renderer.raster.targets import Textures

PART_S = 0.005  # what a part may take of the window's thread
WORTH_S = 0.015  # an image whose triangles take less is drawn at once
FEWEST = 10_000  # triangles a part
STRIP_S = 0.02  # what a part may take to be shaded
STRIP_PIXELS = 1 << 16  # a part, at least: a small image says little of what a large one takes


class Pace:
    """The measured time of a triangle on the window's thread: processor time, which other programs
    do not lengthen.
    """

    def __init__(self) -> None:
        self._triangle_s = 0.0

    def measured(self, triangles: int, time_s: float) -> None:
        if triangles < FEWEST or time_s <= 0.0:  # other things take the time; a coarse clock
            return
        triangle_s = time_s / triangles
        # Parts that are to be seen take longer than others: at once slower, then quicker by halves.
        if self._triangle_s > triangle_s:
            triangle_s = (self._triangle_s + triangle_s) / 2
        self._triangle_s = triangle_s

    def part_of(self, triangles: int) -> int:
        """Return how many of so many triangles to draw in a frame."""
        if self._triangle_s * triangles <= WORTH_S:
            return triangles
        return min(max(int(PART_S / self._triangle_s), FEWEST), triangles)


class ProgressiveRaster:
    """An image of a rasterizer's scene, reduced by `factor`.

    places: two of the rasterizer's (see Rasterizer.draw). shown: the one that is visible meanwhile,
    which an image in several parts leaves alone. expected_s: the likely time of shading on the GPU,
    or what replaces it. at_once: draw it in one part, whatever it takes. enlargement: of a
    lens's faces.
    """

    def __init__(
        self,
        rasterizer: Rasterizer,
        camera: Camera,
        size: tuple[int, int],
        factor: int,
        places: tuple[str, str],
        shown: str | None,
        pace: Pace,
        expected_s: float = 0.0,
        at_once: bool = False,
        enlargement: int = ENLARGEMENT,
    ) -> None:
        self.factor = factor
        self.size = reduced(size, factor)
        width, height = self.size
        self._rasterizer, self._camera, self._pace = rasterizer, camera, pace
        self._enlargement = enlargement
        rows = height if expected_s <= STRIP_S else int(height * STRIP_S / expected_s)
        self._rows = min(max(rows, STRIP_PIXELS // width, 1), height)  # a strip
        is_quick = self._rows == height and pace.part_of(self._triangles) == self._triangles
        self._is_whole = at_once or is_quick
        self.place = places[0] if self._is_whole or places[0] != shown else places[1]
        self._first = self._first_row = 0
        self._is_seen = False
        self._face, self._faces = 0, rasterizer.faces(camera, self.size, enlargement)

    @property
    def _triangles(self) -> int:
        return self._rasterizer.triangles

    def go_on(self) -> Textures | None:
        """Draw the next part. Return the image once it is complete. Raises LucidaError."""
        what, height = (self._camera, self.size, self.place), self.size[1]
        lens = self._enlargement, self._face
        start_s = time.thread_time()
        if self._is_whole:
            drawn = self._rasterizer.draw(*what, self._enlargement)
            self._pace.measured(self._triangles, time.thread_time() - start_s)
            return drawn
        if not self._is_seen:
            count = min(self._pace.part_of(self._triangles), self._triangles - self._first)
            self._is_seen = self._rasterizer.see(*what, self._first, count, *lens)
            self._pace.measured(count, time.thread_time() - start_s)
            self._first += count
            return None  # triangles have taken this frame's time
        rows = self._first_row, min(self._first_row + self._rows, height)
        shaded = self._rasterizer.shade(*what, rows, *lens)
        self._first_row = rows[1]
        if rows[1] < height:
            return None
        self._face += 1
        self._first = self._first_row = 0
        self._is_seen = False
        return shaded if self._face == self._faces else None
