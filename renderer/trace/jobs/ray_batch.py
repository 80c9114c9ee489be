"""A batch of rays on a Tracer's thread: requested, traced, finished."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from renderer.errors import LucidaError


class RayBatch:
    """A task for a Tracer's thread, like Task.

    method: the engine's, such as "closest_hits".
    """

    def __init__(
        self, method: str, origins: ArrayLike, directions: ArrayLike, t_min: float, t_max: float
    ) -> None:
        vectors = (
            _vectors("origins", origins, _exact(origins)),
            _vectors("directions", directions, np.float32),
        )
        self._call = method, vectors
        self._limits = float(t_min), float(t_max)
        self.finished = threading.Event()
        self._answer: Any = None
        self._error: BaseException | None = None
        origins, directions = vectors
        if len(origins) != len(directions):
            problem = f"are {len(directions)}"
            raise LucidaError("directions", problem, f"give {len(origins)}: one a ray")

    @property
    def kernel(self) -> tuple[str, str]:
        """The key of the kernel that it needs: the method, and the dtype of the origins."""
        method, (origins, _) = self._call
        return method, origins.dtype.name

    def run(self, engine: Any) -> None:
        """Trace the rays, unless cancelled before. Called once, by the Tracer's thread."""
        if self.finished.is_set():
            return
        method, rays = self._call
        self._answer = getattr(engine, method)(*rays, *self._limits)
        self.finished.set()

    def fail(self, error: BaseException) -> None:
        """End the batch with an error, which result() raises."""
        self._error = error
        self.finished.set()

    def stop(self) -> None:
        """Do nothing: a running batch is always finished, since it takes no longer than an
        image.
        """

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


def _exact(value: ArrayLike) -> type:
    """Return float64, which is exact for a scene anywhere; or float32 if the values are float32
    already.
    """
    return np.float32 if getattr(value, "dtype", None) == np.float32 else np.float64


def _vectors(name: str, value: ArrayLike, dtype: type) -> np.ndarray:
    """Return contiguous numbers (n, 3). Raises LucidaError."""
    try:
        with np.errstate(over="ignore"):
            array: np.ndarray = np.ascontiguousarray(value, dtype)
    except (TypeError, ValueError):
        raise LucidaError(name, "is not an array of numbers", "give n x 3 numbers") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise LucidaError(name, f"has shape {array.shape}", "give n x 3 numbers")
    return array
