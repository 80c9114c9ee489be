"""The scene in the window and its file: saving it, what is not saved yet, and closing.

Owns what is asked before something is lost. Writing is renderer/scene_editing/documents.py's, in
the background.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from app.host.view import Host
from app.state.app_state import AppState
from app.widgets.background import Background
from app.window.files import Files
from renderer.errors import describe, one_line
from renderer.scene import Scene, View
from renderer.scene_editing.documents import (
    ChangedOnDiskError,
    file_of,
    is_unsaved,
    save,
    suggested_file,
)

OVERWRITE, SAVE, DISCARD = "Overwrite it", "Save", "Quit without saving"


class SceneSaving:
    """For one window. quit: ends it."""

    def __init__(self, files: Files, wake: Callable[[], None], quit_: Callable[[], None]) -> None:
        self._files, self._quit = files, quit_
        self._writing: Background[Scene] = Background("lucida-save-scene", wake)
        self._written: Scene | None = None  # the version that is being written
        self._quits = False  # once that is done
        self._agreed: Scene | None = None  # may be lost

    @property
    def busy(self) -> bool:
        return self._writing.busy

    def save(self, state: AppState) -> None:
        """Into the scene's own file; asks where there is none."""
        path = file_of(state.scene)
        if path is None:
            self.save_as(state)
        elif is_unsaved(state.scene):
            self._write(state.scene, path)
        else:
            self._files.say(one_line(f"{path.name} holds all of the scene."))

    def save_with_view(self, state: AppState) -> None:
        """The same, with the present camera as the scene's own."""
        path = file_of(state.scene)
        if path is None:
            self.save_as(state)
        else:
            self._write(state.scene, path, state.view)

    def save_as(self, state: AppState) -> None:
        """Asks where, and saves there with the present camera."""
        name = str(suggested_file(state.scene))
        self._files.ask_name(
            "Save the scene",
            name,
            ("Scene files", ".toml"),
            lambda path: self._write(state.scene, Path(path), state.view),
        )

    def poll(self, host: Host) -> None:
        """Once a frame: what was written."""
        outcome, written = self._writing.poll(), self._written
        if outcome is None:
            return
        self._written = None
        quits, self._quits = self._quits, False
        if isinstance(outcome.error, ChangedOnDiskError) and written is not None:
            path = file_of(written)
            assert path is not None
            self._files.ask(
                one_line(f"{path.name} was changed by another program since it was read."),
                OVERWRITE,
                lambda: self._write(written, path, force=True),
            )
        elif outcome.error is not None:
            self._files.message = describe(outcome.error)
        elif outcome.value is not None:
            self._saved(host, outcome.value, written)
            if quits:
                self._quit()

    def closes(self, state: AppState) -> bool:
        """Whether the window may close now; else asks what is to become of the scene."""
        scene = state.scene
        if state.step is not None or scene is self._agreed or not is_unsaved(scene):
            return not self.busy
        name = one_line(scene.name) or "The scene"
        self._files.ask(
            f"{name} was changed, and not saved.",
            SAVE,
            lambda: self._save_and_quit(state),
            (DISCARD, lambda: self._discard(scene)),
        )
        return False

    def close(self) -> None:
        """Once, at the end: what is being written is written."""
        self._writing.close(5.0)

    def _save_and_quit(self, state: AppState) -> None:
        self._quits = file_of(state.scene) is not None
        self.save(state)

    def _discard(self, scene: Scene) -> None:
        self._agreed = scene
        self._quit()

    @property
    def discards(self) -> bool:
        """Whether the user has agreed to lose what is not saved."""
        return self._agreed is not None

    def _write(
        self, scene: Scene, path: Path, view: View | None = None, force: bool = False
    ) -> None:
        self._written = scene
        self._writing.submit(lambda: save(scene, path, view, force))

    def _saved(self, host: Host, saved: Scene, written: Scene | None) -> None:
        path = file_of(saved)
        assert path is not None
        self._files.know(saved)
        self._files.say(one_line(f"Saved the scene as {path}."))
        if host.state.scene is written:
            host.amend(replace(host.state, scene=saved))
