"""Everything that a menu or a key does, in one table.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key. Gathered
from the window's own and the instruments'; knows nothing of how menus are drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.lecture.instrument import LectureInstrument
from lucida.app.ui.action import Action, changing, chords_of
from lucida.app.ui.host import Host
from lucida.app.window.actions import BOOKMARKS, FILE, HELP, LOOK, QUIT
from lucida.app.window.instruments import INSTRUMENTS

MENUS = ("File", "Edit", "Scene", "Camera", "Image", "View", "Lecture", "Help")

UNDO = (
    Action(
        "Edit",
        "Undo",
        lambda w: w.undo(),
        "Ctrl+Z",
        can=lambda w: w.can_undo(),
    ),
    Action(
        "Edit",
        "Redo",
        lambda w: w.redo(),
        "Ctrl+Shift+Z",
        "Ctrl+Y",
        can=lambda w: w.can_redo(),
    ),
)

EFFECTS = (
    Action(
        "View",
        "Shadows (ray image only)",
        changing(
            lambda state: state.with_options(
                replace(state.options, shadows=not state.options.shadows)
            )
        ),
        is_on=lambda state: state.options.shadows,
        separated=True,
    ),
    Action(
        "View",
        "Mirrors (ray image only)",
        changing(
            lambda state: state.with_options(
                replace(state.options, mirrors=not state.options.mirrors)
            )
        ),
        is_on=lambda state: state.options.mirrors,
    ),
)

_left = [action for one in INSTRUMENTS for action in one.actions]


def _take(menu: str, actions: Sequence[Action] = ()) -> list[Action]:
    """Return the instruments' actions in a menu and its submenus, or those among `actions` alone.
    Each is returned once.
    """
    found = [
        action
        for action in _left
        if f"{action.menu}/".startswith(f"{menu}/") and (not actions or action in actions)
    ]
    _left[:] = [action for action in _left if action not in found]
    return found


# In the order of the menus, and within them; what an instrument adds to a menu comes last in it,
# but before Quit.
ACTIONS = (
    *FILE,
    *_take("File"),
    *QUIT,
    *UNDO,
    *_take("Edit"),
    *_take("Scene"),
    *_take("Camera"),
    *BOOKMARKS,
    *LOOK,
    *_take("Image"),
    *_take("View/Outside view"),
    *EFFECTS,
    *_take("View"),
    *_take("Lecture", LectureInstrument.actions),
    *_take("Lecture/Loop stepper"),
    *_take("Lecture"),
    *HELP,
    *_take("Help"),
)
assert not _left, f"there is no menu {_left[0].menu!r}; the menus: {', '.join(MENUS)}"

MOUSE = (
    *(row for instrument in INSTRUMENTS for row in instrument.mouse),
    ("W, A, S, D, Q, E over a 3D view", "fly: forward, left, back, right, down, up; Shift: faster"),
    ("Alt+drag, or drag while flying", "look around: the eye stays"),
    ("right-click a number", "reset it, copy it, paste one"),
    ("drag a number", "change it; Shift: faster, Alt: slower"),
    ("double-click a number", "type it"),
)


CHORDS = [(chord, action) for action in ACTIONS for chord in action.chords]
# While a text is typed they are its field's, whether that does something by them or not.
OF_TEXT = chords_of("Delete, Ctrl+A, Ctrl+C, Ctrl+D")


def run_shortcuts(window: Host) -> None:
    """Runs the actions whose keys were pressed; call once a frame, in any window."""
    flags = int(imgui.InputFlags_.route_global)
    kept = OF_TEXT if imgui.get_io().want_text_input else ()
    for chord, action in CHORDS:
        if chord in kept or not imgui.shortcut(chord, flags):
            continue
        if action.can is None or action.can(window):
            action.run(window)
