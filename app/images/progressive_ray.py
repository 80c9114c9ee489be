"""The ray image of a moving camera, and then, if requested, with several samples per pixel.

The window's thread only requests and collects images, and never waits for the tracer.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.coarseness import reduced
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.images.samples import Progress, supersampled
from lucida.renderer.scene.model import Scene

from .request import ImageRequest

if TYPE_CHECKING:  # this import loads the compiler
    from lucida.renderer.trace import TraceJob, Tracer

# The time that an image may still take after a newer request. Coarse images have more, so that
# steady dragging always shows something new.
FULL_PATIENCE_S, COARSE_PATIENCE_S = 0.03, 0.1

Wanted = tuple[ImageRequest, int]  # a request and its factor, compared by identity


@dataclass(frozen=True, eq=False)
class RayImage:
    """A traced image.

    factor: the coarseness, 1 for the full image. frame: of the pixels' centres, which is compared
    with the raster image. mean: the colour (H, W, 3) of several samples per pixel, once there is
    one.
    """

    request: ImageRequest
    frame: Frame
    factor: int
    mean: NDArray[np.float32] | None = None

    def is_beside(self, raster: ImageRequest) -> bool:
        """Return True if it has the camera of a request, whose raster image may be next to it."""
        mine = self.request
        return mine.may_stand_in_for(raster) and mine.camera == raster.camera

    def shown(self, channel: str) -> NDArray:
        """Return a channel for display."""
        if channel == "color" and self.mean is not None:
            return self.mean
        if channel == "z":
            z = self.request.camera.z_from_t(self.frame.channel("depth"), self.frame.size)
            return z.astype(np.float32)
        return self.frame.channel(channel)


class LiveTrace:
    """A thread that traces the newest request.

    wake: called on the thread for each new result. make_tracer: returns a Tracer for a request;
    called on the thread. begin: called on it first. Only the window's thread requests and polls.
    """

    def __init__(
        self,
        wake: Callable[[], None],
        make_tracer: Callable[[ImageRequest], Tracer],
        begin: Callable[[], None] | None = None,
    ) -> None:
        self._wake = wake
        self.make_tracer = make_tracer
        self._begin = begin
        self._changed = threading.Condition()
        self._newest: Wanted | None = None
        self._served: Wanted | None = None  # the last request begun
        self._finished: Wanted | None = None  # the last request that has an image or an error
        self._arrived: RayImage | None = None
        self._job: TraceJob | None = None
        self._cancels = False  # whether a newer request cancels the job at once
        self._closed = False
        self._error: Exception | None = None
        self._began_s = 0.0
        self._ready: tuple[Scene, Tracer] | None = None
        self._thread = threading.Thread(target=self._run, name="lucida-live", daemon=True)
        self._thread.start()

    # The window's side.

    def request(self, request: ImageRequest, factor: int = 1) -> None:
        """Request an image, `factor` times coarser, unless it was requested last."""
        with self._changed:
            if self._closed or (request, factor) == self._newest:
                return
            self._newest = request, factor
            if self._cancels and self._job is not None:
                self._job.cancel()
            self._changed.notify()

    def poll(self) -> RayImage | None:
        """Return the newest image that has arrived since the last call."""
        with self._changed:
            image, self._arrived = self._arrived, None
            return image

    @property
    def busy(self) -> bool:
        """True until the newest request's image is ready."""
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
                self._newest = self._newest[0], self._newest[1]  # a new tuple counts as not served
                self._error = None
                self._changed.notify()

    @property
    def preparing_s(self) -> float:
        """The time since the tracer began to prepare a scene's first image; 0 otherwise."""
        with self._changed:
            return time.monotonic() - self._began_s if self._began_s else 0.0

    @property
    def is_compiling(self) -> bool:
        """True while an image waits for kernels to be compiled."""
        ready = self._ready
        return ready is not None and ready[1].is_compiling

    def tracer_of(self, scene: Scene) -> Tracer | None:
        """Return the tracer that has prepared a scene, for other rays; None until there is one.

        The tracer switches to the next scene, and is closed if the effects change. A late query is
        answered for the next scene, or raises an error.
        """
        ready = self._ready
        return ready[1] if ready is not None and ready[0] is scene else None

    def close(self, timeout_s: float = 2.0) -> None:
        """Cancel all work. A compilation cannot be cancelled; its daemon thread ends with the
        process.
        """
        with self._changed:
            self._closed = True
            if self._job is not None:
                self._job.cancel()
            self._changed.notify()
        self._thread.join(timeout_s)

    # The thread's side.

    def _run(self) -> None:
        if self._begin is not None:
            self._begin()
        tracer: Tracer | None = None
        made_for: ImageRequest | None = None
        while (wanted := self._next()) is not None:
            request, _ = wanted
            try:
                if made_for is None or request.scene is not made_for.scene:
                    self._prepare()
                    if tracer is not None:
                        tracer.set_scene(request.scene)  # unchanged parts stay prepared
                if tracer is None or not request.is_served_by(made_for):
                    self._prepare()
                    if tracer is not None:
                        tracer.close()
                    tracer = self.make_tracer(request)
                made_for, self._ready = request, (request.scene, tracer)
                self._trace(tracer, wanted)
            except BaseException as error:  # the window shows it, and continues
                tracer, self._ready = None, None
                with self._changed:
                    self._job, self._began_s = None, 0.0
                    self._error, self._finished = _as_exception(error), wanted
                self._wake()
        if tracer is not None:
            tracer.close()

    def _prepare(self) -> None:
        """Record the start of a new scene or Tracer, whose first image may take long."""
        self._ready = None
        with self._changed:
            self._began_s = time.monotonic()

    def _next(self) -> Wanted | None:
        """Wait for a request that has not been served. Return None after close()."""
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self._newest is not self._served)
            if self._closed:
                return None
            self._served, self._error = self._newest, None
            return self._newest

    def _trace(self, tracer: Tracer, wanted: Wanted) -> None:
        """Trace an image, unless a newer request arrives that does not wait for it."""
        request, factor = wanted
        job = tracer.start(request.camera, reduced(request.size, factor), CHANNELS)
        patience_s = FULL_PATIENCE_S if factor == 1 else COARSE_PATIENCE_S
        frame = self._finish(job, wanted, patience_s)
        with self._changed:
            self._job = None
            if not frame.complete:
                return
            self._arrived = RayImage(request, frame, factor)
            self._began_s = 0.0
            if request.samples == 1:
                self._finished = wanted
        self._wake()
        if request.samples > 1:
            self._supersample(tracer, wanted, frame)

    def _supersample(self, tracer: Tracer, wanted: Wanted, centres: Frame) -> None:
        """Trace the colour again with several samples per pixel, unless a newer request arrives."""
        request, _ = wanted

        def draw(
            camera: Camera,
            size: tuple[int, int],
            channels: tuple[str, ...],
            progress: Progress | None,
        ) -> Frame:
            return self._finish(tracer.start(camera, size, channels), wanted, 0.0)

        of_all = supersampled(draw, request.camera, request.size, ("color",), request.samples)
        with self._changed:
            self._job = None
            if not of_all.complete:
                return
            self._arrived = RayImage(request, centres, 1, of_all.color)
            self._finished = wanted
        self._wake()

    def _finish(self, job: TraceJob, wanted: Wanted, patience_s: float) -> Frame:
        """Wait for a job's end. A newer request cancels it after patience_s."""
        with self._changed:
            self._job, self._cancels = job, not patience_s
        if not patience_s or not job.wait(patience_s):
            with self._changed:
                self._cancels = True  # from now on request() cancels it
                if self._is_stale(wanted):
                    job.cancel()
        return job.result()

    def _is_stale(self, wanted: Wanted) -> bool:
        return self._closed or self._newest is not wanted


def _as_exception(error: BaseException) -> Exception:
    """Return the exception for the window. SystemExit and its like count as failures, too."""
    return error if isinstance(error, Exception) else RuntimeError(f"ended by {error!r}")
