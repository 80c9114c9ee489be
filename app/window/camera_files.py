"""The actions of the menu File, Save camera as: one for each format that is written."""

from __future__ import annotations

from collections.abc import Callable

from lucida.app.cameras.camera_panel.actions import image_size
from lucida.app.cameras.text import CALLED
from lucida.app.ui.action import Action
from lucida.app.ui.host import Host
from lucida.renderer.files.cameras import FORMATS, PosedCamera, written
from lucida.renderer.files.cameras.formats import Format
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, one_line

MENU = "File/Save camera as"


def _action(entry: Format) -> Action:
    return Action(MENU, f"{CALLED[entry.name]} ({_kinds(entry)})...", _saving(entry))


def _kinds(entry: Format) -> str:
    return ", ".join(entry.endings)


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
        data = written([posed], entry.name)
        with atomic_write(path) as file:
            file.write(data)
        return one_line(f"Saved the camera as {path} ({CALLED[entry.name]}).")

    name = f"camera{entry.endings[0]}"
    title = f"Save the camera: {entry.what} ({_kinds(entry)})"
    window.files.save_as_dialog(title, name, (entry.what, *entry.endings), store)


# A view file is the action "Save view...", which keeps whether it is fitted.
CAMERA_FILES = tuple(_action(one) for one in FORMATS if one.endings and one.name != "view")
