"""An image in progress, from the request to its end or cancellation.

Access to a job's state is synchronised. A control array is the only link to a running kernel: it
reports progress and stops the kernel.
"""

from __future__ import annotations

import os
import threading
import time
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.frame import Frame
from lucida.renderer.system.child import check_not_forked

from .arguments.buffers import Buffers
from .arguments.image import Image, Rows, new_image, to_frame
from .threads.thread_pool import DONE, cancel, new_control


class Task:
    """A task for a Tracer's thread: waiting, then tracing, then finished. Thread-safe."""

    def __init__(
        self,
        camera: Camera,
        rows: Rows,
        channels: tuple[str, ...],
        background: tuple[float, float, float],
        buffers: Buffers,
    ) -> None:
        self.camera, self.rows, self.channels = camera, rows, channels
        self.size = rows.size[0], rows.end - rows.first
        self.finished = threading.Event()
        self._background, self._buffers = background, buffers
        self._control = new_control()
        self._pid = os.getpid()
        self._lock = threading.Lock()  # held only briefly, never while tracing
        self._tracing = False
        self._blocks = 1
        self._image: Image | None = None
        self._time_s = 0.0
        self._error: BaseException | None = None
        self._frame: Frame | None = None

    def run(self, engine: Any) -> None:
        """Trace the image, unless it was cancelled before. Called once, by the Tracer's thread.

        engine: a ReferenceEngine or a PacketEngine.
        """
        if self.finished.is_set():
            return
        image = new_image(self.size, self.channels, self._buffers)
        with self._lock:
            if self.finished.is_set():
                return
            self._image, self._blocks = image, image.finished.size
            self._tracing = True
        start_s = time.perf_counter()
        engine.trace(self.camera, image, self._control, self.rows)
        self._time_s = time.perf_counter() - start_s
        self.finished.set()

    def fail(self, error: BaseException) -> None:
        """End the task with an error, which frame() raises."""
        with self._lock:
            self._error = error
            self.finished.set()

    def stop(self) -> None:
        """Make a running or starting kernel return after the current pixel, without a lock."""
        cancel(self._control)

    def cancel(self) -> None:
        """End a waiting task at once, and stop a running one."""
        self.stop()
        if self.finished.is_set():  # frame() may hold the lock for long
            return
        with self._lock:
            if not self._tracing:
                self.finished.set()

    @property
    def progress(self) -> float:
        if self.finished.is_set():
            return 1.0
        return min(int(self._control[DONE]) / self._blocks, 1.0)

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait until finished, or for timeout_s seconds. Return True if finished.

        Raises LucidaError in a forked process, where nothing would finish the task.
        """
        if not self.finished.is_set():
            check_not_forked(self._pid, "tracer", "this image was begun")
        return self.finished.wait(timeout_s)

    def frame(self) -> Frame:
        """Return the image of a finished task."""
        with self._lock:
            if self._error is not None:
                raise self._error
            if self._frame is None:
                image = self._image or new_image(self.size, self.channels, self._buffers)
                self._frame = to_frame(image, self._background, self._time_s)
            return self._frame


class TraceJob:
    """An image requested from a Tracer. Thread-safe.

    It keeps its Tracer alive; Tracer.close() cancels it.
    """

    def __init__(self, task: Task, tracer: object) -> None:
        self._task = task
        self._tracer = tracer

    @property
    def progress(self) -> float:
        """The finished part of the image, 0 to 1, which never decreases; 1 after failure, too."""
        return self._task.progress

    @property
    def done(self) -> bool:
        """True if result() would return, or raise, at once."""
        return self._task.finished.is_set()

    def cancel(self) -> None:
        """Request the job's end, and return at once; done follows within milliseconds."""
        self._task.cancel()

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait until done, or for timeout_s seconds. Return done."""
        return self._task.wait(timeout_s)

    def result(self) -> Frame:
        """Wait until done, and return the image. If the job was cancelled early, complete is False.

        Raises the job's error: LucidaError if the scene or the image is too large.
        """
        self._task.wait()
        return self._task.frame()
