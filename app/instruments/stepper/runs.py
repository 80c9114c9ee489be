"""The background work of the stepper for the current scene, camera and canvas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.recording import Order, Recording
from lucida.app.ui.background import Background
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.memo import Memo, same

T = TypeVar("T")


class Made(NamedTuple, Generic[T]):
    """A value, and what it was made of."""

    scene: Scene
    camera: Camera
    size: Size
    value: T


class Prepared(Generic[T]):
    """A value of the current scene, camera and canvas. error: of the last one that was made.

    make: called on a thread, with a function that says whether its value is still wanted. wake:
    called from the thread when something is finished.
    """

    def __init__(
        self,
        name: str,
        make: Callable[[Model, Camera, Size, Callable[[], bool]], T],
        wake: Callable[[], None],
    ) -> None:
        self._make, self._model = make, Memo(_model)  # of the thread
        self._background: Background[Made[T]] = Background(name, wake)
        self._wanted: tuple[Scene, Size] | None = None
        self._made: Made[T] | None = None
        self.error: Exception | None = None

    @property
    def busy(self) -> bool:
        return self._background.busy

    def of(self, scene: Scene, camera: Camera, size: Size) -> Made[T] | None:
        """Return the value of a scene and a canvas, of this camera or an earlier one; None before
        there is any.

        error: the reason if there is none, such as an invalid canvas.
        """
        self._wanted = scene, size
        outcome = self._background.poll()
        if outcome is not None:
            self.error, self._made = outcome.error, outcome.value or self._made
        self._background.ask(self._prepare, scene, camera, size)
        made = self._made
        return made if made is not None and same((made.scene, made.size), (scene, size)) else None

    def close(self) -> None:
        self._wanted = None
        self._background.close()

    def _prepare(self, scene: Scene, camera: Camera, size: Size) -> Made[T]:
        """Make the value, on the thread."""

        def is_wanted() -> bool:
            return self._wanted is not None and same(self._wanted, (scene, size))

        return Made(scene, camera, size, self._make(self._model(scene), camera, size, is_wanted))


def recordings(
    model: Model, camera: Camera, size: Size, is_wanted: Callable[[], bool]
) -> dict[Order, Recording]:
    """Record both algorithms. A run that is no longer wanted ends."""
    runs = {order: Recording(model, camera, size, order) for order in Order}
    for run in runs.values():
        run.run(is_wanted)
    return runs


def _model(scene: Scene) -> Model:
    return Model(scene)
