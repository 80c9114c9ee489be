"""The raster image of a moving camera: drawn at once, coarse if one frame has no time for all of
it, and full when the camera rests.

Everything runs on the window's thread, which has the OpenGL context.
"""

from __future__ import annotations

import functools
import time
from dataclasses import dataclass

import moderngl
from numpy.typing import NDArray

from app.images.lens_tables import LensTables
from app.images.progressive_raster import Pace, ProgressiveRaster
from app.images.readback import Readback, Region
from app.images.request import ImageRequest
from app.images.window_rasterizer import FAILURES, WindowRasterizer
from app.state.options import Pixel
from renderer.coarseness import Coarseness
from renderer.frame import Frame
from renderer.memo import Memo
from renderer.raster import Rasterizer
from renderer.raster.targets import Textures

MOVING_S = 0.1  # after a change, at least, before a full raster image: the ray image comes first
FRAME_S = 0.0035  # what a raster image may take of a frame while the camera moves
COARSEST = 4
PLACES = {False: ("", "full too"), True: ("coarse", "coarse too")}  # by whether it is coarse


@dataclass(frozen=True, eq=False)
class RasterImage:
    """A complete image.

    number: differs from image to image. factor: how many times coarser it is. textures: the next
    image overwrites them. place: where they are, see Rasterizer.draw.
    """

    request: ImageRequest
    textures: Textures
    number: int
    factor: int
    place: str


@dataclass(eq=False)
class _UnderWay:
    """An image that is being drawn.

    sharpening: full, over as many frames as it takes. frame: the last frame in which it was
    continued. time_s: measured on the GPU so far.
    """

    request: ImageRequest
    drawing: ProgressiveRaster
    sharpening: bool
    frame: int = -1
    time_s: float = 0.0


