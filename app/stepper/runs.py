"""The stepper's recordings of the current scene, camera and canvas, made in the background.

Those of the last camera are shown until the new ones are complete.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.stepper.loop_parts import Model
from app.stepper.recording import Order, Recording
from app.widgets.background import Background
from renderer.camera import Camera, Size
from renderer.memo import Memo, same
from renderer.scene.model import Scene


@dataclass(frozen=True, eq=False)
class Pair:
    """The recordings of one canvas, in object order and in image order."""

    scene: Scene
    camera: Camera
    size: Size
    runs: dict[Order, Recording]

    @property
    def cancelled(self) -> bool:
        return not all(run.complete or run.truncated for run in self.runs.values())


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
        """Return complete recordings of a scene and a canvas, of this camera or an earlier one;
        None before there are any.

        error: the reason if there are none, such as an invalid canvas.
        """
        outcome = self._background.poll()
        if outcome is not None:
            self.error = outcome.error
            if outcome.value is not None and not outcome.value.cancelled:
                self._shown = outcome.value
        going, shown = self._under_way, self._shown
        if going is not None and not same((going.scene, going.size), (scene, size)):
            self._cancel()  # asked in each frame: it may begin after another one was wanted
        self._background.ask(self._record, scene, camera, size)
        if shown is not None and same((shown.scene, shown.size), (scene, size)):
            return shown
        return None

    def close(self) -> None:
        self._cancel()
        self._background.close()

    def _cancel(self) -> None:
        if self._under_way is not None:
            for run in self._under_way.runs.values():
                run.cancel()

    def _record(self, scene: Scene, camera: Camera, size: Size) -> Pair:
        """Record both runs, on the thread."""
        runs = {order: Recording(self._model(scene), camera, size, order) for order in Order}
        self._under_way = Pair(scene, camera, size, runs)
        for run in runs.values():
            run.run()
        return self._under_way


def _model(scene: Scene) -> Model:
    return Model(scene)
