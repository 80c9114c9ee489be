"""The image laboratory: every page in the window, its switches, and its pixels on the screen."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui
from maximised import Maximised
from window_driver import ATTEMPTS, Driver, Key

from app.laboratory.pages import PAGE_TITLES
from app.laboratory.view import LaboratoryView

ALONE = Maximised(LaboratoryView, "laboratory")


def _on_screen(d: Driver, number: int) -> np.ndarray:
    """The pixels of a panel's picture in the window."""
    box = d.ctx.item_info(ALONE.item(f"panel {number}")).rect_full
    left, top, right, bottom = (round(x) for x in (box.min.x, box.min.y, box.max.x, box.max.y))
    return d.picture()[top:bottom, left:right]


def _differing(d: Driver, view: LaboratoryView) -> list[tuple[int, float]]:
    """The panels that do not stand on the screen as they were computed, and what of them does.

    A picture that was made anew while the screen was read is one: the caller tries again.
    """
    found = []
    for number, panel in enumerate(view.made):
        seen, part = _on_screen(d, number), 0.0
        if seen.shape == panel.picture.shape:
            part = float((np.abs(seen.astype(int) - panel.picture) <= 1).all(axis=2).mean())
        if part <= 0.98:
            found.append((number, part))
    return found


def drive_every_page_shows_its_pictures(d: Driver) -> None:
    view = ALONE.open(d)
    for page, title in PAGE_TITLES.items():
        d.ctx.item_click(ALONE.item(f"{title}##page"))
        d.settle()
        assert d.window.state.options.laboratory.page == page
        d.ctx.mouse_teleport_to_pos((3, 3))
        d.ctx.yield_(2)
        # What was computed stands on the screen, pixel by pixel; frames may lie over it.
        for attempt in range(ATTEMPTS):
            differing = _differing(d, view)
            if not differing:
                break
            print(f"attempt {attempt}, {page}: panels and equal parts {differing}")
            d.settle()
        assert not differing, (page, differing)
    ALONE.close(d)


def drive_the_array_s_pixel_languages_and_orders(d: Driver) -> None:
    d.window.change(d.window.state.with_options(images={"resolution": (32, 24)}))
    view = ALONE.open(d, page="array")
    box = d.ctx.item_info(ALONE.item("panel 0")).rect_full
    unit = view.made[0].magnification
    assert unit >= 4
    d.ctx.mouse_move_to_pos((box.min.x + 10.5 * unit, box.min.y + 7.5 * unit))
    d.ctx.mouse_click(0)
    d.settle()
    assert d.window.state.marked == (7, 10)
    d.ctx.item_click(ALONE.item("Julia##language"))
    d.settle()
    d.ctx.item_click(ALONE.item("Copy"))
    d.ctx.yield_()
    assert imgui.get_clipboard_text().startswith("using Colors")
    assert d.window.state.options.language == "julia"
    assert "(i - 1) * W + (j - 1)" in imgui.get_clipboard_text()
    d.window.change(d.window.state.with_options(laboratory={"order": "column"}, one_based=False))
    d.settle()
    d.ctx.item_click(ALONE.item("Copy"))
    d.ctx.yield_()
    assert "(j * H + i)" in imgui.get_clipboard_text()
    d.ctx.item_click(ALONE.item("byte 0"))  # a pixel before it in memory: the same column
    d.settle()
    row, column = d.window.state.marked or (0, 0)
    assert column == 10 and row < 7
    d.window.undo()
    assert d.window.state.marked == (7, 10)
    d.ctx.item_click(ALONE.item("cell 0 0"))
    d.settle()
    assert d.window.state.marked != (7, 10)
    ALONE.close(d)


def drive_a_display_plays_stops_and_is_stepped(d: Driver) -> None:
    d.window.change(d.window.state.with_options(images={"resolution": (32, 24)}))
    view = ALONE.open(d, page="displays", display="dlp", phase=0.25, cycle_s=1.0)
    past = len(d.window.history.past)
    asked: list[None] = []
    animate = d.window.animate
    d.window.animate = lambda: (asked.append(None), animate())[1]  # type: ignore[method-assign]
    try:
        d.ctx.yield_(5)
        assert not asked  # at rest no frame is asked for
        still = view.made[0].picture
        d.ctx.item_click(ALONE.item("###play"))
        assert d.window.state.options.laboratory.playing
        seen: list[np.ndarray] = []
        d.until(lambda: _collected(seen, view.made[0].picture) > 4)
        assert asked and not view.settled
        d.ctx.item_click(ALONE.item("###play"))
        d.settle()
        options = d.window.state.options.laboratory
        assert not options.playing and options.phase != 0.25
        asked.clear()
        d.ctx.yield_(5)
        assert not asked
        d.window.change(d.window.state.with_options(laboratory={"phase": 0.25}))
        d.settle()
        np.testing.assert_array_equal(view.made[0].picture, still)
        past += 1  # by change()
        d.ctx.item_click(ALONE.item("Step"))
        d.settle()
        assert d.window.state.options.laboratory.phase == 13 / 48
        d.ctx.key_press(Key.left_arrow)
        d.settle()
        assert d.window.state.options.laboratory.phase == 12 / 48
        # Hidden, it rests, and goes on from there.
        d.ctx.key_press(Key.space)
        assert d.window.state.options.laboratory.playing
        d.window.change(d.window.state.with_options(laboratory={"page": "kinds"}))
        past += 1
        d.settle()
        asked.clear()
        d.ctx.yield_(5)
        assert not asked
        assert len(d.window.history.past) == past  # neither play nor steps are steps of undo
    finally:
        del d.window.animate
    d.window.change(d.window.state.with_options(laboratory={"playing": False}))
    ALONE.close(d)


def _collected(seen: list[np.ndarray], picture: np.ndarray) -> int:
    """Return the number of different pictures so far."""
    if not seen or (picture != seen[-1]).any():
        seen.append(picture)
    return len(seen)
