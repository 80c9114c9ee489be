"""The mistakes: lines made wrong by the mouse, their pictures on the screen, and the quiz."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from imgui_bundle import imgui
from maximised import Maximised
from window_driver import Driver, Key, changed

from app.lecture.reading import BUILTIN, load_lecture
from app.mistakes import model, pages
from app.mistakes import question as quiz
from app.mistakes.options import MistakesOptions
from app.mistakes.view import MISTAKES, MistakesView
from app.outside.view import OUTSIDE, OutsideView
from app.widgets import lettering

ALONE = Maximised(MistakesView, "mistakes")
SHIFT = int(Key.mod_shift)


def _options(d: Driver) -> MistakesOptions:
    return d.window.state.of(MistakesOptions)


def _item(name: str) -> str:
    """In any of the view's parts."""
    return ALONE.item(f"**/{name}")


def _on_screen(d: Driver, name: str, size: tuple[int, int]) -> np.ndarray:
    """The middles of a picture's pixels as the window shows them, (H, W, 3)."""
    box = d.ctx.item_info(_item(name)).rect_full
    d.ctx.mouse_teleport_to_pos((3, 3))
    d.ctx.yield_(2)
    y = np.linspace(box.min.y, box.max.y, 2 * size[1] + 1)[1::2].astype(int)
    x = np.linspace(box.min.x, box.max.x, 2 * size[0] + 1)[1::2].astype(int)
    return d.picture()[y][:, x]


def _is_shown(d: Driver, name: str, light: np.ndarray, size: tuple[int, int]) -> bool:
    wanted = model.shown(light, d.window.state.images.exposure_ev).astype(int)
    seen = _on_screen(d, name, size)
    return bool((np.abs(seen.astype(int) - wanted).max(axis=2) <= 6).mean() > 0.95)


def _choose(d: Driver, line: str, mistake: str) -> None:
    d.ctx.item_click(_item(f"line {line}"))
    d.ctx.yield_(2)
    d.ctx.item_click(f"//$FOCUSED/{mistake}")
    d.settle()


def drive_lines_are_made_wrong_and_right_again(d: Driver) -> None:
    view = ALONE.open(d, columns=32)
    assert _options(d).chosen == ("rows count upwards",)
    made = view.made
    assert made is not None and made.compared is not None
    size = made.now.size
    assert _is_shown(d, "right", made.compared.right, size)
    assert _is_shown(d, "wrong", made.compared.wrong, size)
    _choose(d, "direction", "along +w")
    assert _options(d).chosen == ("rows count upwards", "along +w")
    again = view.made
    assert again is not None and len(again.mistakes) == 2
    d.window.undo()
    d.settle()
    assert _options(d).chosen == ("rows count upwards",)
    _choose(d, "y", "correct")
    assert _options(d).chosen == ()
    made = view.made
    assert made is not None and not made.mistakes
    ALONE.close(d)
    assert view.made is None


def drive_pictures_follow_the_camera(d: Driver) -> None:
    view = ALONE.open(d, columns=32)
    before = view.made
    assert before is not None and before.compared is not None
    camera = d.window.state.camera
    x, y, z = camera.eye
    d.window.change(d.window.state.with_camera(replace(camera, eye=(x + 0.5, y, z))))
    d.settle()
    after = view.made
    assert after is not None and after.compared is not None and after.now != before.now
    assert not np.array_equal(after.compared.wrong, before.compared.wrong)
    parallel = replace(camera, projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5))
    d.window.change(d.window.state.with_camera(parallel))
    d.settle()
    last = view.made
    assert last is not None and last.now.camera.is_parallel and last.mistakes
    _choose(d, "origin", "no eye")
    assert "no eye" in _options(d).chosen
    ALONE.close(d)


def drive_a_click_marks_a_pixel_in_all_views(d: Driver) -> None:
    view = ALONE.open(d, columns=16)
    d.ctx.item_click(_item("wrong"))
    d.settle()
    assert d.window.state.marked is not None
    made = view.made
    assert made is not None and made.compared is not None and made.compared.ray is not None
    d.ctx.item_click(_item("wrong"))
    d.settle()
    assert d.window.state.marked is None
    ALONE.close(d)


def drive_the_outside_view_shows_the_wrong_camera(d: Driver) -> None:
    d.window.shell.stage.show(OUTSIDE)
    d.settle()
    d.window.shell.stage.show(MISTAKES)
    d.window.change(d.window.state.with_options(marked=(100, 100)))
    d.settle()
    view = d.window.view(MistakesView)
    names = {item.name for item in d.window.view(OutsideView).extra}
    assert view.made is not None and {"second edges", "second ray"} <= names
    _ = d.picture()
    d.window.change(d.window.state.with_options(mistakes={"chosen": ()}))
    d.settle()
    assert not d.window.view(OutsideView).extra
    d.window.change(d.window.state.with_options(mistakes={"chosen": ("no eye",)}))
    d.settle()
    assert d.window.view(OutsideView).extra
    d.window.shell.stage.show(MISTAKES, False)
    d.settle()
    assert not d.window.view(OutsideView).extra  # who is not seen shows nothing


