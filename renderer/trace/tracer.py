"""The ray tracer: draws scenes in image order, on all processors.

Owns what its user sees: images made at once, or in the background. The work is worker.py's.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable
from types import TracebackType

from renderer.camera import Camera
from renderer.frame import Frame, check_channels, check_size
from renderer.samples import check_samples, supersampled
from renderer.scene.model import Scene
from renderer.trace.jobs import Task, TraceJob
from renderer.trace.team import check_threads
from renderer.trace.worker import Worker

DEFAULT_CHANNELS = ("color", "depth", "normal", "id")
POLL_S = 0.03  # between two reports of progress


class Tracer:
    """Draws images of one scene by tracing each pixel's viewing ray.

    threads: how many trace an image together; None: as many as this process has processors.
    The first image takes longer: the scene is prepared then and, once for each installation, the
    kernels are compiled, some seconds. Several Tracers may work at once; the jobs of one are done
    one after another, in the order of their start. All methods may be called from any thread.
    Raises LucidaError for a bad number of threads.
    """

    def __init__(self, scene: Scene, threads: int | None = None) -> None:
        self.scene = scene
        self.threads = check_threads(threads)
        self._worker = Worker(scene, self.threads)
        weakref.finalize(self, self._worker.abandon)

    def render(
        self,
        camera: Camera,
        size: Iterable[int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
        samples: int = 1,
        progress: Callable[[float], None] | None = None,
    ) -> Frame:
        """An image of (width, height) pixels; returns when it is complete.

        channels: see Frame. samples: rays a pixel for the colour, 1, 4, 9 ... 64 (samples.py).
        progress: called from this thread with the finished part, rising from 0 to 1. An exception
        in the meantime, from progress or a KeyboardInterrupt, cancels the work and comes through.
        Raises LucidaError for channels, sizes and samples that cannot be.
        """
        size, channels = check_size(size), check_channels(channels)
        return supersampled(self._render, camera, size, channels, check_samples(samples), progress)

    def start(
        self,
        camera: Camera,
        size: Iterable[int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
    ) -> TraceJob:
        """Begins an image in the background and returns at once; arguments as for render.

        Jobs begun before come first: cancel those that are no longer wanted.
        """
        task = Task(camera, check_size(size), check_channels(channels), self.scene.background)
        self._worker.submit(task)
        return TraceJob(task, self)

    def close(self) -> None:
        """Cancels all jobs and waits for the threads to end. A closed Tracer starts no more.

        Milliseconds, unless kernels are being compiled: then until the compiler is done.
        """
        self._worker.close()
        self._worker.join()

    def __enter__(self) -> Tracer:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _render(
        self,
        camera: Camera,
        size: tuple[int, int],
        channels: tuple[str, ...],
        progress: Callable[[float], None] | None,
    ) -> Frame:
        job = self.start(camera, size, channels)
        try:
            # By timeouts: some platforms deliver no KeyboardInterrupt while a thread waits.
            while not job.wait(POLL_S):
                if progress is not None:
                    progress(job.progress)
            if progress is not None:
                progress(1.0)
        except BaseException:
            job.cancel()
            raise
        return job.result()
