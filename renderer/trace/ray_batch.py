"""A batch of rays on a Tracer's thread: requested, traced, finished."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.system.errors import LucidaError


class RayBatch:
    """A task for a Tracer's thread, like Task.

    method: the engine's, such as "closest_hits".
    """

    def __init__(
        self, method: str, origins: ArrayLike, directions: ArrayLike, t_min: float, t_max: float
    ) -> None:
        rays = _vectors("origins", origins), _vectors("directions", directions)
        if len(rays[0]) != len(rays[1]):
            problem = f"are {len(rays[1])}"
            raise LucidaError("directions", problem, f"give {len(rays[0])}: one per ray")
        self.method, self._arguments = method, (*rays, float(t_min), float(t_max))
        self.finished = threading.Event()
        self._answer: Any = None
        self._error: BaseException | None = None

    def run(self, engine: Any) -> None:
        """Trace the rays, unless cancelled before. Called once, by the Tracer's thread."""
        if not self.finished.is_set():
            self._answer = getattr(engine, self.method)(*self._arguments)
            self.finished.set()

    def fail(self, error: BaseException) -> None:
        """End the batch with an error, which result() raises."""
        self._error = error
        self.finished.set()

    def stop(self) -> None:
        """Do nothing: a running batch always finishes, because it takes no longer than an image."""

    def cancel(self) -> None:
        """End a waiting batch, with an error."""
        if not self.finished.is_set():
            self.fail(LucidaError("tracer", "is closed", "make a new Tracer"))

    def result(self) -> Any:
        """Wait for the result, and return it."""
        self.finished.wait()
        if self._error is not None:
            raise self._error
        return self._answer


def _vectors(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return numbers (n, 3). Raises LucidaError."""
    try:
        array: NDArray[np.float64] = np.asarray(value, np.float64)
    except (TypeError, ValueError):
        raise LucidaError(name, "is not an array of numbers", "give n x 3 numbers") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise LucidaError(name, f"has shape {array.shape}", "give n x 3 numbers")
    return array
