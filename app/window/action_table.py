"""One table of all actions of menus and keys.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key.
"""

from __future__ import annotations

from imgui_bundle import imgui

from lucida.app.lecture.instrument import LectureInstrument
from lucida.app.ui.action import chords_of
from lucida.app.ui.host import Host

from .actions import BOOKMARKS, EFFECTS, FILE, HELP, LOOK, QUIT, UNDO
from .instruments import INSTRUMENTS

# The last one is at the right end of the bar.
MENUS = (
    *("File", "Edit", "Scene", "Camera", "Image"),
    *("Instruments", "View", "Lecture", "Help", "Layout"),
)

# The window's own and the instruments' actions in the order of the menus. Within a menu, they keep
# the order in which they are named here.
ACTIONS = tuple(
    sorted(
        (
            *FILE,
            *UNDO,
            *LOOK,
            *LectureInstrument.actions,
            *(
                action
                for instrument in INSTRUMENTS
                if instrument is not LectureInstrument
                for action in instrument.actions
            ),
            *BOOKMARKS,
            *EFFECTS,
            *HELP,
            *QUIT,
        ),
        key=lambda action: MENUS.index(action.menu.partition("/")[0]),
    )
)

MOUSE = (
    *(row for instrument in INSTRUMENTS for row in instrument.mouse),
    ("Alt+drag", "look around: the eye stays"),
    ("right-click a number", "reset it"),
    ("drag a number", "change it; Shift: large steps; Alt: small steps"),
    ("double-click a number", "type it"),
)


CHORDS = [(chord, action) for action in ACTIONS for chord in action.chords]
# These keys belong to a text field while it is being typed into, whether it uses them or not.
OF_TEXT = chords_of("Delete, Ctrl+A, Ctrl+C, Ctrl+D")


def run_shortcuts(window: Host) -> None:
    """Run the actions whose keys were pressed. Call once a frame, in any window."""
    flags = int(imgui.InputFlags_.route_global)
    kept = OF_TEXT if imgui.get_io().want_text_input else ()
    for chord, action in CHORDS:
        if chord in kept or not imgui.shortcut(chord, flags):
            continue
        if action.can is None or action.can(window):
            action.run(window)
