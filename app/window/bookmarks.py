"""Bookmarks of views, on the keys 1 to 9.

They are options, so undo and sessions include them.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.cameras.films.key_file import keys_text
from lucida.app.cameras.films.paths import Key
from lucida.app.state.options.shared import MOST_BOOKMARKS, Bookmark
from lucida.app.ui.host import Host
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import one_line

NUMBERS = range(1, MOST_BOOKMARKS + 1)


def store(window: Host, number: int) -> None:
    """Save the present view under a number, 1 to 9, and report it."""
    options = window.options
    others = [mark for mark in options.bookmarks if mark.number != number]
    marks = sorted([*others, Bookmark(number, window.state.view)], key=lambda mark: mark.number)
    window.edit(replace(options, bookmarks=tuple(marks)))
    window.files.say(f"This view is bookmark {number}: key {number} returns to it.")


def recall(window: Host, number: int) -> None:
    """Go to a bookmark's view; report how to make one if there is none."""
    for mark in window.options.bookmarks:
        if mark.number == number:
            window.travel(window.state.with_view(mark.view))
            return
    window.files.say(f"Bookmark {number} is free: Ctrl+{number} saves a view.")


def save_for_film(window: Host) -> None:
    """Ask where to save the bookmarks' views as the key cameras of a film."""
    keys = [Key(mark.view) for mark in window.state.options.bookmarks]

    def store(path: str) -> str:
        with atomic_write(path) as file:
            file.write(keys_text(keys).encode())
        return one_line(f"Saved the cameras: lucida animate SCENE --path {path} -o film.mp4")

    kind = ("Key cameras", ".toml")
    window.files.save_as_dialog("Save the film's cameras", "keys.toml", kind, store)
