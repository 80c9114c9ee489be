"""Views to come back to, by the keys 1 to 9.

They are options, so undo and sessions have them.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.cameras.films.key_file import keys_text
from lucida.app.cameras.films.paths import Key
from lucida.app.cameras.lens_choices import KINDS
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import MOST_BOOKMARKS, Bookmark
from lucida.app.ui.host import Host
from lucida.renderer.scene import View
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import one_line

NUMBERS = range(1, MOST_BOOKMARKS + 1)


def of(state: AppState, number: int) -> Bookmark | None:
    """Return the bookmark of a number; None if there is none."""
    return next((mark for mark in state.options.bookmarks if mark.number == number), None)


def with_bookmark(state: AppState, number: int) -> AppState:
    """Return the state in which the present view is kept under a number, 1 to 9."""
    mark = Bookmark(number, describe(state.view), state.view)
    others = [other for other in state.options.bookmarks if other.number != number]
    return state.with_options(
        replace(
            state.options, bookmarks=tuple(sorted([*others, mark], key=lambda entry: entry.number))
        )
    )


def store(window: Host, number: int) -> None:
    """Keep the present view, and report it."""
    window.change(with_bookmark(window.state, number))
    window.files.say(f"This view is bookmark {number}: key {number} comes back to it.")


def recall(window: Host, number: int) -> None:
    """Go to a bookmark's view; report how to make one if there is none."""
    mark = of(window.state, number)
    if mark is None:
        window.files.say(f"Bookmark {number} is free: Ctrl+{number} keeps a view.")
        return
    window.travel(window.state.with_view(mark.view))


def save_for_film(window: Host) -> None:
    """Ask where to save the bookmarks' views as the key cameras of a film."""
    keys = [Key(mark.view) for mark in window.state.options.bookmarks]

    def store(path: str) -> str:
        with atomic_write(path) as file:
            file.write(keys_text(keys).encode())
        return one_line(f"Saved the cameras: lucida animate SCENE --path {path} -o film.mp4")

    kind = ("Key cameras", ".toml")
    window.files.save_as_dialog("Save the film's cameras", "keys.toml", kind, store)


def describe(view: View) -> str:
    """Describe a view in a few words: perspective from (3.4, 3.1, 8.6)."""
    x, y, z = view.camera.eye
    lens = view.camera.lens
    kind = view.camera.projection if lens is None else KINDS[lens.model].name.lower()
    return f"{kind} from ({x:.3g}, {y:.3g}, {z:.3g})"
