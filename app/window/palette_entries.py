"""Everything that the command palette offers, for the window as it is now: the actions, and what no
table holds: the views and their pages, the lecture's steps, the built-in scenes, the recent files,
the bookmarks.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from lucida.app.cameras.camera_panel.actions import go_to_view
from lucida.app.lecture.view import LectureView
from lucida.app.ui.action import Action
from lucida.app.ui.host import Host
from lucida.app.ui.stage import Stage
from lucida.app.window.action_table import ACTIONS
from lucida.app.window.bookmarks import recall
from lucida.app.window.instruments import INSTRUMENTS
from lucida.app.window.palette_search import Entry
from lucida.renderer.files import SCENE_NAMES
from lucida.renderer.system.errors import one_line

# The words of other programs and of other books, by names of actions and titles of views.
OWN = {
    "Open...": "load import model mesh",
    "Open photograph...": "background image picture overlay backdrop load png jpg",
    "Save view...": "export camera",
    "Save scene": "export",
    "Export...": "gltf glb blender save scene camera renderer",
    "Save a picture of the window": "screenshot capture image png",
    "Export figure...": "diagram drawing vector svg pdf slides paper",
    "Quit": "exit close end",
    "Undo": "revert",
    "Redo": "repeat",
    "Maximise the view": "maximize",
    "Full screen": "fullscreen",
    "Presentation": "projector hall slides lecture big",
    "Larger type": "font size bigger text",
    "Smaller type": "font size text",
    "Type at 100 %": "font size text reset",
    "Dark theme": "mode colors colours night",
    "Light theme": "mode colors colours bright day",
    "Find a command": "palette search",
    "Getting started": "tutorial introduction first steps",
    "Documentation": "manual docs help read",
    "Mouse and keys": "help shortcuts keyboard hotkeys bindings",
    "About Lucida": "version licence license",
    "Shadows (ray image only)": "shadow",
    "Mirrors (ray image only)": "reflection reflections",
}

SYNONYMS = OWN | {name: also for one in INSTRUMENTS for name, also in one.synonyms.items()}


def entries(window: Host, stage: Stage) -> list[Entry]:
    """Return all entries, in the order of the menus."""
    state, files = window.state, window.files
    found = [_of_action(action, window) for action in ACTIONS]
    for name, view in stage.views.items():
        title, menu = " ".join(view.title.split()), "Instruments"
        also = SYNONYMS.get(title, "")
        found.append(Entry(f"Go to {title}", menu, partial(stage.show, name), also=also))
        if stage.is_shown(name):
            found.append(Entry(f"Hide {title}", menu, partial(stage.show, name, False)))
    found += pages(window)
    lecture = window.view(LectureView)
    if lecture.session is not None:
        for number, step in enumerate(lecture.session.lecture.steps):
            go = partial(lecture.go, window, number)
            found.append(Entry(f"Step {number + 1}: {step.title}", f"Lecture > {step.part}", go))
    for name in SCENE_NAMES:
        found.append(Entry(f"Scene: {name}", "File > Built-in scenes", partial(files.open, name)))
    for path in files.recent.entries:
        where = f"File > Recent files > {one_line(str(path.parent))}"
        go = partial(files.open, str(path))
        found.append(Entry(f"Open {one_line(path.name)}", where, go))
    for named in state.scene.views:
        go = partial(go_to_view, window, named.view)
        found.append(Entry(f"Camera: {named.name}", "Camera > From the file", go))
    for mark in state.options.bookmarks:
        name, go = f"Bookmark {mark.number}: {mark.name}", partial(recall, window, mark.number)
        found.append(Entry(name, "Camera > Bookmarks", go, str(mark.number)))
    return found


def pages(window: Host) -> list[Entry]:
    """Return the entries of the instruments' pages."""
    return [
        Entry(
            page,
            "Instruments",
            partial(_show_page, window, instrument.name, options),
            also=SYNONYMS.get(page, ""),
        )
        for instrument in INSTRUMENTS
        for page, options in instrument.pages.items()
    ]


def _show_page(window: Host, name: str, options: Mapping[str, Mapping[str, object]]) -> None:
    window.show(name)
    changed = window.state.options.with_changes(options)
    window.change(window.state.with_options(changed))


def _of_action(action: Action, window: Host) -> Entry:
    return Entry(
        action.name,
        action.menu.replace("/", " > "),
        partial(action.run, window),
        action.keys,
        action.can is None or action.can(window),
        action.is_on is not None and action.is_on(window.state),
        SYNONYMS.get(action.name, ""),
    )
