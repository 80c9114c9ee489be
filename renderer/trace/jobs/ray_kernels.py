"""Batches of rays that wait for their kernels to be compiled, while images go on.

The kernels are compiled by other processes, once per installation. Compiling takes seconds, during
which a tracer's thread would otherwise trace nothing.
"""

from __future__ import annotations

from renderer.scene.model import Scene
from renderer.trace.jobs.image_job import Task
from renderer.trace.jobs.precompile import Precompilation, part_of_rays
from renderer.trace.jobs.ray_batch import RayBatch


class RayKernels:
    """The waiting batches. Used by a single thread, a tracer's."""

    def __init__(self) -> None:
        self._compilations: dict[str, Precompilation] = {}
        self._waiting: list[tuple[Scene, RayBatch]] = []

    def keeps(self, scene: Scene, task: Task | RayBatch) -> bool:
        """Keep the task if it is a batch that must wait. Return True if it was kept; take_ready()
        returns it later.
        """
        if not isinstance(task, RayBatch) or task.finished.is_set() or self._are_there(task):
            return False
        self._waiting.append((scene, task))
        return True

    @property
    def waiting(self) -> bool:
        return bool(self._waiting)

    def take_ready(self) -> tuple[Scene, RayBatch] | None:
        """Return a batch that need not wait any longer, with its scene; None if there is none."""
        for item in self._waiting:
            if item[1].finished.is_set() or self._are_there(item[1]):
                self._waiting.remove(item)
                return item
        return None

    def end(self) -> None:
        """Cancel the waiting batches, and end their compilations."""
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