class LiveRaster:
    """The raster image, in a context that must be current in every call.

    smooth: no frame waits for more than a part of an image. image: the newest complete one; None
    before the first, and after a failure. time_s: its time on the GPU. coarseness, pace: how coarse
    an image begins, and how much of one is drawn in a frame, from measured times.
    """

    def __init__(
        self, context: moderngl.Context, rasterizer: WindowRasterizer, smooth: bool = True
    ) -> None:
        self._rasterizer, self._smooth = rasterizer, smooth
        self.coarseness, self.pace = Coarseness(FRAME_S, FRAME_S, COARSEST), Pace()
        self._timer = context.query(time=True)
        self._timed: tuple[_UnderWay, bool] | None = None  # a part, and whether it was the last
        self._asked: ImageRequest | None = None  # the newest, whether or not it is drawn already
        self._changed_s = 0.0
        self._factor = 1  # of what is asked for
        self._under_way: _UnderWay | None = None
        self.lens_tables = LensTables()
        self._frame = self._number = 0
        self._reading: Readback | None = None
        self._values, self._hit = Memo(_read), Memo(_read)
        self.image: RasterImage | None = None
        self.time_s = 0.0

    def begin_frame(self) -> None:
        """Call once a frame, before anything else."""
        self._frame += 1
        self._read_time()

    @property
    def unfinished(self) -> bool:
        """True if later frames have something to draw, as long as the image is still asked for."""
        return self._under_way is not None or (self.image is not None and self.image.factor > 1)

    @property
    def is_timed(self) -> bool:
        """True if the next frame has a time to read."""
        return self._timed is not None

    def follow(self, request: ImageRequest) -> RasterImage:
        """Return the newest complete image, which is of an older camera if an image takes several
        frames.

        Draw it again if necessary, but not for effects, which it lacks. Raises one of FAILURES.
        """
        request = request.without_effects
        if request != self._asked:
            self._asked, self._changed_s = request, time.monotonic()
            width, height = request.size
            self._factor = self.coarseness.changed(width * height, self._changed_s)
        if self._under_way is not None and _is_in_vain(self._under_way, request):
            self._under_way = None
        if self._under_way is None:
            still_s = time.monotonic() - self._changed_s
            if self.image is None or self.image.request != request:
                self._begin(request)
            elif (
                self.image.factor > 1
                and still_s > max(MOVING_S, self.coarseness.rest_s)
                and self._has_table(request)
            ):
                self._begin(request, sharpening=True)
        self._go_on()
        assert self.image is not None
        return self.image

    def full(self, request: ImageRequest) -> RasterImage | None:
        """Return the image of a request if it is drawn in full."""
        image, request = self.image, request.without_effects
        is_it = image is not None and image.request == request and image.factor == 1
        return image if is_it else None

    def read_back(self, request: ImageRequest) -> Frame | None:
        """Return all channels of the full image as arrays; None until the last part is read, one
        per call.

        Raises one of FAILURES.
        """
        request = request.without_effects
        image = self.full(request)
        if image is None and not self._has_table(request):
            return None
        if image is None:  # to be drawn, and read from the next frame on
            if self._under_way is None or self._under_way.request != request:
                self._begin(request, sharpening=True)
            self._go_on()
            return None
        if self._reading is None or self._reading.of is not image:
            rasterizer = self._rasterizer.of(request.scene)
            read = functools.partial(rasterizer.read, place=image.place)
            self._reading = Readback(image, request.size, read)
        frame = self._reading.go_on(self._smooth)
        if frame is not None:
            self._reading = None
        return frame

    def values(self, request: ImageRequest, channel: str, region: Region) -> NDArray | None:
        """Return a channel's values in some pixels of the image; None unless it is drawn in full.

        region: first row and column, one past the last of each. Waits for the GPU.
        """
        image = self.full(request)
        if image is None:
            return None
        rasterizer = self._rasterizer.of(request.scene)
        return self._values(rasterizer, image, (channel,), region)[channel]

    def hit(self, request: ImageRequest, pixel: Pixel) -> tuple[int, float] | None:
        """Return the object's number at (row, column), -1 for none, and the ray parameter; None
        unless the image is drawn in full. Waits for the GPU, once per pixel.
        """
        image, (row, column) = self.full(request), pixel
        if image is None or row >= request.size[1] or column >= request.size[0]:
            return None
        rasterizer, region = self._rasterizer.of(request.scene), (row, column, row + 1, column + 1)
        read = self._hit(rasterizer, image, ("id", "depth"), region)
        return int(read["id"][0, 0]), float(read["depth"][0, 0])

    def _has_table(self, request: ImageRequest) -> bool:
        return not self._smooth or self.lens_tables.ready(request)

    def forget(self) -> None:
        """Drop the image after a failure: it may have been overwritten."""
        self.image, self._under_way, self._reading = None, None, None

    def _begin(self, request: ImageRequest, sharpening: bool = False) -> None:
        rasterizer, image = self._rasterizer.of(request.scene), self.image
        factor = 1 if sharpening or not self._smooth else self._factor
        if not sharpening and not self._has_table(request):
            factor = COARSEST
        width, height = request.size
        drawing = ProgressiveRaster(
            rasterizer,
            request.camera,
            request.size,
            factor,
            PLACES[factor > 1],
            image.place if image is not None else None,
            self.pace,
            expected_s=self.coarseness.full_s(width * height) if sharpening else 0.0,
            at_once=not self._smooth
            or image is None
            or image.request.scene is not request.scene
            or (image.request.size != request.size and not sharpening),  # else it is not shown yet
            enlargement=request.enlargement,
        )
        self._under_way = _UnderWay(request, drawing, sharpening)

    def _go_on(self) -> None:
        """Draw the next part, once a frame, no matter how many ask."""
        under_way = self._under_way
        if under_way is None or under_way.frame == self._frame:
            return
        try:
            with self._timer:
                drawn = under_way.drawing.go_on()
        except FAILURES:
            self.forget()
            raise
        under_way.frame = self._frame
        self._timed = under_way, drawn is not None
        if drawn is not None:
            drawing, self._under_way, self._reading = under_way.drawing, None, None
            self._number += 1
            self.image = RasterImage(
                under_way.request, drawn, self._number, drawing.factor, drawing.place
            )

    def _read_time(self) -> None:
        """Read the time of the last part. A frame later, this does not wait for the GPU."""
        if self._timed is None:
            return
        (part_of, is_last), self._timed = self._timed, None
        part_of.time_s += self._timer.elapsed * 1e-9
        if is_last:
            drawing, self.time_s = part_of.drawing, part_of.time_s
            width, height = drawing.size
            self.coarseness.measured(drawing.factor, width * height, self.time_s)


def _read(
    rasterizer: Rasterizer, image: RasterImage, channels: tuple[str, ...], region: Region
) -> dict[str, NDArray]:
    return rasterizer.read(channels, region, image.place)


def _is_in_vain(under_way: _UnderWay, request: ImageRequest) -> bool:
    """Return True if the image would be too old to show.

    An image in motion is finished, so that the motion always shows something new.
    """
    of = under_way.request
    is_stale = of.scene is not request.scene or of.size != request.size
    return is_stale or (under_way.sharpening and of != request)
