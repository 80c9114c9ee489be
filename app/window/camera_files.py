"""The camera as it is shown into a file of any format: the actions of the menu File, Save camera
as.

Owns their names. A format is an action, since several have the same ending. The formats are
renderer/files/cameras/'s.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from lucida.app.cameras.camera_panel.actions import image_size
from lucida.app.cameras.text import CALLED
from lucida.app.ui.action import Action
from lucida.app.ui.host import Host
from lucida.renderer.files.cameras import FORMATS, Options, PosedCamera, save_files, written
from lucida.renderer.files.cameras.formats import Format
from lucida.renderer.system.errors import LucidaError, one_line

MENU = "File/Save camera as"


def _action(entry: Format) -> Action:
    return Action(MENU, f"{CALLED[entry.name]} ({_kinds(entry)})...", _saving(entry))


def _kinds(entry: Format) -> str:
    return ", ".join(entry.endings) if entry.endings[0] else "a folder"


def _saving(entry: Format) -> Callable[[Host], None]:
    return lambda window: _save_dialog(window, entry)


def _save_dialog(window: Host, entry: Format) -> None:
    """Ask where to save the camera. First report what the format cannot hold."""
    state = window.state
    posed = PosedCamera(window.renderers.camera(state), image_size(window))
    try:
        written([posed], entry.name)
    except LucidaError as error:
        window.files.message = f"The camera cannot be saved as {CALLED[entry.name]}. {error}"
        return

    def store(path: str) -> str:
        options = Options(is_binary=path.lower().endswith(".glb"))
        save_files(Path(path), written([posed], entry.name, options))
        return one_line(f"Saved the camera as {path} ({CALLED[entry.name]}).")

    name = f"camera{entry.endings[0]}"
    title = f"Save the camera: {entry.what} ({_kinds(entry)})"
    window.files.save_as_dialog(title, name, (entry.what, *entry.endings), store)


# A view file is the action "Save view...", which keeps whether it is fitted.
CAMERA_FILES = tuple(_action(entry) for entry in FORMATS if entry.name != "view")
