"""Both renderers behind the window: told the state, they keep both images up to date.

Owns the images' common size, the rasterizer, the live tracer and the comparison. Knows nothing of
widgets. All methods are called in the window's thread, with its context current.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import moderngl
from numpy.typing import NDArray

from app.images.agreement import Agreement, Verdict
from app.images.picking import object_on_ray
from app.images.placement import Placement, common_pane, own_size, place
from app.images.progressive_ray import LiveTrace, RayImage
from app.images.readback import Region
from app.images.request import ImageRequest
from app.images.scene_tracer import tracer_for
from app.images.shown import Picture
from app.images.textures import ImageTextures
from app.images.underlay import Underlay
from app.images.window_rasterizer import FAILURES
from app.state.app_state import AppState
from app.state.options import ImageOptions
from app.widgets.background import lower_priority
from renderer import compile_note
from renderer.camera import Camera
from renderer.frame import LARGEST_PIXELS, LARGEST_SIDE, Frame
from renderer.nothing_hit import Reason
from renderer.raster import Look
from renderer.scene.model import View

NOTE_AFTER_S = 0.3
NEARBY_PX = 4  # by which the halves of a window may differ
IMAGE_SIZE = (640, 480)  # of the camera's image while no view shows it
STILL_S = 0.3  # comparing reads the raster image back, which may cost a frame: not while dragging


class Renderers:
    """wake: called from other threads when the window has something new to show.

    smooth: the tracer gives way to the window's frames, and both images are made coarse and in
    parts where they would hold one up; without, they are whole at once. panes_px: by name, the room
    that the images' windows have.
    """

    def __init__(self, wake: Callable[[], None], smooth: bool = True) -> None:
        self.agreement = Agreement(wake)
        begin = lower_priority if smooth else None
        self._smooth = smooth
        self.live = LiveTrace(wake, tracer_for, begin, coarse=smooth)
        self.underlay = Underlay()
        self.textures: ImageTextures | None = None
        self.ray_image: RayImage | None = None
        self.size = (0, 0)  # (width, height) of both images; (0, 0) before the first layout
        self.panes_px: dict[str, tuple[int, int]] = {}
        self._rulers_px = (0, 0)
        self._chosen: tuple[int, int] | None = None  # the resolution, in the last frame
        self._arrived_s = 0.0
        self._compared: ImageRequest | None = None
        self._raster_failed = False
        self._fitted: tuple[View, tuple[int, int], Camera] | None = None
        self._moving = False
        self._tracing = self._to_trace = (
            False  # whether a view wants the ray image: last, this frame
        )

    def begin(self, context: moderngl.Context) -> None:
        """Once, when there is a context."""
        self.textures = ImageTextures(context, self._smooth)

    def end(self) -> None:
        """Once, before the context goes."""
        self.live.close()
        self.agreement.close()
        if self.textures is not None:
            self.underlay.release()
            self.textures.release()

    # What is to be drawn.

    def fit_pane(
        self,
        name: str,
        pane_px: tuple[int, int],
        options: ImageOptions,
        rulers_px: tuple[int, int] = (0, 0),
    ) -> None:
        """Says how large the window of an image is, (width, height) in framebuffer pixels: both
        images get the size of the largest of them, or the resolution that was chosen. rulers_px:
        of the rulers beside magnified pixels, see Placement."""
        self.panes_px[name], self._rulers_px = pane_px, rulers_px
        if options.resolution is not None:
            self.size = options.resolution
            return
        pane = common_pane(list(self.panes_px.values()))
        width, height = own_size(options, pane, rulers_px if options.grid else (0, 0))
        width, height = min(width, LARGEST_SIDE), min(height, LARGEST_SIDE)
        self.size = (width, min(height, LARGEST_PIXELS // width))

    def common_room(self, pane_px: tuple[int, int]) -> tuple[int, int]:
        """The room for an image in a window: a few pixels less where another window is that much
        smaller, so that both show their images at the same size."""
        near = [
            pane
            for pane in (*self.panes_px.values(), pane_px)
            if all(abs(a - b) <= NEARBY_PX for a, b in zip(pane, pane_px, strict=True))
        ]
        return min(pane[0] for pane in near), min(pane[1] for pane in near)

    def placement(self, state: AppState) -> Placement | None:
        """Where the images stand in the smallest of their windows; None where there is none."""
        panes = self.panes_px.values()
        if not panes or not min(self.size):
            return None
        room = min(pane[0] for pane in panes), min(pane[1] for pane in panes)
        return self.placed(state.images, room)

    def placed(self, options: ImageOptions, room_px: tuple[int, int]) -> Placement:
        """Where the images stand in a room, (width, height) framebuffer pixels."""
        return place(options, self.size, room_px, self._rulers_px)

    def forget_pane(self, name: str) -> None:
        """Says that an image's window is not to be seen."""
        self.panes_px.pop(name, None)

    def camera(self, state: AppState) -> Camera:
        """The camera that both images of a state are drawn with."""
        size = self.size if min(self.size) else (1, 1)
        if self._fitted is None or self._fitted[:2] != (state.view, size):
            self._fitted = (state.view, size, state.view.for_size(size))
        return self._fitted[2]

    def request(self, state: AppState) -> ImageRequest | None:
        """The image that both renderers are to draw; None before the first layout."""
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
        )

    def trace(self, state: AppState) -> None:
        """Tells the tracer what is wanted now; call it in each frame that shows the ray image."""
        self._to_trace = True
        self._ask(state)

    def update(self, state: AppState, moving: bool) -> None:
        """Once a frame: takes what has come from the threads. moving: something is dragged."""
        assert self.textures is not None
        self._moving = moving
        self.textures.begin_frame()
        self.underlay.begin_frame()
        self._follow_resolution(state)
        self._tracing, self._to_trace = self._to_trace, False
        failed = self.raster_error is not None
        if self._raster_failed and not failed:  # it works again: what it broke is done again
            self.agreement.error, self._compared = None, None
        self._raster_failed = failed
        if self._tracing:
            self._ask(state)  # while other things are drawn, it may be there in time
        waits = moving and time.monotonic() < self._still_s
        # Not in the frame of an image's arrival, which shows it first.
        if not self._take_ray() and self._to_compare(state) and not waits:
            self._compare(state)
        self.agreement.poll()

    def _ask(self, state: AppState) -> None:
        """For the ray image; while things move, none finer than the raster image beside it."""
        if (request := self.request(state)) is not None:
            beside = self.textures.raster_seen() if self.textures is not None else None
            self.live.request(request, beside.factor if beside is not None else 1)

    def _take_ray(self) -> bool:
        """Takes the newest traced image; whether there was one."""
        image = self.live.poll()
        if image is None:
            return False
        assert self.textures is not None
        self.textures.take_ray(image)
        self.ray_image, self._arrived_s = image, time.monotonic()
        return True

    def _follow_resolution(self, state: AppState) -> None:
        """The chosen one holds where no image is to be seen too, and is forgotten with the choice.
        Images that are hidden keep their size, but not from step to step of a lecture: what a step
        shows does not depend on the one before."""
        resolution = state.images.resolution
        if resolution is not None:
            self.size = resolution
        elif not self.panes_px and (self._chosen is not None or state.step is not None):
            self.size = _unseen_size(state.images)
        self._chosen = resolution

    def need_size(self, options: ImageOptions) -> None:
        """Gives the images a size where none of them has been seen yet."""
        if not min(self.size):
            self.size = options.resolution or _unseen_size(options)

    # What is there.

    def raster_picture(
        self, state: AppState, placement: Placement, under: bool, name: str
    ) -> Picture | None:
        """What is seen of the raster image in a window, drawn anew if it must be; None where that
        failed. under: it is for the underlay. name: of the picture, see ShownImage.picture."""
        assert self.textures is not None
        request = self.request(state)
        assert request is not None
        return self.textures.raster_in(placement, request, look_of(state.images), name, under)

    def ray_picture(
        self, state: AppState, placement: Placement, under: bool, name: str
    ) -> Picture | None:
        """Likewise of the newest ray image that has arrived; None as long as that would be stale:
        of another scene, or of another size."""
        request = self.request(state)
        assert self.textures is not None
        assert request is not None
        self._take_ray()
        return self.textures.ray_in(placement, request, look_of(state.images), name, under)

    def shown_ray(self, state: AppState) -> RayImage | None:
        """The newest ray image, as long as it is not stale."""
        image = self.ray_image
        if image is None or not image.request.may_stand_in_for(self.request(state)):
            return None
        return image

    def depths(self) -> tuple[float, float] | None:
        """The ray parameters that are shown white and darkest; None where nothing is hit."""
        return self.textures.depths() if self.textures is not None else None

    def raster_values(self, state: AppState, channel: str, region: Region) -> NDArray | None:
        """A channel's values in some pixels of the raster image as it is shown; None while that
        is coarse. region: first row and column, one past the last of each."""
        request = self.request(state)
        assert self.textures is not None
        assert request is not None
        try:
            return self.textures.raster.values(request, channel, region)
        except FAILURES:  # whatever it is, drawing tells it too
            return None

    def ray_values(self, state: AppState, channel: str, region: Region) -> NDArray | None:
        """Likewise of the ray image; None where the one that is shown is coarse, or stale."""
        image = self.shown_ray(state)
        if image is None or image.factor > 1:
            return None
        top, left, bottom, right = region
        return image.shown(channel)[top:bottom, left:right]

    def unfinished(self, state: AppState) -> bool:
        """Whether coming frames have something to do that no thread will call for."""
        return self._to_compare(state) or (self.textures is not None and self.textures.unfinished)

    @property
    def busy(self) -> bool:
        """Whether the ray image is being traced, or both are being compared, on other threads."""
        return self.live.busy or self.agreement.busy

    def settled(self, state: AppState) -> bool:
        """Whether the images that are to be seen are complete, and compared if both are: nothing
        will change by itself."""
        if self.busy or self.unfinished(state):
            return False
        return not self._tracing or (self._has_full(state) and self.verdict(state) is not None)

    @property
    def is_tracing(self) -> bool:
        """Whether the ray image is to be seen, so that a verdict on both will come."""
        return self._tracing

    def verdict(self, state: AppState) -> Verdict | None:
        """Whether the images of this state agree; None until that is known."""
        return self.agreement.verdict_on(self.request(state))

    def why_black(self, state: AppState) -> Reason | None:
        """Why the images of this state show nothing, or only black; None where they do show
        something, or it is not known."""
        verdict = self.verdict(state)
        if verdict is None:
            return None
        if state.images.channel != "color":
            return verdict.darkness.reason if verdict.comparison.nothing_hit else None
        images = state.images
        return verdict.darkness.shown(images.exposure_ev, images.transfer == "linear")

    @property
    def raster_s(self) -> float:
        """What the raster image took that a view shows; 0 where none does."""
        image = self.textures.raster_seen() if self.textures is not None else None
        return self.textures.raster.time_s if self.textures is not None and image else 0.0

    @property
    def raster_factor(self) -> int:
        """How coarse the raster image is that is shown; 1: it is full, or there is none."""
        image = self.textures.raster.image if self.textures is not None else None
        return image.factor if image is not None else 1

    @property
    def raster_error(self) -> Exception | None:
        return self.textures.raster_error if self.textures else None

    @property
    def ray_error(self) -> Exception | None:
        return self.live.error or (self.textures.ray_error if self.textures else None)

    @property
    def failure(self) -> Exception | None:
        """What keeps the images from being complete and compared."""
        return self.raster_error or self.ray_error or self.agreement.error

    def retry(self) -> None:
        """Tries again what has failed."""
        if self.textures is not None:
            self.textures.retry()
        self.live.retry()
        self.agreement.error = None
        self._compared = None

    def preparing(self) -> str:
        """What the tracer does before its first image of a scene, and for how many seconds now, so
        that a long wait is seen to go on; empty if that is quick."""
        passed_s = self.live.preparing_s
        if passed_s < NOTE_AFTER_S:
            return ""
        compiles = compile_note.note() if self.live.first_ever else ""
        return f"{compiles or 'preparing the scene for the ray tracer ...'} ({passed_s:.0f} s)"

    def depth_at(self, state: AppState, pixel: tuple[int, int]) -> float | None:
        """The ray parameter seen at (row, column); None where nothing is, or it is not known."""
        frame = self._frame_with(state, pixel)
        depth = float(frame.channel("depth")[pixel]) if frame is not None else math.inf
        return depth if math.isfinite(depth) else None

    def object_at(self, state: AppState, pixel: tuple[int, int]) -> int | None:
        """The number of the object seen at (row, column); None for the background. Where no
        finished image tells it, the scene is asked."""
        frame = self._frame_with(state, pixel)
        if frame is None:
            ray = self.camera(state).ray(*pixel, self.size)
            return object_on_ray(state.scene, ray.origin, ray.direction)
        number = int(frame.channel("id")[pixel])
        return number if number >= 0 else None

    def seen_at(self, state: AppState, pixel: tuple[int, int]) -> str:
        """The object at (row, column) in words, in the ray image, or where no view shows that, in
        the raster image; empty where it is not known."""
        found = self._hit_at(state, pixel)
        if found is None:
            return ""
        number, depth = found
        if number < 0:
            return "background"
        return f"{state.scene.objects[number].name or f'object {number}'}, t = {depth:.4g}"

    def _hit_at(self, state: AppState, pixel: tuple[int, int]) -> tuple[int, float] | None:
        """The object's number at (row, column), -1 for none, and the ray parameter."""
        if self._tracing:
            frame = self._frame_with(state, pixel)
            if frame is None:
                return None
            return int(frame.channel("id")[pixel]), float(frame.channel("depth")[pixel])
        textures, request = self.textures, self.request(state)
        if self._moving or textures is None or request is None or textures.raster_seen() is None:
            return None
        try:
            return textures.raster.hit(request, pixel)
        except FAILURES:  # whatever it is, drawing reports it too
            return None

    def _has_full(self, state: AppState) -> bool:
        image = self.ray_image
        return image is not None and image.factor == 1 and image.request == self.request(state)

    def _to_compare(self, state: AppState) -> bool:
        return self._has_full(state) and self._compared != self.request(state)

    @property
    def _still_s(self) -> float:
        return self._arrived_s + STILL_S

    def _compare(self, state: AppState) -> None:
        request, image = self.request(state), self.ray_image
        assert request is not None
        assert image is not None
        assert self.textures is not None
        try:
            raster = self.textures.raster.read_back(request)
            if raster is None:  # goes on in the next frame
                return
            self.agreement.submit(image, raster)
        except FAILURES as error:
            self.agreement.error = error
        self._compared = request

    def _frame_with(self, state: AppState, pixel: tuple[int, int]) -> Frame | None:
        image = self.ray_image
        frame = image.frame if image is not None and self._has_full(state) else None
        if frame is None or pixel[0] >= frame.size[1] or pixel[1] >= frame.size[0]:
            return None
        return frame


def look_of(options: ImageOptions) -> Look:
    """How both images are shown."""
    return Look(
        options.channel, options.exposure_ev, options.transfer, options.component, options.tinted
    )


def _unseen_size(options: ImageOptions) -> tuple[int, int]:
    """(width, height) of images that no view shows."""
    width, height = (side // options.pixel_size for side in IMAGE_SIZE)
    return width, height
