"""The ray image of a moving camera: coarse at once, then finer, then full; then with several
samples per pixel, if requested.

The window's thread only leaves requests and takes images: it never waits for the tracer.

A change cancels a refinement in progress; a coarse image is finished (it takes a frame or two), so
that steady dragging always shows something new.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.images.request import ImageRequest
from renderer.camera import Camera
from renderer.coarseness import Coarseness, reduced
from renderer.frame import CHANNELS, Frame
from renderer.samples import Progress, supersampled
from renderer.scene.model import Scene

if TYPE_CHECKING:  # its import loads the compiler
    from renderer.trace import TraceJob, Tracer

COARSEST = 8  # image pixels a side that one traced pixel stands for
ONCE_S = 0.008  # what the first image after a rest may take, so that it comes with the next frame
COARSE_S = 0.004  # what a coarse image may take: OpenGL, and what shows it, may need the same cores
REFINE_S = 0.15  # a full image that takes longer is preceded by another coarse one
SETTLE_S = 0.04  # without a change, at most, before refining: while dragging, the cores stay free
LAUNCH_S = 4e-4  # of an image's time, what does not grow with its pixels
PATIENCE_S = 0.1  # for a coarse image, before a change cancels it too


@dataclass(frozen=True, eq=False)
class RayImage:
    """A traced image.

    factor: 1 for the full image, otherwise how much coarser each side is. frame: of the pixels'
    centres, which is compared with the raster image. mean: the colour (H, W, 3) of several samples
    per pixel, once there is one.
    """

    request: ImageRequest
    frame: Frame
    factor: int
    mean: NDArray[np.float32] | None = None

    @property
    def is_last(self) -> bool:
        """True if nothing finer will come for its request."""
        return self.factor == 1 and (self.request.samples == 1 or self.mean is not None)

    def shown(self, channel: str) -> NDArray:
        """Return a channel for display."""
        if channel == "color" and self.mean is not None:
            return self.mean
        return self.frame.channel(channel)


class LiveTrace:
    """Traces the newest request.

    wake: called on its thread when there is something new. make_tracer: returns a Tracer for a
    request; called on that thread. begin: called there first. coarse: deliver coarse images before
    a full one that takes long. Requests and polls come from one thread, the window's.
    """

    def __init__(
        self,
        wake: Callable[[], None],
        make_tracer: Callable[[ImageRequest], Tracer],
        begin: Callable[[], None] | None = None,
        coarse: bool = True,
    ) -> None:
        self._wake = wake
        self._coarse = coarse
        self.make_tracer = make_tracer
        self._begin = begin
        self._changed = threading.Condition()
        self._newest: ImageRequest | None = None
        self._begin_at = 1  # for the newest one
        self._served: ImageRequest | None = None  # the last one begun
        self._finished: ImageRequest | None = None  # the last one whose full image came, or failed
        self._arrived: RayImage | None = None
        self._job: TraceJob | None = None
        self._passes, self._passes_done = 1, 0  # of an image with several samples per pixel
        self._refining = False
        self._closed = False
        self._error: Exception | None = None
        self._began_s = 0.0
        self._ready: tuple[Scene, Tracer] | None = None
        self._thread = threading.Thread(target=self._run, name="lucida-live", daemon=True)
        self._thread.start()

    # The window's side.

    def request(self, request: ImageRequest, begin_at: int = 1) -> None:
        """Request an image. Does nothing if it is the last one requested.

        begin_at: the least factor of its first image, if coarse images are made: a finer one would
        be of no use.
        """
        with self._changed:
            if self._closed or (request == self._newest and self._has_channel(request)):
                return
            self._newest, self._begin_at = request, begin_at if self._coarse else 1
            if self._refining and self._job is not None:
                self._job.cancel()
            self._changed.notify()

    def poll(self) -> RayImage | None:
        """Return the newest image that has arrived since the last call."""
        with self._changed:
            image, self._arrived = self._arrived, None
            return image

    @property
    def busy(self) -> bool:
        """True while the newest request's full image is still to come."""
        with self._changed:
            return self._arrived is not None or self._newest is not self._finished

    @property
    def error(self) -> Exception | None:
        """The error of the newest request; a new one tries again."""
        with self._changed:
            return self._error

    def retry(self) -> None:
        """Request the newest image again if it has failed."""
        with self._changed:
            if self._error is not None and self._newest is not None:
                self._newest = replace(self._newest)  # another object: one not served yet
                self._error = None
                self._changed.notify()

    @property
    def progress(self) -> float:
        """The finished part of the image under way, 0 to 1, all its samples taken together."""
        with self._changed:
            if self._job is None and self._passes == 1:
                return 1.0
            part = 0.0 if self._job is None else self._job.progress
            return (self._passes_done + part) / self._passes

    @property
    def preparing_s(self) -> float:
        """The time that the first image of a scene has been awaited while the tracer prepares; else
        0.
        """
        with self._changed:
            return time.monotonic() - self._began_s if self._began_s else 0.0

    @property
    def is_compiling(self) -> bool:
        """True while an image waits for kernels to be compiled."""
        ready = self._ready
        return ready is not None and ready[1].is_compiling

    def tracer_of(self, scene: Scene) -> Tracer | None:
        """Return the tracer that has prepared a scene, for other rays; None until there is one.

        It moves on to the next scene when that changes, and is closed when the effects do: a late
        question is answered for the next scene, or raises an error.
        """
        ready = self._ready
        return ready[1] if ready is not None and ready[0] is scene else None

    def close(self, timeout_s: float = 2.0) -> None:
        """Cancel everything. A compilation cannot be cancelled: its daemon thread ends with the
        process.
        """
        with self._changed:
            self._closed = True
            if self._job is not None:
                self._job.cancel()
            self._changed.notify()
        self._thread.join(timeout_s)

    # Its thread's side.

    def _run(self) -> None:
        if self._begin is not None:
            self._begin()
        tracer: Tracer | None = None
        made_for: ImageRequest | None = None
        coarsest = COARSEST if self._coarse else 1
        coarseness = Coarseness(COARSE_S, ONCE_S, coarsest, coarsest)
        while (request := self._next()) is not None:
            try:
                if made_for is None or request.scene is not made_for.scene:
                    self._prepare()
                    if tracer is not None:
                        tracer.set_scene(request.scene)  # what has not changed stays prepared
                if tracer is None or not request.is_served_by(made_for):
                    self._prepare()
                    if tracer is not None:
                        tracer.close()
                    tracer = self.make_tracer(request)
                    coarseness.forget()
                made_for, self._ready = request, (request.scene, tracer)
                self._trace(tracer, request, coarseness)
            except BaseException as error:  # shown in the window, which goes on
                tracer, self._ready = None, None
                with self._changed:
                    self._job, self._refining, self._began_s = None, False, 0.0
                    self._passes, self._passes_done = 1, 0
                    self._error, self._finished = _as_exception(error), request
                self._wake()
        if tracer is not None:
            tracer.close()

    def _prepare(self) -> None:
        """Record the start of another scene or Tracer, whose first image may take long."""
        self._ready = None
        with self._changed:
            self._began_s = time.monotonic()

    def _next(self) -> ImageRequest | None:
        """Wait for a request that has not been served. Return None after close()."""
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self._newest is not self._served)
            if self._closed:
                return None
            self._served, self._error = self._newest, None
            return self._newest

    def _trace(self, tracer: Tracer, request: ImageRequest, coarseness: Coarseness) -> None:
        """Trace a request's images, from coarse to full, until a newer one comes."""
        pixels = request.size[0] * request.size[1]
        factor = max(coarseness.changed(pixels, time.monotonic()), self._begin_at)
        refining = False
        while True:
            size = reduced(request.size, factor)
            job = tracer.start(
                request.camera, size, CHANNELS if factor == 1 else (request.channel,)
            )
            frame = self._finish(job, request, refining)
            with self._changed:
                self._job, self._refining = None, False
                if not frame.complete:
                    return
                self._arrived = RayImage(request, frame, factor)
                self._began_s = 0.0
                if factor == 1 and request.samples == 1:
                    self._finished = request
            self._wake()
            coarseness.measured(factor, size[0] * size[1], max(frame.time_s - LAUNCH_S, 1e-6))
            if factor == 1:
                if request.samples > 1:
                    self._supersample(tracer, request, frame)
                return
            full_s = coarseness.full_s(pixels)
            # A single change: nothing to wait for. In a motion, the next one will come soon.
            # Otherwise wait at most as long as the image takes: no longer than it can be in vain.
            rest_s = coarseness.rest_s and max(min(SETTLE_S, full_s), coarseness.rest_s)
            with self._changed:
                if self._changed.wait_for(lambda: self._is_stale(request), rest_s):
                    return
            factor = next_factor(factor, full_s)
            refining = True

    def _supersample(self, tracer: Tracer, request: ImageRequest, centres: Frame) -> None:
        """Trace the colour again with several samples per pixel, unless a newer request comes."""

        def draw(
            camera: Camera,
            size: tuple[int, int],
            channels: tuple[str, ...],
            progress: Progress | None,
        ) -> Frame:
            frame = self._finish(tracer.start(camera, size, channels), request, refining=True)
            with self._changed:
                self._job, self._passes_done = None, self._passes_done + 1
            return frame

        with self._changed:
            self._passes = request.samples
        of_all = supersampled(draw, request.camera, request.size, ("color",), request.samples)
        with self._changed:
            self._job, self._refining = None, False
            self._passes, self._passes_done = 1, 0
            if not of_all.complete:
                return
            self._arrived = RayImage(request, centres, 1, of_all.color)
            self._finished = request
        self._wake()

    def _finish(self, job: TraceJob, request: ImageRequest, refining: bool) -> Frame:
        """Wait for a job's end. A newer request cancels it; a coarse one only after a while."""
        with self._changed:
            self._job, self._refining = job, refining
            stale = refining and self._is_stale(request)
        if not stale and not job.wait(PATIENCE_S):
            with self._changed:
                self._refining = True  # from now on request() cancels this one too
                stale = self._is_stale(request)
        if stale:
            job.cancel()
        return job.result()

    def _has_channel(self, request: ImageRequest) -> bool:
        """Return True if the newest request, or its full image, has this request's channel."""
        newest = self._newest
        return newest is None or newest is self._finished or newest.channel == request.channel

    def _is_stale(self, request: ImageRequest) -> bool:
        return self._closed or self._newest is not request


def _as_exception(error: BaseException) -> Exception:
    """Return the exception for the window; a thread that is asked to end goes on like any that
    fails.
    """
    return error if isinstance(error, Exception) else RuntimeError(f"ended by {error!r}")


def next_factor(factor: int, full_s: float) -> int:
    """Return the factor after a coarse image: the full one if that is quick, else one 4 times as
    fine.
    """
    if full_s <= REFINE_S:
        return 1
    return max(factor // 4, 1)
