"""The view "Film": a path is seen and scrubbed, a film is saved, cancelled, and gone on with."""

from __future__ import annotations

import math
from pathlib import Path

from imgui_bundle import hello_imgui
from outside_window import view as outside_view
from PIL import Image
from window_driver import Driver

from app.filming.actions import FILMS
from app.filming.options import FilmingOptions
from app.filming.view import FILM, FilmView
from app.films.key_file import keys_text
from app.films.paths import Key
from app.host import layout
from app.outside.diagram import Segments
from app.storage.paths import stored
from app.window.bookmarks import with_bookmark

WINDOW = f"//###{FILM}"
SMALL = {"size": (32, 18), "renderer": "ray", "samples": 1, "fps": 10, "form": ".gif"}


def view(d: Driver) -> FilmView:
    found = d.window.views[FILM]
    assert isinstance(found, FilmView)
    return found


def enter(d: Driver, **options: object) -> None:
    FILMS[0].run(d.window)
    d.until(lambda: FILM in d.window.shell.stage.rects)
    d.window.amend(d.window.state.with_options(filming={**SMALL, **options}))
    d.settle()


def leave(d: Driver) -> None:
    d.window.shell.stage.show(FILM, False)
    d.ctx.yield_(3)
    hello_imgui.switch_layout(layout.LAYOUTS[0].name)
    d.ctx.yield_(5)


def names(d: Driver) -> list[str]:
    return [item.name for item in outside_view(d).extra]


def ghost(d: Driver) -> list[float]:
    edges = next(item for item in outside_view(d).extra if item.name == "second edges")
    assert isinstance(edges, Segments)
    return edges.segments[0, 0].tolist()


def drive_a_path_is_drawn_and_scrubbed_and_the_camera_stays(d: Driver) -> None:
    enter(d, seconds=4.0)
    camera, steps = d.window.state.camera, len(d.window.history.past)
    assert "film path" in names(d) and "film key 1" not in names(d)
    first = ghost(d)
    assert first == list(camera.eye)
    d.ctx.item_click(f"{WINDOW}/##frame")  # its middle
    d.settle()
    opposite = ghost(d)
    middle = [(one + two) / 2 for one, two in zip(first, opposite, strict=True)]
    center = d.window.focus.center
    radius = math.hypot(first[0] - center[0], first[2] - center[2])
    near = radius * 2 * math.pi / 50  # two frames of the hundred: as near as a click comes
    assert abs(middle[0] - center[0]) < near and abs(middle[2] - center[2]) < near
    d.ctx.item_click(f"{WINDOW}/###play")
    d.until(lambda: ghost(d) != opposite)
    d.ctx.item_click(f"{WINDOW}/###play")
    # Paths that lack something say what.
    d.window.amend(d.window.state.with_options(filming={"path": "bookmarks"}))
    d.settle()
    assert not names(d)
    state = with_bookmark(with_bookmark(d.window.state, 1), 2)
    d.window.amend(state)
    d.settle()
    assert {"film path", "film key 1", "film key 2"} <= set(names(d))
    keys = d.folder / "keys.toml"
    keys.write_text(keys_text([Key(d.window.state.view)] * 3))
    chosen = {"path": "file", "file": stored(str(keys))}
    d.window.amend(d.window.state.with_options(filming=chosen))
    d.settle()
    assert "film key 3" in names(d)
    d.window.amend(d.window.state.with_options(filming={"path": "photographs"}))
    d.settle()
    assert not names(d)
    assert d.window.state.camera == camera and len(d.window.history.past) == steps
    leave(d)
    assert not names(d)


def save_as(d: Driver, path: Path) -> None:
    d.ctx.item_click(f"{WINDOW}/Save film...")
    d.until(lambda: d.window.files.dialog.is_open)
    question = d.window.files.dialog.question
    d.window.files.dialog.cancel()
    d.ctx.yield_(2)
    question.chosen([str(path)])


def drive_a_film_is_saved_cancelled_and_gone_on_with(d: Driver) -> None:
    path, making = d.folder / "orbit.gif", view(d).making
    enter(d, seconds=60.0)
    save_as(d, path)
    d.until(lambda: making.part > 0)
    d.ctx.item_click(f"{WINDOW}/Cancel")
    d.until(lambda: not making.busy)
    there = len(list(Path(f"{path}.frames").glob("*.png")))
    assert 0 < there < 600 and not path.exists()
    d.until(lambda: any("under the same name" in text for text in d.window.shell.toasts.texts))
    save_as(d, path)
    d.until(lambda: making.first >= there / 600)
    d.ctx.item_click(f"{WINDOW}/Cancel")
    d.until(lambda: not making.busy)
    d.window.amend(d.window.state.with_options(filming={"seconds": 0.5}))
    save_as(d, path)
    d.until(lambda: making.busy)
    d.until(lambda: not making.busy)
    with Image.open(path) as film:
        assert film.n_frames == 5 and film.size == (32, 18)
    # What cannot be written is said at once.
    d.window.amend(d.window.state.with_options(filming={"size": (33, 18), "form": ".mp4"}))
    d.ctx.yield_(2)
    save_as(d, d.folder / "odd.mp4")
    assert "has an odd side" in d.window.files.message and not making.busy
    assert d.window.state.of(FilmingOptions).seconds == 0.5
    leave(d)
