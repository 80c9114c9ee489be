"""The background work of the stepper for the current scene, camera and canvas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import describe
from lucida.renderer.system.memo import Memo, same

from .loop_parts import Model
from .loops import PROGRAMS
from .recording import Recording

T = TypeVar("T")


class Made(NamedTuple, Generic[T]):
    """A value and its inputs."""

    scene: Scene
    camera: Camera
    size: Size
    value: T


class Prepared(Generic[T]):
    """A value of the current scene, camera and canvas. error: the error of the last attempt.

    make: called on a thread, with a function that returns True while its value is still wanted.
    wake: called from the thread when something is finished.
    """

    def __init__(
        self,
        name: str,
        make: Callable[[Model, Camera, Size, Callable[[], bool]], T],
        wake: Callable[[], None],
    ) -> None:
        self._make, self._model = make, Memo(_model)  # for the thread only
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
        """
        self._wanted = scene, size
        if (outcome := self._background.poll()) is not None:
            self.error, self._made = outcome.error, outcome.value or self._made
        self._background.ask(self._prepare, scene, camera, size)
        made = self._made
        return made if made is not None and same((made.scene, made.size), self._wanted) else None

    def current(self, host: Host) -> Made[T] | None:
        """Return of() for the window's scene and camera. Draw the reason if there is no value."""
        state, canvas = host.state, host.state.options.stepper.canvas
        made = self.of(state.scene, state.view.for_size(canvas), canvas)
        if self.error is not None:
            imgui.text_colored(theme.ERROR, describe(self.error))
            return None
        if made is None:
            imgui.text_colored(theme.DIM, "preparing the scene ...")
            host.animate()
        return made

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
) -> tuple[Recording, ...]:
    """Record both algorithms. A run that is no longer wanted ends early."""
    return tuple(Recording(model, camera, size, program, is_wanted) for program in PROGRAMS)


def _model(scene: Scene) -> Model:
    return Model(scene)
