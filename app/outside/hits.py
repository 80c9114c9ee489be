"""The ends of viewing rays: asked for without waiting, answered some frames later.

A thread asks a tracer, and the last answer is kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from app.images.scene_tracer import SceneTracer, UnwantedError, of_scene
from app.state.options import Pixel
from app.widgets.background import Background
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene.model import Scene

Size = tuple[int, int]


@dataclass(frozen=True)
class RayQuery:
    """Which rays: of these pixels of an image of `size`."""

    scene: Scene
    camera: Camera
    size: Size
    pixels: tuple[Pixel, ...]


@dataclass(frozen=True, eq=False)
class RayDepths:
    """t of each pixel's ray: inf where it meets nothing."""

    question: RayQuery
    t: dict[Pixel, float] = field(default_factory=dict)


class RayHits:
    """wake: called on the thread when there is an answer.

    The last answer is used until the next one comes: while a camera is dragged, its rays end where
    they ended some frames ago.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._background: Background[RayDepths] = Background("lucida-outside-rays", wake)
        self._asked: RayQuery | None = None
        self._answer: RayDepths | None = None
        self._tracer = SceneTracer()

    @property
    def busy(self) -> bool:
        return self._background.busy

    def ask(self, question: RayQuery, tracer: Any | None) -> dict[Pixel, float | None]:
        """Return t of each pixel's ray, None if it is not known yet.

        tracer: one that has prepared the scene; None to use our own.
        """
        outcome = self._background.poll()
        if outcome is not None and outcome.value is not None:
            self._answer = outcome.value
        elif outcome is not None and isinstance(outcome.error, (LucidaError, UnwantedError)):
            self._asked = None  # the tracer was closed meanwhile, or has gone on: ask the next one
        if question != self._asked and question.pixels:
            self._asked = question
            self._background.submit(lambda: self._trace(question, tracer))
        answer = self._answer
        if answer is None or answer.question.scene is not question.scene:
            return dict.fromkeys(question.pixels)
        return {pixel: answer.t.get(pixel) for pixel in question.pixels}

    def close(self) -> None:
        self._background.close()
        self._tracer.close()

    def _trace(self, question: RayQuery, tracer: Any | None) -> RayDepths:
        own = self._tracer.of(question.scene, tracer)
        return RayDepths(question, of_scene(own, question.scene, lambda: traced(question, own)))


def traced(question: RayQuery, tracer: Any) -> dict[Pixel, float]:
    """Return t of each pixel's ray, infinity if it hits nothing. Traces at once, for a thread."""
    pixels = np.array(question.pixels)
    ray = question.camera.ray(pixels[:, 0], pixels[:, 1], question.size)
    t = np.full(len(pixels), np.inf)
    seen = np.isfinite(ray.direction[:, 0])  # by the lens
    if seen.any():
        origin, direction = ray.origin[seen], ray.direction[seen]
        t[seen], _ = tracer.closest_hits(origin, direction, *question.camera.t_range)
    return dict(zip(question.pixels, t.tolist(), strict=True))
