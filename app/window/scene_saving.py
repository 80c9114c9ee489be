"""Save the window's scene in its file, and ask before unsaved changes are lost.

renderer/editing/documents.py writes the file, in the background.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from lucida.app.state.app_state import AppState
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.renderer.editing.documents import (
    ChangedOnDiskError,
    file_of,
    is_unsaved,
    save,
    suggested_file,
)
from lucida.renderer.files.rewriting import CommentsLostError
from lucida.renderer.scene import Scene, View
from lucida.renderer.system.errors import describe, one_line

from .files import Files

OVERWRITE, SAVE, DISCARD = "Overwrite it", "Save", "Quit without saving"
SAVE_AS = "Save as a new file..."
LEAVE = "Open without saving"

Then = Callable[[], None]


@dataclass(frozen=True)
class _SceneWritten:
    """The scene that is being written. view: its own view from now on; None for the old one. then:
    called once it is saved.
    """

    scene: Scene
    path: Path
    view: View | None = None
    then: Then | None = None


class SceneSaving:
    """The saving of one window's scene. end: closes the window."""

    def __init__(self, files: Files, end: Then) -> None:
        self._files, self.end = files, end
        self._writing: Background[Scene] = Background("lucida-save-scene", every=True)
        self._written: deque[_SceneWritten] = deque()  # in the order of their outcomes
        self._agreed: Scene | None = None  # its changes may be lost

    def save(self, state: AppState, then: Then | None = None) -> None:
        """Save the scene in its own file, or ask for one. then: called once it is saved."""
        path = file_of(state.scene)
        if path is None:
            self.save_as(state, then)
        elif is_unsaved(state.scene):
            self._write(_SceneWritten(state.scene, path, then=then))
        else:
            self._files.say(one_line(f"No unsaved changes in {path.name}."))

    def save_as(self, state: AppState, then: Then | None = None) -> None:
        """Ask for a path, and save the scene there with the present camera."""
        name = str(suggested_file(state.scene))
        self._files.ask_name(
            "Save the scene",
            name,
            ("Scene files", ".toml"),
            lambda path: self._write(_SceneWritten(state.scene, Path(path), state.view, then)),
        )

    @property
    def busy(self) -> bool:
        """True while something is being written. Until its result is polled, the file looks as if
        another program had changed it.
        """
        return bool(self._written)

    def poll(self, host: Host) -> None:
        """Take the result of saving. Call once a frame."""
        outcome = self._writing.poll()
        if outcome is None:
            return
        written = self._written.popleft()
        if isinstance(outcome.error, ChangedOnDiskError | CommentsLostError):
            state = replace(host.state, scene=written.scene)
            answers: dict[str, Then] = {SAVE_AS: lambda: self.save_as(state, written.then)}
            if isinstance(outcome.error, ChangedOnDiskError):
                answers[OVERWRITE] = lambda: self._write(written, force=True)
            self._files.ask(one_line(f"{written.path.name} {outcome.error.problem}."), answers)
        elif outcome.error is not None:
            self._files.message = describe(outcome.error)
        elif outcome.value is not None:
            self._saved(host, outcome.value, written.scene)
            if written.then is not None:
                written.then()

    def closes(self, state: AppState) -> bool:
        """Return True if the window may close now; else ask what to do with the scene."""
        scene = state.scene
        if self._written:  # close once that has succeeded
            self._written[-1] = replace(self._written[-1], then=self.end)
            return False
        if scene is self._agreed or not is_marked(scene, state.step is not None):
            return True
        self._ask(state, self.end, DISCARD, lambda: self._discard(scene))
        return False

    def leave(self, state: AppState, then: Then) -> None:
        """Call `then`, which replaces the scene. Ask first if changes would be lost."""
        if is_marked(state.scene, state.step is not None):
            self._ask(state, then, LEAVE, then)
        else:
            then()

    def close(self) -> None:
        """Wait until everything is written. Call once, at the end."""
        self._writing.close(5.0)

    def _ask(self, state: AppState, saved: Then, otherwise: str, lose: Then) -> None:
        """Ask whether to save the scene.

        saved: called after saving. otherwise: the words for not saving, which calls `lose`.
        """
        name = one_line(state.scene.name) or "The scene"
        text = f"{name} has unsaved changes."
        self._files.ask(text, {SAVE: lambda: self.save(state, saved), otherwise: lose})

    def _discard(self, scene: Scene) -> None:
        self._agreed = scene
        self.end()

    @property
    def discards(self) -> bool:
        """Return True if the user has agreed to lose unsaved changes."""
        return self._agreed is not None

    def _write(self, written: _SceneWritten, force: bool = False) -> None:
        self._written.append(written)
        self._writing.submit(lambda: save(written.scene, written.path, written.view, force))

    def _saved(self, host: Host, saved: Scene, written: Scene | None) -> None:
        path = file_of(saved)
        assert path is not None
        self._files.know(saved)
        self._files.say(one_line(f"Saved the scene as {path}."))
        if host.state.scene is written:
            host.amend(replace(host.state, scene=saved))


def is_marked(scene: Scene, is_a_steps: bool = False) -> bool:
    """Return True if the scene has unsaved changes. This is quick enough for each frame.

    The scene of a lecture's step is never marked, since it is never saved.
    """
    return not is_a_steps and is_unsaved(scene)


def title(scene: Scene, is_a_steps: bool = False) -> str:
    """Return the window's title, with a star if the scene is_marked()."""
    star = " *" if is_marked(scene, is_a_steps) else ""
    return f"Lucida: {scene.name}{star}" if scene.name else f"Lucida{star}"
