"""Both renderers behind the window, which keep both images up to date with the state.

They include the images' common size, the rasterizer, the live tracer and the comparison. All
methods must be called on the window's thread, with its context current.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import moderngl
from numpy.typing import NDArray

from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import ImageOptions
from lucida.app.ui.background import lower_priority
from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.why_black import Reason
from lucida.renderer.images.coarseness import reduced
from lucida.renderer.images.frame import Frame, stored
from lucida.renderer.raster import Look
from lucida.renderer.raster.targets import Region
from lucida.renderer.scene.model import View
from lucida.renderer.system import compile_note
from lucida.renderer.system.memo import Memo

from .agreement import Agreement, Verdict
from .image_size import ImageSize
from .pace import Pace
from .picking import object_on_ray
from .placement import Placement
from .progressive_ray import LiveTrace, RayImage
from .request import ImageRequest
from .scene_tracer import tracer_for
from .shown import Picture
from .textures import PANE, ImageTextures
from .window_rasterizer import FAILURES

NOTE_AFTER_S = 0.3


class Renderers(ImageSize):
    """Both images of the present state.

    While anything moves, both images have the same camera and the same size, coarser by one factor
    that follows from the time of the last ones. The raster image is drawn when the ray image of its
    request is ready, or alone if that is hidden, or the tracer is still preparing.

    wake: called on other threads when there is a new result. smooth: the tracer yields to the
    window's frames, and images in motion may be coarse.
    """

    def __init__(self, wake: Callable[[], None], smooth: bool = True) -> None:
        super().__init__()
        self._pace = Pace(smooth)
        self.agreement = Agreement(wake)
        self.live = LiveTrace(wake, tracer_for, lower_priority if smooth else None)
        self.textures: ImageTextures | None = None
        self.ray_image: RayImage | None = None
        self._raster_failed = False
        self._pair: RayImage | None = None  # the raster image has its request in this frame
        self._camera = Memo(View.for_size)
        self._moving = False
        # True if a view needs the ray image, in the last frame and in this one.
        self._tracing = self._to_trace = False

    def begin(self, context: moderngl.Context) -> None:
        """Begin with a context. Call this once."""
        self.textures = ImageTextures(context, self._to_draw)

    def end(self) -> None:
        """Release everything. Call this once, before the context is destroyed."""
        self.live.close()
        self.agreement.close()
        if self.textures is not None:
            self.textures.release()

    @property
    def _begun(self) -> ImageTextures:
        assert self.textures is not None
        return self.textures

    # Requests.

    def camera(self, state: AppState) -> Camera:
        """Return the camera of both images."""
        return self._camera(state.view, self.size if min(self.size) else (1, 1))

    def request(self, state: AppState) -> ImageRequest | None:
        """Return the image that both renderers must draw; None before the first layout."""
        if not min(self.size):
            return None
        return ImageRequest(
            state.scene,
            self.camera(state),
            self.size,
            state.options.shadows,
            state.options.mirrors,
            state.images.channel,
            state.images.samples,
            state.images.lens_enlargement,
        )

    def trace(self, state: AppState) -> None:
        """Request the present state's ray image. Call this in each frame that shows it."""
        self._to_trace = True
        self._ask(state)

    def update(self, state: AppState, moving: bool) -> None:
        """Take the threads' results. Call this once a frame. moving: True during a drag."""
        self._moving = moving
        self._begun.begin_frame()
        self.follow_resolution(state)
        self._tracing, self._to_trace = self._to_trace, False
        failed = self.raster_error is not None
        if self._raster_failed and not failed:
            self.agreement.forget()
        self._raster_failed = failed
        if self._tracing:
            self._ask(state)  # it may be ready by the end of the frame
        self._measure()
        # Compare later than in the frame in which an image arrives.
        if not self._take_ray() and self._to_compare(state) and self._pace.rests:
            self._compare(state)
        self._pair = self._next_pair(state)
        self.agreement.poll()

    def _to_draw(self, request: ImageRequest) -> tuple[ImageRequest, int]:
        """Return the raster image to show for a request, and its coarseness."""
        factor, pair = self._pace.factor_of(request), self._pair
        if pair is None or not pair.request.may_stand_in_for(request):
            return request, factor
        if pair.request.without_effects == request.without_effects:
            return request, min(factor, pair.factor)
        return pair.request, pair.factor

    def _next_pair(self, state: AppState) -> RayImage | None:
        """Return the ray image that the raster image waits for; None if it does not wait."""
        image, request = self.ray_image, self.request(state)
        if not self._tracing or image is None or self.ray_error is not None:
            return None
        if self.live.preparing_s >= NOTE_AFTER_S or not image.request.may_stand_in_for(request):
            return None
        return image

    def _ask(self, state: AppState) -> None:
        """Request the ray image; with several samples per pixel once nothing moves."""
        if (request := self.request(state)) is not None:
            factor = self._pace.factor_of(request)
            self.live.request(request if self._pace.rests else replace(request, samples=1), factor)

    def _measure(self) -> None:
        """Record the times of the last images; with OpenGL on the CPU, both use the same cores."""
        factor, time_s = self._begun.raster.took
        if self._tracing:
            image = self.ray_image
            if image is None or image.factor != factor:
                return
            time_s += image.frame.time_s
        width, height = reduced(self.size, factor)
        self._pace.measured(factor, width * height, time_s)

    def _take_ray(self) -> bool:
        """Take the newest ray image. Return True if there was one."""
        image = self.live.poll()
        if image is None:
            return False
        self._begun.take_ray(image)
        self.ray_image = image
        return True

    # Pictures and values.

    def picture(
        self, is_ray: bool, state: AppState, placement: Placement, name: str = PANE
    ) -> Picture | None:
        """Return the visible part of the raster image in a window, drawn again if necessary, or of
        the newest ray image. Return None on failure, or if the ray image has another camera.

        name: see Pictures.picture.
        """
        request, textures = self.request(state), self._begun
        assert request is not None
        draw = textures.ray_in if is_ray else textures.raster_in
        return draw(placement, request, look_of(state.images), name)

    def shown_ray(self, state: AppState) -> RayImage | None:
        """Return the visible ray image; None if it is stale."""
        image, request = self.ray_image, self.request(state)
        if image is None or request is None or not image.is_beside(self._to_draw(request)[0]):
            return None
        return image

    def depths(self) -> tuple[float, float] | None:
        """Return the ray parameters shown white and darkest; None if nothing is hit."""
        return self._begun.depths()

    def raster_values(self, state: AppState, channel: str, region: Region) -> NDArray | None:
        """Return a channel's values in some pixels of the visible raster image; None while that is
        coarse. region: first row and column, one past the last of each.
        """
        request = self.request(state)
        assert request is not None
        read = self._raster_values(request, (stored(channel),), region)
        return request.shown(channel, read[stored(channel)], region) if read else None

    def _raster_values(
        self, request: ImageRequest, channels: tuple[str, ...], region: Region
    ) -> dict[str, NDArray] | None:
        try:
            return self._begun.raster.values(request, channels, region)
        except FAILURES:  # drawing also reports it
            return None

    def ray_values(self, state: AppState, channel: str, region: Region) -> NDArray | None:
        """Return raster_values() of the ray image; None if the visible one is coarse or stale."""
        image = self.shown_ray(state)
        if image is None or image.factor > 1:
            return None
        top, left, bottom, right = region
        values = image.shown(stored(channel))[top:bottom, left:right]
        return image.request.shown(channel, values, region)

    # Progress and errors.

    def unfinished(self, state: AppState) -> bool:
        """True if later frames have work for which no thread will wake the window."""
        if not self._pace.rests or self._to_compare(state):
            return True
        return self.textures is not None and self.textures.unfinished

    @property
    def busy(self) -> bool:
        """True while the ray image is being traced, or both are being compared, on other
        threads.
        """
        return self.live.busy or self.agreement.busy

    def settled(self, state: AppState) -> bool:
        """True if the visible images are complete, and compared if both are visible."""
        if self.busy or self.unfinished(state):
            return False
        return not self._tracing or (
            self._full_ray(state) is not None and self.verdict(state) is not None
        )

    @property
    def is_tracing(self) -> bool:
        """True if the ray image is visible, so that a verdict will follow."""
        return self._tracing

    def verdict(self, state: AppState) -> Verdict | None:
        """Return the verdict on this state's images; None until it is known."""
        return self.agreement.verdict_on(self.request(state))

    def why_black(self, state: AppState) -> Reason | None:
        """Return the reason that this state's images show nothing, or only black; None if there is
        none, or it is unknown.
        """
        verdict, images = self.verdict(state), state.images
        if verdict is None:
            return None
        if images.channel != "color":
            return verdict.darkness.reason if verdict.comparison.nothing_hit else None
        return verdict.darkness.shown(images.exposure_ev, images.transfer == "linear")

    @property
    def raster_s(self) -> float:
        """The time of the visible raster image; 0 if there is none."""
        textures = self._begun
        return textures.raster.took[1] if textures.sees_raster else 0.0

    @property
    def raster_factor(self) -> int:
        """The coarseness of the raster image; 1 if it is full, or there is none."""
        image = self._begun.raster.image
        return image.factor if image is not None else 1

    @property
    def raster_error(self) -> Exception | None:
        return self.textures.raster_error if self.textures else None

    @property
    def ray_error(self) -> Exception | None:
        return self.live.error or (self.textures.ray_error if self.textures else None)

    @property
    def failure(self) -> Exception | None:
        """The error that keeps the images from being complete and compared."""
        return self.raster_error or self.ray_error or self.agreement.error

    def retry(self) -> None:
        """Retry after errors."""
        self._begun.retry()
        self.live.retry()
        self.agreement.forget()

    def preparing(self) -> str:
        """Return the tracer's work before its first image of a scene, and its duration so far;
        empty if it is quick.
        """
        passed_s = self.live.preparing_s
        if passed_s < NOTE_AFTER_S:
            return ""
        text = "preparing the scene for the ray tracer ..."
        if self.live.is_compiling:
            note = compile_note.note() or "loading the ray tracer ..."
            text = " ".join((note, compile_note.progress())).strip()
        return f"{text} ({passed_s:.0f} s)"

    # Single pixels.

    def depth_at(self, state: AppState, pixel: tuple[int, int]) -> float | None:
        """Return the ray parameter at (row, column); None if nothing is hit, or it is unknown."""
        frame = self._frame_with(state, pixel)
        depth = float(frame.channel("depth")[pixel]) if frame is not None else math.inf
        return depth if math.isfinite(depth) else None

    def object_at(self, state: AppState, pixel: tuple[int, int]) -> int | None:
        """Return the number of the object at (row, column); None for the background.

        A ray is cast into the scene if no finished image has the answer.
        """
        frame = self._frame_with(state, pixel)
        if frame is None:
            ray = self.camera(state).ray(*pixel, self.size)
            return object_on_ray(state.scene, ray.origin, ray.direction)
        number = int(frame.channel("id")[pixel])
        return number if number >= 0 else None

    def seen_at(self, state: AppState, pixel: tuple[int, int]) -> str:
        """Return the object at (row, column) as text, from the ray image or, if that is hidden,
        from the raster image; empty if unknown.
        """
        found = self._hit_at(state, pixel)
        if found is None:
            return ""
        number, depth = found
        if number < 0:
            way = self.camera(state).ray(*pixel, self.size).direction
            return "background" if math.isfinite(way[0]) else "outside of the lens"
        return f"{state.scene.objects[number].name or f'object {number}'}, t = {depth:.4g}"

    def _hit_at(self, state: AppState, pixel: tuple[int, int]) -> tuple[int, float] | None:
        """Return the object's number at (row, column), -1 for none, and the ray parameter."""
        if self._tracing:
            frame = self._frame_with(state, pixel)
            if frame is None:
                return None
            return int(frame.channel("id")[pixel]), float(frame.channel("depth")[pixel])
        (row, column), request = pixel, self.request(state)
        if self._moving or request is None or not self._begun.sees_raster:
            return None
        if row >= request.size[1] or column >= request.size[0]:
            return None
        here = row, column, row + 1, column + 1
        read = self._raster_values(request, ("id", "depth"), here)
        return (int(read["id"][0, 0]), float(read["depth"][0, 0])) if read is not None else None

    def _full_ray(self, state: AppState) -> RayImage | None:
        """Return the ray image of this state if it is full."""
        image = self.ray_image
        is_full = image is not None and image.factor == 1 and image.request == self.request(state)
        return image if is_full else None

    def _to_compare(self, state: AppState) -> bool:
        image = self._full_ray(state)
        return image is not None and self.agreement.compared != image.request

    def _compare(self, state: AppState) -> None:
        image = self._full_ray(state)
        assert image is not None
        try:
            raster = self._begun.raster.read_back(image.request)
            if raster is not None:  # it is None while a lens's table is being made
                self.agreement.submit(image, raster)
        except FAILURES as error:
            self.agreement.fail(image.request, error)

    def _frame_with(self, state: AppState, pixel: tuple[int, int]) -> Frame | None:
        image = self._full_ray(state)
        if image is None or pixel[0] >= image.frame.size[1] or pixel[1] >= image.frame.size[0]:
            return None
        return image.frame


def look_of(options: ImageOptions) -> Look:
    """Return the look of both images."""
    return Look(
        "depth" if options.channel == "z" else options.channel,
        options.exposure_ev,
        options.transfer,
        options.dissolved,
    )
