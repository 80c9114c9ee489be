"""The raster image of the window, drawn as a whole and only if something has changed.

Everything runs on the window's thread, which has the OpenGL context.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.coarseness import FACTORS, reduced
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.raster import Rasterizer
from lucida.renderer.raster.targets import Region, Textures
from lucida.renderer.system.memo import Memo

from .lens_tables import LensTables
from .request import ImageRequest
from .window_rasterizer import FAILURES, WindowRasterizer

# Returns the image to draw for a request, and its coarseness.
Choice = Callable[[ImageRequest], tuple[ImageRequest, int]]
PLACES = {False: "", True: "coarse"}  # by the image's coarseness, see Rasterizer.draw


@dataclass(frozen=True, eq=False)
class RasterImage:
    """A raster image.

    factor: its coarseness. textures: the next image overwrites them.
    """

    request: ImageRequest
    factor: int
    textures: Textures

    def texture(self, channel: str) -> moderngl.Texture:
        """Return a channel's texture for Display.show()."""
        drawn = self.textures
        return {"color": drawn.color, "id": drawn.object}.get(channel, drawn.surface)


class LiveRaster:
    """The raster image, in a context that must be current in every call.

    image: the newest one; None before the first, and after a failure. took: its factor and its
    time, on this thread and on the GPU; (1, 0.0) before a time is known.
    """

    def __init__(
        self, context: moderngl.Context, rasterizer: WindowRasterizer, choice: Choice
    ) -> None:
        self._rasterizer, self._choice = rasterizer, choice
        self._timer = context.query(time=True)
        self._drawing: tuple[int, float] | None = None  # the factor, and this thread's time
        self.lens_tables = LensTables()
        self._values = Memo(_read, most=2)  # for the visible pixels, and the one under the mouse
        self.image: RasterImage | None = None
        self.took = 1, 0.0

    def begin_frame(self) -> None:
        """Read the time of the last image, which is available without waiting a frame later. Call
        this once a frame, before anything else.
        """
        if self._drawing is not None:
            factor, time_s = self._drawing
            self.took, self._drawing = (factor, time_s + self._timer.elapsed * 1e-9), None

    @property
    def unfinished(self) -> bool:
        """True if the image is coarse, so that a full one will follow."""
        return self.image is not None and self.image.factor > 1

    @property
    def is_timed(self) -> bool:
        """True if the next frame has a time to read."""
        return self._drawing is not None

    def follow(self, request: ImageRequest) -> RasterImage:
        """Return the image to show for a request, drawn now if necessary. Raises one of FAILURES.

        The tracer's effects do not cause another drawing.
        """
        request, factor = self._choice(request)
        return self._drawn(request, factor)

    def full(self, request: ImageRequest) -> RasterImage | None:
        """Return the image of a request if it is drawn in full."""
        image, request = self.image, request.without_effects
        is_it = image is not None and image.request == request and image.factor == 1
        return image if is_it else None

    def read_back(self, request: ImageRequest) -> Frame | None:
        """Return all channels of the full image as arrays; None while a lens's table is being made.

        Waits for the GPU. Raises one of FAILURES.
        """
        if self._drawn(request, 1).factor > 1:
            return None
        arrays = self._rasterizer.of(request.scene).read(CHANNELS, place=PLACES[False])
        return Frame(size=request.size, **arrays)

    def values(
        self, request: ImageRequest, channels: tuple[str, ...], region: Region
    ) -> dict[str, NDArray] | None:
        """Return the values of channels in some pixels of the image; None unless it is drawn in
        full.

        region: first row and column, one past the last of each. Waits for the GPU.
        """
        image = self.full(request)
        if image is None:
            return None
        return self._values(self._rasterizer.of(request.scene), image, channels, region)

    def z(self, image: RasterImage) -> NDArray[np.float32]:
        """Return the distances z of the newest image, (height, width). Waits for the GPU."""
        rasterizer = self._rasterizer.of(image.request.scene)
        depth = rasterizer.read(("depth",), place=PLACES[image.factor > 1])["depth"]
        return image.request.camera.z_from_t(depth, depth.shape[::-1]).astype(np.float32)

    def forget(self) -> None:
        """Drop the image after a failure: it may have been overwritten."""
        self.image = None

    def _drawn(self, request: ImageRequest, factor: int) -> RasterImage:
        """Return a request's image, at a factor or finer."""
        request = request.without_effects
        if factor == 1 and not self.lens_tables.ready(request):
            factor = FACTORS[-1]  # until the table is ready
        image = self.image
        if image is not None and image.request == request and image.factor <= factor:
            return image
        rasterizer, place = self._rasterizer.of(request.scene), PLACES[factor > 1]
        size = reduced(request.size, factor)
        start_s = time.thread_time()
        try:
            with self._timer:
                textures = rasterizer.draw(request.camera, size, place, request.enlargement)
        except FAILURES:
            self.forget()
            raise
        self._drawing = factor, time.thread_time() - start_s
        self.image = RasterImage(request, factor, textures)
        return self.image


def _read(
    rasterizer: Rasterizer, image: RasterImage, channels: tuple[str, ...], region: Region
) -> dict[str, NDArray]:
    return rasterizer.read(channels, region, PLACES[image.factor > 1])
