"""The stepper's recordings of the current scene, camera and canvas, made in the background.

Older recordings are shown until the new ones are ready.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from app.stepper.loop_parts import Model
from app.stepper.recording import Order, Recording
from app.widgets.background import Background
from renderer.camera import Camera, Size
from renderer.memo import Memo, same
from renderer.scene.model import Scene

SOON_S = 0.4  # longer runs are shown while they run


@dataclass(frozen=True, eq=False)
class Pair:
    """The recordings of one canvas, in object order and in image order. begun_s: on
    time.monotonic()'s clock."""

    scene: Scene
    camera: Camera
    size: Size
    runs: dict[Order, Recording]
    begun_s: float

    @property
    def complete(self) -> bool:
        return all(run.complete or run.truncated for run in self.runs.values())

    @property
    def is_late(self) -> bool:
        return time.monotonic() - self.begun_s > SOON_S

    def is_of(self, scene: Scene, camera: Camera, size: Size) -> bool:
        return same((self.scene, self.camera, self.size), (scene, camera, size))

    def cancel(self) -> None:
        for run in self.runs.values():
            run.cancel()


class Runs:
    """The current recordings. wake: called from the thread when something is finished. error: of
    the last run that ended.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._background: Background[Pair] = Background("lucida-stepper", wake)
        self._model = Memo(_model)  # of the thread
        self._under_way: Pair | None = None
        self._shown: Pair | None = None
        self.error: Exception | None = None

    @property
    def busy(self) -> bool:
        return self._background.busy

    def of(self, scene: Scene, camera: Camera, size: Size) -> Pair | None:
        """Return the recordings to show; None before the first steps of a scene.

        Those of the last camera are shown until the new ones are complete, or take long.
        error: the reason if there are none, such as an invalid canvas.
        """
        outcome = self._background.poll()
        if outcome is not None:
            self.error = outcome.error
            if outcome.value is not None and outcome.value.complete:
                self._shown = outcome.value
        self._background.ask(self._record, scene, camera, size)
        going, shown = self._under_way, self._shown
        # Only the camera may be another one.
        alike = shown is not None and shown.is_of(scene, shown.camera, size)
        if going is not None and going.is_of(scene, camera, size):
            if (going.is_late or not alike) and all(len(run) for run in going.runs.values()):
                self._shown = going
                return going
        elif going is not None and not going.complete and going.is_late:
            going.cancel()  # asked in each frame: it may become slow after the next was wanted
        return shown if alike else None

    def close(self) -> None:
        if self._under_way is not None:
            self._under_way.cancel()
        self._background.close()

    def _record(self, scene: Scene, camera: Camera, size: Size) -> Pair:
        """Record both runs, on the thread."""
        runs = {order: Recording(self._model(scene), camera, size, order) for order in Order}
        pair = Pair(scene, camera, size, runs, time.monotonic())
        self._under_way = pair
        # Triangle by triangle may take long, and nothing is shown before each has a step.
        runs[Order.IMAGE].run()
        runs[Order.RASTER].run()
        return pair


def _model(scene: Scene) -> Model:
    return Model(scene)
