"""What the window begins with: a scene of the command line's, the last session, or the default.

Owns the choice. Knows nothing of how the window is made. No window waits for a large model: it
begins without, and reads that while its first frames are drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from imgui_bundle import hello_imgui

from app.state import AppState
from app.storage.files import Opened, describe, opened_scene
from app.storage.session import Session
from app.storage.session_store import Found, Keeper, take_place
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, Scene, View, load_scene, load_view
from renderer.scene.apart import is_large
from renderer.scene.model import SceneObject
from renderer.scene.models import read_by, read_model

ChangeView = Callable[[View], View]


@dataclass(frozen=True)
class Later:
    """A scene that takes long to read. view: gives the one that it is seen by."""

    source: str
    view: ChangeView

    def open(self) -> Opened:
        """Reads it. What goes wrong is told, and the scene that the window has begun with stays."""
        try:
            scene = load_scene(self.source)
            return replace(opened_scene(self.source, scene, self.view(scene.view)), is_first=True)
        except LucidaError as error:
            return Opened(problems=(describe(error),))


@dataclass(frozen=True)
class Start:
    """What a window begins with. session: what it goes on with, None for nothing. keeper: what
    saves it. message: what the user is told about it. opened: a scene for the recent files. later:
    what takes the place of the state's scene as soon as it is read."""

    state: AppState
    session: Session | None = None
    keeper: Keeper | None = None
    message: str = ""
    opened: str = ""
    later: Later | None = None


def begin_scene(
    source: str | None = None,
    view: str | Path | None = None,
    change: ChangeView | None = None,
    wait: bool = False,
) -> Start:
    """A scene, the default one if none is given, seen by its own view, or that of a view file; and
    what else is changed about that. wait: for a large model too. Raises LucidaError."""
    given = None if view is None else load_view(view)

    def seen_by(own: View) -> View:
        own = given or own
        return own if change is None else change(own)

    scene = load_scene(source or BUILTIN_SCENES[0]) if wait else _soon(source or BUILTIN_SCENES[0])
    if scene is None:
        assert source is not None  # what is built in has no large models
        return Start(
            AppState.for_scene(load_scene(BUILTIN_SCENES[0])), later=Later(source, seen_by)
        )
    return Start(AppState.for_scene(scene, seen_by(scene.view)), opened=source or "")


def begin_session(fresh: bool = False, folder: Path | None = None) -> Start:
    """The last session, or an empty one. fresh: the last one is put aside unread.

    folder: where sessions are; None for the user's settings folder. A scene that is not there any
    more, or that cannot be read, is told; the rest of the session stays.
    """
    place = take_place(folder)
    if place is None:
        return begin_scene()
    keeper = Keeper(place, hello_imgui.request_refresh)
    found = Found() if fresh else place.load()
    session = found.session
    if session is None:
        return replace(begin_scene(), keeper=keeper, message=found.message)
    message = ""
    try:
        scene = _soon(session.source)
    except LucidaError as error:
        scene, message = None, f"The last session's scene could not be opened. {error}"
    if scene is not None:
        return Start(session.state(scene), session, keeper)
    view = session.view
    later = None if message else Later(session.source, lambda _: view)
    default = load_scene(BUILTIN_SCENES[0])
    return Start(session.state(default), session, keeper, message, later=later)


class _LargeModelError(Exception):
    pass


def _soon(source: str) -> Scene | None:
    """A scene; None where it has a large model, which takes long. Raises LucidaError."""

    def read(path: Path) -> tuple[SceneObject, ...]:
        if is_large(path):
            raise _LargeModelError
        return read_model(path)

    try:
        with read_by(read):
            return load_scene(source)
    except _LargeModelError:
        return None
