"""Batches of rays that wait until their kernels are compiled, while images go on.

Owns the processes that compile these kernels: once for an installation, seconds in which a tracer's
thread would trace nothing. Knows nothing of how rays are traced.
"""

from __future__ import annotations

from renderer.scene.model import Scene
from renderer.trace.jobs.image_job import Task
from renderer.trace.jobs.precompile import Precompilation, part_of_rays
from renderer.trace.jobs.ray_batch import RayBatch


class RayKernels:
    """Used in one thread, a tracer's."""

    def __init__(self) -> None:
        self._compilations: dict[str, Precompilation] = {}
        self._waiting: list[tuple[Scene, RayBatch]] = []

    def keeps(self, scene: Scene, task: Task | RayBatch) -> bool:
        """Whether a task is a batch that is to wait: take_ready() gives it later."""
        if not isinstance(task, RayBatch) or task.finished.is_set() or self._are_there(task):
            return False
        self._waiting.append((scene, task))
        return True

    @property
    def waiting(self) -> bool:
        return bool(self._waiting)

    def take_ready(self) -> tuple[Scene, RayBatch] | None:
        """A batch that need not wait any longer, with its scene."""
        for item in self._waiting:
            if item[1].finished.is_set() or self._are_there(item[1]):
                self._waiting.remove(item)
                return item
        return None

    def end(self) -> None:
        """Cancels what waits, and ends what is compiled for it."""
        for _, batch in self._waiting:
            batch.cancel()
        self._waiting.clear()
        for compilation in self._compilations.values():
            compilation.end()

    def _are_there(self, batch: RayBatch) -> bool:
        part = part_of_rays(*batch.kernel)
        if part not in self._compilations:
            self._compilations[part] = Precompilation((part,))
        return self._compilations[part].is_over()
