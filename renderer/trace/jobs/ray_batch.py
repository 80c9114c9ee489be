"""A batch of rays on its way through a Tracer's thread: asked for, traced, finished.

Owns its states. Knows nothing of how rays are traced.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from renderer.errors import LucidaError


class RayBatch:
    """What a Tracer's thread works on, as Task is; method: of the engine, "closest_hits" or so."""

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
        """What is to be compiled for it: the method, and the dtype of the origins."""
        method, (origins, _) = self._call
        return method, origins.dtype.name

    def run(self, engine: Any) -> None:
        """Traces the rays, unless cancelled before. Called once, by the Tracer's thread."""
        if self.finished.is_set():
            return
        method, rays = self._call
        self._answer = getattr(engine, method)(*rays, *self._limits)
        self.finished.set()

    def fail(self, error: BaseException) -> None:
        """Ends the batch with an error, which result() raises."""
        self._error = error
        self.finished.set()

    def stop(self) -> None:
        """A batch at work is finished: it takes no longer than an image."""

    def cancel(self) -> None:
        """Ends a waiting batch, by an error."""
        if not self.finished.is_set():
            self.fail(LucidaError("tracer", "is closed", "make a new Tracer"))

    def result(self) -> Any:
        """The answer, once there is one."""
        self.finished.wait()
        if self._error is not None:
            raise self._error
        return self._answer


def _exact(value: ArrayLike) -> type:
    """float64, as exact as the scene is, wherever it is; what is float32 already stays so."""
    return np.float32 if getattr(value, "dtype", None) == np.float32 else np.float64


def _vectors(name: str, value: ArrayLike, dtype: type) -> np.ndarray:
    """Contiguous numbers (n, 3)."""
    try:
        array: np.ndarray = np.ascontiguousarray(value, dtype)
    except (TypeError, ValueError):
        raise LucidaError(name, "is not an array of numbers", "give n x 3 numbers") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise LucidaError(name, f"has shape {array.shape}", "give n x 3 numbers")
    return array
