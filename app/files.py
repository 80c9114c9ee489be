"""Opening and saving from the window: dialogs, dropped files, loading in the background.

Owns the dialogs and the loading thread. Knows nothing of what is done with a scene.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import portable_file_dialogs as dialogs

from app.background import Background
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, SCENE_ENDINGS, Scene, View, load_scene, load_view

SNIFFED_BYTES = 1 << 20
LINUX_DIALOGS = ("zenity", "kdialog", "matedialog", "qarma")  # what the dialogs are drawn by


@dataclass(frozen=True)
class Opened:
    """What a source held: a scene, or a view alone."""

    source: str
    scene: Scene | None = None
    view: View | None = None


class Files:
    """wake: called from another thread when something has been loaded."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._loading: Background[Opened] = Background("lucida-load", wake)
        self._open: dialogs.open_file | None = None
        self._save: dialogs.save_file | None = None
        self._view: View | None = None
        self._source = ""
        self.message = ""

    @property
    def busy(self) -> bool:
        """Whether something is being loaded, or a dialog is open."""
        return self._loading.busy or self._open is not None or self._save is not None

    @property
    def loading(self) -> str:
        """The name of what is being loaded; empty while nothing is."""
        return self._source if self._loading.busy else ""

    def open(self, source: str) -> None:
        """Loads a built-in scene, a scene file, a model or a view file in the background."""
        self.message = ""
        self._source = Path(source).name
        self._loading.submit(lambda: open_source(source))

    def open_dialog(self) -> None:
        endings = " ".join(f"*{ending}" for ending in SCENE_ENDINGS)
        if self._open is None and self._can_ask("drop the file on the window"):
            filters = ["Scenes, views and models", endings, "All files", "*"]
            self._open = dialogs.open_file("Open a scene, a view or a model", "", filters)

    def save_view_dialog(self, view: View) -> None:
        if self._save is None and self._can_ask("kdialog"):
            self._view = view
            filters = ["View files", "*.toml"]
            self._save = dialogs.save_file("Save the view", "view.toml", filters)

    def poll(self) -> Opened | None:
        """What has been loaded since the last call; errors become the message."""
        if self._open is not None and self._open.ready(0):
            chosen, self._open = self._open.result(), None
            if chosen:
                self.open(chosen[0])
        if self._save is not None and self._save.ready(0):
            path, self._save = self._save.result(), None
            if path and self._view is not None:
                self._store(path, self._view)
        outcome = self._loading.poll()
        if outcome is None:
            return None
        if outcome.error is not None:
            self.message = describe(outcome.error)
        return outcome.value

    def close(self) -> None:
        self._loading.close()

    def _can_ask(self, otherwise: str) -> bool:
        """Whether the system has file dialogs; if not, the message says what to do."""
        if sys.platform.startswith("linux") and not any(map(shutil.which, LINUX_DIALOGS)):
            self.message = f"no file dialog on this system: install zenity, or {otherwise}"
            return False
        return True

    def _store(self, path: str, view: View) -> None:
        from renderer.scene import save_view

        try:
            save_view(path if path.endswith(".toml") else f"{path}.toml", view)
            self.message = ""
        except (LucidaError, OSError) as error:
            self.message = describe(error)


def open_source(source: str) -> Opened:
    """Loads a scene, or a view where a .toml file has a camera only. Raises LucidaError."""
    if source not in BUILTIN_SCENES and _is_view(Path(source)):
        return Opened(source, view=load_view(source))
    return Opened(source, scene=load_scene(source))


def describe(error: Exception) -> str:
    """One line for the window."""
    if isinstance(error, LucidaError):
        return str(error)
    if isinstance(error, MemoryError):
        return "not enough memory; try a smaller image or model"
    return f"{type(error).__name__}: {' '.join(str(error).split())}"


def _is_view(path: Path) -> bool:
    if path.suffix.lower() != ".toml":
        return False
    try:
        with path.open("rb") as file:
            text = file.read(SNIFFED_BYTES)
    except OSError:
        return False
    return b"[camera]" in text and b"objects" not in text