def drive_a_line_is_asked_for(d: Driver) -> None:
    view = ALONE.open(d, columns=32)
    d.ctx.item_click(ALONE.item("which line?##mode"))
    d.settle()
    assert _options(d).mode == "which-line"
    made = view.made
    assert made is not None and made.question is not None
    asked = made.question
    assert len(asked.names) == quiz.CHOICES
    assert _is_shown(d, "wrong", asked.pictures[asked.right_at], made.now.size)
    before = d.picture()
    d.ctx.item_click(_item(f"choice {quiz.LETTERS[asked.right_at]}"))
    d.settle()
    options = _options(d)
    assert options.answer == asked.names[asked.right_at] and options.score == (1, 1)
    assert changed(before, d.picture()) > 0
    d.window.undo()
    d.settle()
    assert _options(d).answer == "" and _options(d).score == (0, 0)
    made = view.made
    assert made is not None and made.question is not None
    assert made.question.names == asked.names  # undo brings the very question back
    # A, by its letter, once the view has the keyboard.
    d.ctx.key_press(int(Key.a))
    d.settle()
    assert _options(d).answer == asked.names[0]
    d.ctx.key_press(SHIFT | int(Key.r))
    d.settle()
    assert _options(d).seed == 2 and _options(d).answer == ""
    made = view.made
    assert made is not None and made.question is not None
    assert made.question.names != asked.names
    d.ctx.key_press(int(Key._3))
    d.settle()
    assert _options(d).answer == made.question.names[2] and _options(d).score[1] == 2
    ALONE.close(d)


def drive_a_picture_is_asked_for(d: Driver) -> None:
    view = ALONE.open(d, columns=32, mode="which-picture", asked="rows count upwards")
    made = view.made
    assert made is not None and made.question is not None
    asked = made.question
    for number, light in enumerate(asked.pictures):
        assert _is_shown(d, f"picture {number}", light, made.now.size)
    assert not d.window.view(OutsideView).extra
    d.ctx.key_press(int(Key.r))
    d.settle()
    assert _options(d).revealed and _options(d).score == (0, 0)
    d.ctx.key_press(int(Key.r))
    d.settle()
    assert not _options(d).revealed
    d.ctx.item_click(_item(f"picture {(asked.right_at + 1) % 4}"))
    d.settle()
    assert _options(d).revealed and _options(d).score == (0, 1)
    d.ctx.item_click(ALONE.item("next question"))
    d.settle()
    assert _options(d).asked == "" and not _options(d).revealed
    # A mistake that this camera cannot show is no question.
    d.window.change(d.window.state.with_options(mistakes={"asked": "normalised"}))
    d.settle()
    assert view.made is not None and view.made.question is not None
    assert not view.made.question.names
    d.ctx.key_press(SHIFT | int(Key._1))
    d.settle()
    assert _options(d).answer == "" and _options(d).score == (0, 1)
    ALONE.close(d)


def drive_the_reason_is_in_sight_in_a_low_view(d: Driver) -> None:
    """The answers may have to be scrolled there, in large type."""
    drawn: dict[str, float] = {}
    coded_text = pages.coded_text

    def told(text: str, *arguments: Any) -> None:
        at, low = imgui.get_cursor_screen_pos().y, imgui.get_window_pos().y
        drawn[text] = at if low <= at < low + 0.5 * imgui.get_window_size().y else -1.0
        coded_text(text, *arguments)

    view = ALONE.open(d, columns=32, mode="which-line")
    d.window.change(d.window.state.with_options(preferences={"font_scale": 3.0}))
    d.settle()
    assert view.made is not None and view.made.question is not None
    answer = _item(f"choice {quiz.LETTERS[3]}")
    d.ctx.scroll_to_item_y(answer)
    pages.coded_text = told  # type: ignore[assignment]
    try:
        d.ctx.item_click(answer)
        d.settle()
        drawn.clear()
        d.picture()
        reasons = [at for text, at in drawn.items() if text.startswith(("Correct: ", "Not D"))]
        assert len(reasons) == 1 and reasons[0] >= 0, drawn
    finally:
        pages.coded_text = coded_text
        d.window.change(d.window.state.with_options(preferences={"font_scale": 1.0}))
    ALONE.close(d)


def drive_captions_are_whole_in_large_type(d: Driver) -> None:
    cut: list[str] = []
    fitting_words = lettering.fitting_words

    def fitted(text: str, width_px: float) -> str:
        shown = fitting_words(text, width_px)
        cut.extend([text] * (shown != text))
        return shown

    view = ALONE.open(d, columns=32, chosen=("normalised",))
    lettering.fitting_words = fitted  # type: ignore[assignment]
    try:
        for scale in (1.0, 3.0):
            d.window.change(d.window.state.with_options(preferences={"font_scale": scale}))
            d.settle()
            assert view.made is not None and view.made.mistakes
            cut.clear()
            d.picture()
            assert not cut, (scale, set(cut), imgui.get_io().display_size)
    finally:
        lettering.fitting_words = fitting_words  # type: ignore[assignment]
        d.window.change(d.window.state.with_options(preferences={"font_scale": 1.0}))
    ALONE.close(d)


def drive_the_lecture_asks(d: Driver) -> None:
    lecture = load_lecture(BUILTIN)
    titles = [step.title for step in lecture.steps]
    d.window.lecture.give(lecture, BUILTIN, titles.index("Exercise: what if?"))
    d.settle()
    made = d.window.view(MistakesView).made
    assert made is not None and made.question is not None
    asked = made.question
    assert asked.names[asked.right_at] == "rows count upwards"
    # The lecture's column has the keyboard: the keys hold there too.
    d.ctx.key_press(SHIFT | (int(Key._1) + asked.right_at))
    d.settle()
    assert _options(d).score == (1, 1)
    _ = d.picture()
    d.window.lecture.restore(d.window)
    d.settle()
    assert _options(d).answer == "" and _options(d).asked == "rows count upwards"
    d.window.lecture.leave(d.window)
    d.settle()
