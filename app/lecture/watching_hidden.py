"""The part of an object that is hidden in the window's ray image, updated while it is moved.

A thread counts the pixels that are visible without the moved object.
"""

from __future__ import annotations

from collections.abc import Callable

from lucida.app.images.progressive_ray import RayImage
from lucida.app.state.kept_lecture import Judgement
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera

from .hidden_pixels import ids_seen
from .hiding import HideExercise

Counted = tuple[HideExercise, Camera, tuple[int, int]]  # the image whose pixels were counted


class HiddenWatch:
    """The replies to a hiding exercise, for the window's thread. wake: called for a new reply."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._counting: Background[tuple[Counted, int]] = Background("lucida-hidden", wake)
        self._task: HideExercise | None = None
        self._before: RayImage | None = None  # the one when the exercise began
        self._alone: tuple[Counted, int] | None = None
        self.said: tuple[RayImage | None, Judgement | None] = (None, None)

    @property
    def busy(self) -> bool:
        """True until the reply is known."""
        return self._counting.busy

    def close(self) -> None:
        self._counting.close()

    def judgement(self, host: Host, task: HideExercise) -> Judgement | None:
        """Return the reply to the scene of the newest full ray image; None before the first.

        Call this once a frame, because it requests the ray image.
        """
        host.renderers.trace(host.state)
        image = host.renderers.ray_image
        if task is not self._task:
            self._task, self._before = task, image
            self.said = None, None
        self._take_count()
        if image is None or image.factor > 1 or image is self.said[0]:
            return self.said[1]
        request = image.request
        if image is self._before and request.scene is not host.state.scene:
            return None  # from the previous step
        if task.camera_moved(request.camera, request.size):
            self.said = image, task.when_moved
        elif (alone := self._without(task, request.camera, request.size)) is not None:
            ids = image.frame.channel("id")
            self.said = image, task.check(request.scene, ids, alone)
        return self.said[1]

    def _without(self, task: HideExercise, camera: Camera, size: tuple[int, int]) -> int | None:
        """Return the number of pixels that show the hidden object without the other; None until
        counted.
        """
        wanted = task, camera, size
        self._counting.ask(_counted, wanted)
        return self._alone[1] if self._alone is not None and self._alone[0] == wanted else None

    def _take_count(self) -> None:
        outcome = self._counting.poll()
        if outcome is not None:
            self._alone = outcome.value  # None if it failed; the image then fails, too


def _counted(wanted: Counted) -> tuple[Counted, int]:
    task, camera, size = wanted
    return wanted, task.pixels(task.without, ids_seen(task.without, camera, size))
