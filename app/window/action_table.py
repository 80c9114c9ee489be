"""Everything that a menu or a key does, in one table.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key. Gathered
from the instruments; knows nothing of how menus are drawn.
"""

from __future__ import annotations

from imgui_bundle import imgui

from app.camera_panel.actions import CAMERA, EDIT
from app.camera_panel.actions import MOUSE as CAMERA_MOUSE
from app.compare.actions import COMPARING
from app.host.action import CTRL, SHIFT, Action, Key, Window, changing
from app.lecture.actions import LECTURE
from app.outside.actions import DIAGRAM, OUTSIDE
from app.pair.actions import IMAGE
from app.pair.actions import MOUSE as IMAGE_MOUSE
from app.window.actions import BOOKMARKS, FILE, HELP, LOOK

MENUS = ("File", "Edit", "Camera", "Image", "View", "Lecture", "Help")

ACTIONS = (
    *FILE,
    *DIAGRAM,
    Action(
        "Edit",
        "Undo",
        lambda w: w.undo(),
        "Ctrl+Z",
        (CTRL | int(Key.z),),
        can=lambda w: w.can_undo(),
    ),
    Action(
        "Edit",
        "Redo",
        lambda w: w.redo(),
        "Ctrl+Shift+Z",
        (CTRL | SHIFT | int(Key.z), CTRL | int(Key.y)),
        can=lambda w: w.can_redo(),
    ),
    *EDIT,
    *CAMERA,
    *BOOKMARKS,
    *LOOK,
    *IMAGE,
    *OUTSIDE,
    Action(
        "View",
        "Shadows (ray image only)",
        changing(lambda state: state.with_options(shadows=not state.options.shadows)),
        is_on=lambda state: state.options.shadows,
        separated=True,
    ),
    Action(
        "View",
        "Mirrors (ray image only)",
        changing(lambda state: state.with_options(mirrors=not state.options.mirrors)),
        is_on=lambda state: state.options.mirrors,
    ),
    *COMPARING,
    *LECTURE,
    *HELP,
)

MOUSE = (
    ("drag an image", "turn the camera about the point under the pointer"),
    ("Shift+drag, right or middle drag", "move the camera; the point follows the pointer"),
    ("wheel", "closer and farther (parallel: a smaller or larger viewport)"),
    *IMAGE_MOUSE,
    *CAMERA_MOUSE,
    ("drag a number", "change it; Shift: faster, Alt: slower"),
    ("double-click a number", "type it"),
)


def run_shortcuts(window: Window) -> None:
    """Runs the actions whose keys were pressed; call once a frame, in any window."""
    flags = imgui.InputFlags_.route_global
    for action in ACTIONS:
        for chord in action.chords:
            if imgui.shortcut(chord, flags) and (action.can is None or action.can(window)):
                action.run(window)
