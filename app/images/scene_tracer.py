"""Tracers in this process, for the window's images and for other rays on background threads.

Other rays use the window's tracer if it has prepared their scene, or else another tracer. The
window's may change to another scene at any moment. The tracer is imported on first use, because
that loads the compiler.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from lucida.renderer.scene.model import Scene

from .request import MIRROR_DEPTH, ImageRequest

if TYPE_CHECKING:
    from lucida.renderer.trace import Tracer

T = TypeVar("T")


def tracer_for(request: ImageRequest) -> Tracer:
    """Return a new tracer for a request. Call this on the tracing thread."""
    from lucida.renderer.trace import Tracer

    mirror_depth = MIRROR_DEPTH if request.mirrors else 0
    return Tracer(request.scene, shadows=request.shadows, mirror_depth=mirror_depth)


class UnwantedError(Exception):
    """A newer result was requested, or the tracer has changed to another scene."""


def of_scene(tracer: Any, scene: Scene, work: Callable[[], T]) -> T:
    """Return the result of work() with a tracer, if all of it is in this scene.

    Raises UnwantedError if the tracer has changed scenes meanwhile, even if it has come back,
    because its hits may not be part of this scene.
    """
    number = tracer.scenes

    def is_same() -> bool:
        return tracer.scene is scene and tracer.scenes == number

    if not is_same():
        raise UnwantedError
    try:
        found = work()
    except Exception:
        if is_same():
            raise
        raise UnwantedError from None
    if not is_same():
        raise UnwantedError
    return found


class SceneTracer:
    """A tracer for one thread; only close() may be called from others."""

    def __init__(self) -> None:
        self._own: tuple[Scene, Any] | None = None

    def of(self, scene: Scene, ready: Any | None) -> Any:
        """Return a Tracer of the scene. ready: the window's; None if it has none."""
        if ready is not None:
            self.close()
            return ready
        if self._own is None or self._own[0] is not scene:
            from lucida.renderer.trace import Tracer

            self.close()
            self._own = (scene, Tracer(scene))
        return self._own[1]

    def close(self) -> None:
        """Close the tracer that was made here."""
        own, self._own = self._own, None
        if own is not None:
            own[1].close()
