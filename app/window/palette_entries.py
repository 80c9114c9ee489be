"""Everything that the command palette offers, for the window as it is now.

Owns the list: the actions, and what no table holds: the views, the built-in scenes, the recent
files, the bookmarks. Knows nothing of searching and drawing.
"""

from __future__ import annotations

from collections.abc import Callable

from app.camera_panel.actions import go_to_view
from app.host.action import Action, Window
from app.window.action_table import ACTIONS
from app.window.palette_search import Entry
from app.window.synonyms import SYNONYMS
from renderer.scene import BUILTIN_SCENES, View


def entries(window: Window) -> list[Entry]:
    """All entries, in the order of the menus."""
    return [
        *(_of_action(action, window) for action in ACTIONS),
        *_views(window),
        *_scenes(window),
        *_recent(window),
        *_file_views(window),
        *_bookmarks(window),
    ]


def _of_action(action: Action, window: Window) -> Entry:
    on = action.is_on is not None and action.is_on(window.state)
    return Entry(
        action.name,
        action.menu.replace("/", " > "),
        _bound(action.run, window),
        action.keys,
        action.can is None or action.can(window),
        on,
        SYNONYMS.get(action.name, ""),
    )


def _bound(run: Callable[[Window], None], window: Window) -> Callable[[], None]:
    return lambda: run(window)


def _views(window: Window) -> list[Entry]:
    stage = window.shell.stage
    found = []
    for name, view in stage.views.items():
        title = " ".join(view.title.split())
        shown = stage.is_shown(name)
        also = SYNONYMS.get(title, "")
        found.append(Entry(f"Go to {title}", "View > Views", _show(window, name, True), also=also))
        if shown:
            found.append(Entry(f"Hide {title}", "View > Views", _show(window, name, False)))
    return found


def _show(window: Window, name: str, shown: bool) -> Callable[[], None]:
    return lambda: window.shell.stage.show(name, shown)


def _scenes(window: Window) -> list[Entry]:
    return [
        Entry(f"Scene: {name}", "File > Built-in scenes", _open(window, name))
        for name in BUILTIN_SCENES
    ]


def _recent(window: Window) -> list[Entry]:
    return [
        Entry(
            f"Open {recent.name}" + ("  (missing)" if recent.missing else ""),
            f"File > Recent files > {recent.path}",
            _open(window, recent.path),
            enabled=not recent.missing,
        )
        for recent in window.files.recent.entries
    ]


def _file_views(window: Window) -> list[Entry]:
    """The cameras of the scene's file."""
    return [
        Entry(f"Camera: {named.name}", "Camera > From the file", _to_view(window, named.view))
        for named in window.state.scene.views
    ]


def _to_view(window: Window, view: View) -> Callable[[], None]:
    return lambda: go_to_view(window, view)


def _open(window: Window, source: str) -> Callable[[], None]:
    return lambda: window.files.open(source)


def _bookmarks(window: Window) -> list[Entry]:
    return [
        Entry(
            f"Bookmark {mark.number}: {mark.name}",
            "Camera > Bookmarks",
            _travel(window, mark.number),
            str(mark.number),
        )
        for mark in window.state.options.bookmarks
    ]


def _travel(window: Window, number: int) -> Callable[[], None]:
    from app.window.bookmarks import recall

    return lambda: recall(window, number)
