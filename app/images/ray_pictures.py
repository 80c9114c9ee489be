"""Pictures of a scene along any rays, such as those of a wrong program, made in the background."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Hashable
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.ui.background import Background
from lucida.renderer.editing.documents import are_versions
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .progressive_ray import LiveTrace
from .scene_tracer import SceneTracer, UnwantedError, of_scene

T = TypeVar("T")
Range = tuple[float, float]
EVERYWHERE: Range = (0.0, math.inf)
_Question = tuple[Hashable, Scene]  # compared by identity
_Answer = tuple[_Question, T | None, Exception | None]  # neither if abandoned
AT_ONCE = 1 << 14  # rays per job; other jobs can run in between
PATIENCE_S = 0.15  # faster pictures appear despite newer requests, as in motion


class RayPainter:
    """The rays of one scene, on the thread that makes the pictures."""

    def __init__(self, scene: Scene, tracer: Any, is_wanted: Callable[[], bool]) -> None:
        self._scene, self.tracer, self._is_wanted = scene, tracer, is_wanted

    def picture(
        self, origins: ArrayLike, directions: ArrayLike, t_range: Range = EVERYWHERE
    ) -> NDArray[np.float32]:
        """Return linear light (H, W, 3) along rays, without shadows and mirrors.

        origins, directions: (H, W, 3), broadcast together. t_range: limits of the hits. Raises
        UnwantedError; let it through.
        """
        start, way = np.broadcast_arrays(origins, directions)
        start, way = start.reshape(-1, 3), way.reshape(-1, 3)
        light = np.empty(start.shape, np.float32)

        def traced() -> None:
            for first in range(0, len(start), AT_ONCE):
                if not self._is_wanted():
                    raise UnwantedError
                part = slice(first, first + AT_ONCE)
                light[part] = self.tracer.shaded(start[part], way[part], *t_range)

        of_scene(self.tracer, self._scene, traced)
        return light.reshape(np.broadcast_shapes(np.shape(origins), np.shape(directions)))

    def hits(
        self, origins: ArrayLike, directions: ArrayLike, t_range: Range = EVERYWHERE
    ) -> NDArray[np.float32]:
        """Return the t (n,) at which rays (n, 3) end, in units of their directions; inf for no hit.

        Raises UnwantedError.
        """
        tracer = self.tracer
        return of_scene(
            tracer, self._scene, lambda: tracer.closest_hits(origins, directions, *t_range)[0]
        )


class RayPictures(Generic[T]):
    """A maker of pictures on its own thread; a newer request replaces a waiting one.

    wake: called on that thread when a picture is ready. error: of the newest request. The window's
    thread uses it.
    """

    def __init__(self, name: str, wake: Callable[[], None]) -> None:
        self._background: Background[_Answer[T]] = Background(name, wake)
        self.tracer = SceneTracer()
        self._newest: _Question | None = None
        self._waits = False  # for the window's tracer
        self._made: T | None = None
        self.error: Exception | None = None

    def follow(
        self, key: Hashable, scene: Scene, live: LiveTrace, make: Callable[[RayPainter], T]
    ) -> T | None:
        """Return the scene's last picture, until a newer one is ready; None before the first.

        Call this once a frame. key: the inputs of `make` except the scene; nothing is made again
        while both stay the same. make: called on the thread.
        """
        self._poll()
        newest = self._newest
        if newest is not None and not are_versions(newest[1], scene):
            self._made = None  # stale, of another scene
        if newest is None or newest[0] != key or newest[1] is not scene:
            tracer = live.tracer_of(scene)
            # Wait for a tracer that is being prepared, since two would take twice the memory.
            self._waits = tracer is None and live.preparing_s > 0
            if not self._waits:
                question = self._newest = key, scene
                self.error = None
                self._background.submit(lambda: self._make(question, tracer, make))
        return self._made

    @property
    def busy(self) -> bool:
        """True while the last request is wanted and has no picture."""
        return self._waits or (self._newest is not None and self._background.busy)

    def forget(self) -> None:
        """Drop all pictures, also those in progress, because no view shows them."""
        self._newest, self._waits, self._made, self.error = None, False, None, None

    def close(self) -> None:
        self._newest = None
        self._background.close()
        self.tracer.close()

    def _poll(self) -> None:
        outcome = self._background.poll()
        if outcome is None or self._newest is None:
            return
        assert outcome.value is not None
        question, made, error = outcome.value
        if made is not None:
            if are_versions(question[1], self._newest[1]):
                self._made = made
        elif question is self._newest:
            self.error = error
            if error is None:
                self._newest = None  # the tracer has another scene now, so request again

    def _make(
        self, question: _Question, tracer: Any | None, make: Callable[[RayPainter], T]
    ) -> _Answer[T]:
        end_s = time.monotonic() + PATIENCE_S

        def is_wanted() -> bool:
            newest = self._newest
            return newest is question or (newest is not None and time.monotonic() < end_s)

        scene = question[1]
        try:
            painter = RayPainter(scene, self.tracer.of(scene, tracer), is_wanted)
            return question, make(painter), None
        except UnwantedError:
            return question, None, None
        except Exception as error:
            # The window may have closed the tracer meanwhile.
            is_gone = isinstance(error, LucidaError) and error.field == "tracer"
            return question, None, None if is_gone else error
