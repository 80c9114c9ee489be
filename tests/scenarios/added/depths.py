"""The instrument that docs/architecture.md adds, in the window; run by test_new_instrument.py."""

from __future__ import annotations

import numpy as np
from app.depths.view import DepthsView
from window_driver import Driver, Key

from app.host import layout
from app.lecture.reading import load_lecture
from app.state.changes import change
from app.window.shortcut_sheet import sections

WINDOW = "//###Depths"
CTRL, SHIFT = int(Key.mod_ctrl), int(Key.mod_shift)


def bars(d: Driver) -> int:
    return d.window.state.options.depths.bars


def view(d: Driver) -> DepthsView:
    found = d.window.views["Depths"]
    assert isinstance(found, DepthsView)
    return found


def press(d: Driver, *chords: int) -> None:
    for chord in chords:
        d.ctx.key_press(chord)
        d.ctx.yield_(2)


def command(d: Driver, words: str) -> None:
    """By the palette."""
    press(d, CTRL | SHIFT | int(Key.p))
    d.ctx.key_chars(words)
    d.ctx.yield_(2)
    press(d, int(Key.enter))


def enter(d: Driver) -> None:
    layout.switch("Probe")
    d.ctx.yield_(5)
    d.window.shell.stage.show("Depths")
    d.settle()


def drive_the_menu_shows_and_hides_it(d: Driver) -> None:
    stage = d.window.shell.stage
    layout.switch("Side by side")
    d.ctx.yield_(5)
    assert not stage.is_shown("Depths")
    d.ctx.menu_click("//##MainMenuBar/View/Views/###Depths")
    d.settle()
    assert stage.is_shown("Depths") and "Depths" in stage.rects
    d.picture()
    d.ctx.menu_click("//##MainMenuBar/View/Views/###Depths")
    d.settle()
    assert not stage.is_shown("Depths")


def drive_its_layout_has_its_place(d: Driver) -> None:
    layout.switch("Probe")
    d.ctx.yield_(5)
    layout.reset()
    d.settle()
    stage = d.window.shell.stage
    assert stage.is_shown("Depths")
    docks = layout.docks(stage.views.values())
    assert docks["Depths"] == docks["Probe"] != 0


def drive_it_counts_what_is_seen(d: Driver) -> None:
    enter(d)
    image = d.window.renderers.ray_image
    assert image is not None and image.factor == 1
    seen = np.isfinite(image.frame.channel("depth"))
    assert len(view(d).counts) == bars(d) == 16
    assert view(d).counts.sum() == seen.sum() > 100
    d.picture()


def drive_actions_by_menu_key_and_palette(d: Driver) -> None:
    enter(d)
    d.ctx.menu_click("//##MainMenuBar/View/Depths/Finer depths")
    assert bars(d) == 32
    press(d, int(Key.j))
    assert bars(d) == 64
    press(d, int(Key.j))
    assert bars(d) == 64  # its bound
    press(d, SHIFT | int(Key.j))
    assert bars(d) == 32
    command(d, "coarser depths")
    assert bars(d) == 16
    d.settle()
    assert len(view(d).counts) == 16
    d.window.shell.stage.show("Depths", False)
    command(d, "z-buffer")
    assert d.window.shell.stage.is_shown("Depths")
    rows = [row for _, rows in sections() for row in rows]
    assert ("J", "Finer depths") in rows and ("Shift+J", "Coarser depths") in rows


def drive_undo_takes_it_back(d: Driver) -> None:
    enter(d)
    press(d, int(Key.j))
    (before,) = d.window.history.past
    assert change(before, d.window.state) == "bars"
    press(d, CTRL | int(Key.z))
    assert bars(d) == 16 and d.window.state == d.start
    press(d, CTRL | SHIFT | int(Key.z))
    assert bars(d) == 32
    # A drag of its slider is one step.
    box = d.ctx.item_info(f"{WINDOW}/bars").rect_full
    middle = box.get_center()
    d.drag((middle.x, middle.y), (box.max.x - 2, middle.y))
    assert bars(d) == 64
    assert len(d.window.history.past) == 2
    press(d, CTRL | int(Key.z))
    assert bars(d) == 32


def drive_a_lecture_shows_it(d: Driver) -> None:
    path = d.folder / "lecture.toml"
    lecture = load_lecture(path)
    d.window.lecture.give(lecture, path)
    d.ctx.yield_(5)
    d.settle()
    stage = d.window.shell.stage
    assert {view.name for view in stage.shown} == {"Depths", "Ray", "Lecture"}
    assert bars(d) == 8 and d.window.state.options.highlight == ("depths",)
    d.until(lambda: len(view(d).counts) == 8)
    d.picture()
    press(d, int(Key.page_down))
    d.settle()
    assert {view.name for view in stage.shown} == {"Raster", "Lecture"}
    assert bars(d) == 16  # what a step does not say has its default
    d.window.lecture.leave(d.window)
