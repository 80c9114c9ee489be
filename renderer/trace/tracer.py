"""The ray tracer, which draws scenes in image order, on all processors.

This is the user's interface, for images at once or in the background. worker.py does the work.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Iterable
from functools import partial
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.camera.camera import Camera, check_camera
from lucida.renderer.images.frame import Frame, check_channels, check_size
from lucida.renderer.images.samples import check_samples, supersampled
from lucida.renderer.scene.model import Scene, check_scene
from lucida.renderer.system.errors import LucidaError

from .arguments.buffers import Buffers
from .arguments.image import Rows
from .image_job import Task, TraceJob
from .ray_batch import RayBatch
from .threads.thread_pool import check_threads
from .worker import Worker

DEFAULT_CHANNELS = ("color", "depth", "normal", "id")
METHODS = ("packets", "reference")
MOST_BOUNCES = 16
POLL_S = 0.03  # between two progress reports


class Tracer:
    """A ray tracer that draws images of one scene by tracing each pixel's viewing ray.

    threads: the number that trace an image together; None for the number of processors. method:
    "packets" traces squares of pixels together, in float32 and with SIMD. "reference" traces one
    ray after another, in float64, tens of times slower, with code that reads like the lecture.
    shadows: objects cast shadows. mirror_depth: the number of reflections of a viewing ray, by the
    materials' specular colours. Both are off by default, so that the two renderers agree, because
    only ray tracing has them. They need method "packets". The first image takes longer, because the
    scene is prepared and, once per installation, the kernels are compiled in some seconds. Several
    Tracers may work at once; one Tracer's jobs run one after another, in the order of their start.
    Thread-safe. Raises LucidaError if `scene` is not a Scene, for an invalid number of threads or
    bounces, and for an unknown method.
    """

    def __init__(
        self,
        scene: Scene,
        threads: int | None = None,
        method: str = METHODS[0],
        shadows: bool = False,
        mirror_depth: int = 0,
    ) -> None:
        _check_method(method, shadows, mirror_depth)
        self._scene, self._scenes = check_scene(scene), 1
        self.threads = check_threads(threads)
        self.method = method
        self.shadows, self.mirror_depth = bool(shadows), mirror_depth
        self._worker = Worker(self.threads, method, self.shadows, mirror_depth)
        self._buffers = Buffers()
        weakref.finalize(self, self._worker.abandon)

    @property
    def scene(self) -> Scene:
        """The scene of the next image."""
        return self._scene

    @property
    def scenes(self) -> int:
        """The number of scenes set so far. If it has changed, results obtained meanwhile may belong
        to either scene.
        """
        return self._scenes

    @property
    def is_compiling(self) -> bool:
        """True while a job waits for kernels to be compiled, once per installation."""
        return self._worker.is_compiling

    def set_scene(self, scene: Scene) -> None:
        """Set the scene of the images started from now on.

        If only transforms, materials and lights differ from the last scene, only these are prepared
        again, in milliseconds. Meshes are the same if they share their arrays, as after
        dataclasses.replace(mesh, transform=...).
        """
        scene = check_scene(scene)
        self._scenes += 1  # before the change, so that an equal number means an equal scene
        self._scene = scene

    def render(
        self,
        camera: Camera,
        size: Iterable[int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
        samples: int = 1,
        progress: Callable[[float], None] | None = None,
        rows: tuple[int, int] | None = None,
    ) -> Frame:
        """Trace an image of (width, height) pixels. Return it when it is complete.

        channels: see Frame. samples: rays per pixel for the colour, 1, 4, 9 ... 64 (samples.py).
        progress: called on this thread with the finished part, rising from 0 to 1. An exception in
        it, or a KeyboardInterrupt, cancels the work and is passed on. rows:
        return only rows[0] up to, not including, rows[1], of an image that may be too large for
        memory; their bits are those of the whole image if rows[0] is a multiple of 32. Raises
        LucidaError for invalid cameras, channels, sizes, samples and rows.
        """
        check_camera(camera)
        size, channels = check_size(size, rows), check_channels(channels)
        draw = partial(self._render, rows)
        return supersampled(draw, camera, size, channels, check_samples(samples), progress)

    def start(
        self,
        camera: Camera,
        size: Iterable[int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
        rows: tuple[int, int] | None = None,
    ) -> TraceJob:
        """Start an image in the background and return at once; arguments as in render().

        Earlier jobs come first, so cancel those that are no longer needed.
        """
        scene = self._scene
        check_camera(camera)
        size, channels = check_size(size, rows), check_channels(channels)
        if rows is not None and self.method != METHODS[0]:
            raise LucidaError("rows", f"{self.method!r} has none", f"use {METHODS[0]!r}")
        seen = Rows(size, *(rows or (0, size[1])))
        task = Task(camera, seen, channels, scene.background, self._buffers)
        self._worker.submit(scene, task)
        return TraceJob(task, self)

    def closest_hits(
        self, origins: ArrayLike, directions: ArrayLike, t_min: float = 0.0, t_max: float = math.inf
    ) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Return (t, primitive) of the closest hit along each of n rays; inf and -1 if there is
        none.

        origins, directions: (n, 3), world space; directions of any length. t: float32 (n,), in
        units of the direction, t_min < t < t_max. primitive: int32 (n,), as in Frame. Arithmetic is
        float32. Raises LucidaError for other shapes, and if the method is not "packets".
        """
        return self._batch("closest_hits", origins, directions, t_min, t_max)

    def shaded(
        self, origins: ArrayLike, directions: ArrayLike, t_min: float = 0.0, t_max: float = math.inf
    ) -> NDArray[np.float32]:
        """Return linear light, float32 (n, 3), along each of n rays, shaded like an image without
        shadows and mirrors; see closest_hits().

        A ray that is not finite, or has no direction, gets the background.
        """
        return self._batch("shaded", origins, directions, t_min, t_max)

    def _batch(self, name: str, *rays: Any) -> Any:
        if self.method != "packets":
            raise LucidaError(
                "method", f"{self.method!r} takes no batches of rays", "use 'packets', the default"
            )
        batch = RayBatch(name, *rays)
        self._worker.submit(self._scene, batch)
        return batch.result()

    def close(self) -> None:
        """Cancel all jobs and wait for the threads to end. A closed Tracer starts no more.

        This takes milliseconds, unless it must wait for the compiler.
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
        rows: tuple[int, int] | None,
        camera: Camera,
        size: tuple[int, int],
        channels: tuple[str, ...],
        progress: Callable[[float], None] | None,
    ) -> Frame:
        job = self.start(camera, size, channels, rows)
        try:
            # Use timeouts, because some platforms deliver no KeyboardInterrupt while a thread
            # waits.
            while not job.wait(POLL_S):
                if progress is not None:
                    progress(job.progress)
            if progress is not None:
                progress(1.0)
        except BaseException:
            job.cancel()
            raise
        return job.result()


def _check_method(method: str, shadows: bool, mirror_depth: int) -> None:
    """Raise LucidaError for an impossible combination."""
    if method not in METHODS:
        names = " or ".join(repr(name) for name in METHODS)
        raise LucidaError("method", f"{method!r} is unknown", f"give {names}")
    is_whole = isinstance(mirror_depth, int) and not isinstance(mirror_depth, bool)
    if not is_whole or not 0 <= mirror_depth <= MOST_BOUNCES:
        problem = f"{mirror_depth!r} is not in 0 to {MOST_BOUNCES}"
        raise LucidaError("mirror_depth", problem, "give e.g. 3")
    if method != METHODS[0] and (shadows or mirror_depth):
        problem = f"{method!r} has neither shadows nor mirrors"
        raise LucidaError("method", problem, f"use {METHODS[0]!r}, the default")
