"""A Tracer for rays of one's own, in a thread: the window's while it has prepared the scene, else
one that is made here.

Imports the tracer when it makes one: that loads the compiler.
"""

from __future__ import annotations

from typing import Any

from renderer.scene.model import Scene


class SceneTracer:
    """Used in one thread, but for close()."""

    def __init__(self) -> None:
        self._own: tuple[Scene, Any] | None = None

    def of(self, scene: Scene, ready: Any | None) -> Any:
        """A Tracer of the scene. ready: the window's, None where it has none."""
        if ready is not None:
            self.close()
            return ready
        if self._own is None or self._own[0] is not scene:
            from renderer.trace import Tracer

            self.close()
            self._own = (scene, Tracer(scene))
        return self._own[1]

    def close(self) -> None:
        """Ends the one that was made here."""
        own, self._own = self._own, None
        if own is not None:
            own[1].close()
