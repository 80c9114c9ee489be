"""The actions of the parts around the views: files, themes, layouts, bookmarks, help.

shell.py, files.py and bookmarks.py carry them out.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.state.app_state import AppState
from lucida.app.state.bounds import range_of
from lucida.app.state.options.shared import Preferences, Theme
from lucida.app.ui import layout
from lucida.app.ui.action import Action, changing, choosing

from . import bookmarks
from .documents import ABOUT, FIRST, GETTING_STARTED, KEYS
from .exporting import ask_export
from .figure_box import ask_figure
from .platform import toggle_full_screen

SMALLEST_SCALE, LARGEST_SCALE = range_of(Preferences, "font_scale")
FONT_SCALES = (SMALLEST_SCALE, 0.9, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, LARGEST_SCALE)


def _theme(name: Theme, title: str) -> Action:
    return choosing("View/Theme", title, "preferences.theme", name)


def scaled(state: AppState, step: int) -> AppState:
    """Return the state with type one step larger or smaller; step 0 resets it to 100 %."""
    scale = state.preferences.font_scale
    if step > 0:
        scale = min((s for s in FONT_SCALES if s > scale + 1e-6), default=LARGEST_SCALE)
    elif step < 0:
        scale = max((s for s in FONT_SCALES if s < scale - 1e-6), default=SMALLEST_SCALE)
    else:
        scale = 1.0
    return state.with_options(replace(state.options.preferences, font_scale=scale))


def _layout(number: int, one: layout.Layout) -> Action:
    return Action(
        "Layout",
        one.name,
        lambda window: layout.switch(one.name),
        f"Ctrl+F{number + 1}",
        is_on=lambda state: layout.current() is one,
        tip=one.use,
    )


def _bookmark(number: int, stores: bool) -> Action:
    does = bookmarks.store if stores else bookmarks.recall
    return Action(
        "Camera/Bookmarks",
        f"Keep this view as bookmark {number}" if stores else f"Go to bookmark {number}",
        lambda window: does(window, number),
        f"Ctrl+{number}" if stores else str(number),
        can=lambda window: stores or window.state.step is None,  # digits are a lecture's steps
    )


FILE = (
    Action("File", "Open...", lambda w: w.files.open_dialog(), "Ctrl+O"),
    Action(
        "File",
        "Save scene",
        lambda w: w.save_scene(),
        "Ctrl+S",
        separated=True,
    ),
    Action(
        "File",
        "Save scene as...",
        lambda w: w.save_scene_as(),
        "Ctrl+Shift+S",
    ),
    Action(
        "File",
        "Save view...",
        lambda w: w.files.save_view_dialog(w.state.view),
        "Ctrl+Alt+S",
        separated=True,
    ),
    Action(
        "File",
        "Save bookmarks as a film's cameras...",
        bookmarks.save_for_film,
        can=lambda w: len(w.state.options.bookmarks) > 1,
    ),
    Action("File", "Export...", ask_export, "Ctrl+E"),
    Action("File", "Export figure...", ask_figure, "Ctrl+Shift+E"),
)

QUIT = (Action("File", "Quit", lambda w: w.quit(), "Ctrl+Q", separated=True),)

UNDO = (
    Action("Edit", "Undo", lambda w: w.undo(), "Ctrl+Z", can=lambda w: w.can_undo()),
    Action(
        "Edit", "Redo", lambda w: w.redo(), "Ctrl+Shift+Z", "Ctrl+Y", can=lambda w: w.can_redo()
    ),
)

BOOKMARKS = tuple(
    _bookmark(number, stores) for stores in (False, True) for number in bookmarks.NUMBERS
)

LOOK = (
    Action("View", "Full screen", lambda w: toggle_full_screen(), "F11"),
    choosing("View", "Presentation", "preferences.presentation", True, "F9", off=False),
    _theme("dark", "Dark theme"),
    _theme("light", "Light theme"),
    Action(
        "View/Theme",
        "Larger type",
        changing(lambda state: scaled(state, 1)),
        "Ctrl++",
        separated=True,
    ),
    Action(
        "View/Theme",
        "Smaller type",
        changing(lambda state: scaled(state, -1)),
        "Ctrl+-",
    ),
    Action(
        "View/Theme",
        "Type at 100 %",
        changing(lambda state: scaled(state, 0)),
        "Ctrl+0",
    ),
    *(_layout(number, one) for number, one in enumerate(layout.CHOICES)),
    Action("Layout", "Reset the layout", lambda w: layout.reset(), separated=True),
)

EFFECTS = (
    choosing("Image", "Shadows (ray image only)", "shadows", True, off=False, separated=True),
    choosing("Image", "Mirrors (ray image only)", "mirrors", True, off=False),
)

HELP = (
    Action("Help", GETTING_STARTED, lambda w: w.shell.open_document(GETTING_STARTED)),
    Action("Help", "Documentation", lambda w: w.shell.open_document(FIRST)),
    Action(
        "Help",
        KEYS,
        lambda w: w.shell.open_document(KEYS),
        "F1",
        "Shift+/",
    ),
    Action("Help", ABOUT, lambda w: w.shell.open_document(ABOUT), separated=True),
)
