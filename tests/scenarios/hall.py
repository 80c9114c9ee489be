"""Type in a lecture hall: what is read grows with it, and is not cut."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from imgui_bundle import imgui
from window_driver import Driver

from app.lecture import slide
from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.view import LECTURE
from app.stepper import panel
from app.stepper.plan import Need, StepperPlan, plan
from app.storage.kept_lecture import Judgement
from app.widgets.code import LINE

SCALES = (1.0, 1.25, 1.5, 2.0)
STEPPER_STEPS, TEXT_STEPS = (12, 13), (3, 0)
KINDS_STEP = 8


@contextmanager
def plans() -> Iterator[list[tuple[StepperPlan, Need]]]:
    """What the stepper has been laid out by."""
    made: list[tuple[StepperPlan, Need]] = []

    def told(room: Any, need: Need) -> StepperPlan:
        made.append((plan(room, need), need))
        return made[-1][0]

    panel.plan = told  # type: ignore[assignment]
    try:
        yield made
    finally:
        panel.plan = plan


@contextmanager
def text_sizes() -> Iterator[list[float]]:
    """The sizes that a lecture's texts are drawn in."""
    sizes: list[float] = []
    fitting_px = slide.Slides.fitting_px

    def told(self: slide.Slides, *arguments: Any) -> float:
        sizes.append(fitting_px(self, *arguments))
        return sizes[-1]

    slide.Slides.fitting_px = told  # type: ignore[method-assign]
    try:
        yield sizes
    finally:
        slide.Slides.fitting_px = fitting_px  # type: ignore[method-assign]


def enlarge(d: Driver, scale: float) -> None:
    d.window.change(d.window.state.with_options(preferences={"font_scale": scale}))
    d.settle()


def drive_code_and_text_grow_with_the_type(d: Driver) -> None:
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    with plans() as made, text_sizes() as sizes:
        for number in STEPPER_STEPS:
            d.window.lecture.go(d.window, number)
            code_px = []
            for scale in SCALES:
                enlarge(d, scale)
                now, need = made[-1]
                assert now.code.height >= need.lines * LINE * now.code_px  # no line is cut off
                assert need.longest * 0.5 * now.code_px <= now.code.width
                code_px.append(now.code_px)
                legible_px = imgui.get_io().display_size.y / 45  # 12 of a slide's 540 points
                assert min(now.code_px, now.numbers_px) > 0.93 * legible_px, (scale, now)
            # But for the padding round the view, which grows, too, and where nothing is left.
            assert min(code_px) > 0.98 * code_px[0], code_px
            enlarge(d, 1.0)
        for number in TEXT_STEPS:
            d.window.lecture.go(d.window, number)
            text_px = []
            for scale in SCALES:
                enlarge(d, scale)
                text_px.append(sizes[-1])
            assert text_px == sorted(text_px) and text_px[-1] > 1.2 * text_px[0], text_px
            enlarge(d, 1.0)
    d.window.lecture.leave(d.window)
    d.settle()


def drive_exercises_fill_their_column(d: Driver) -> None:
    """As large as the longest reply leaves room for: nothing moves when it is said."""
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    session = d.window.lecture.session
    assert session is not None
    sizes: list[float] = []
    least, larger = slide.EXERCISE * imgui.get_io().display_size.y, 0
    text = slide.Slides.text

    def told(self: slide.Slides, blocks: Any, *arguments: Any) -> float:
        sizes.append(text(self, blocks, *arguments))
        return sizes[-1]

    slide.Slides.text = told  # type: ignore[method-assign]
    try:
        for number, step in enumerate(session.lecture.steps):
            task = step.exercise
            if task is None:
                continue
            d.window.lecture.go(d.window, number)
            d.settle()
            column = d.ctx.window_info(f"//{LECTURE}/step").window
            assert column is not None
            asked = sizes[-1]
            session.answers.verdict = Judgement(False, max(task.replies, key=len))
            d.settle()
            assert sizes[-1] == asked, step.title  # nothing moves
            assert column.scroll_max.y == 0, (step.title, column.scroll_max.y, asked, least)
            larger += asked > 1.05 * least
            session.answers.verdict = None
    finally:
        slide.Slides.text = text  # type: ignore[method-assign]
    assert larger >= 3
    d.window.lecture.leave(d.window)
    d.settle()


def drive_no_word_beside_a_number_is_broken(d: Driver) -> None:
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    d.window.lecture.go(d.window, STEPPER_STEPS[0])
    lines: list[float] = []
    text_colored = imgui.text_colored

    def told(color: Any, text: str) -> None:
        text_colored(color, text)
        if text in ("inside", "outside", "from 0"):
            lines.append(imgui.get_item_rect_size().y / imgui.get_text_line_height())

    imgui.text_colored = told
    try:
        enlarge(d, 2.0)
        assert lines and max(lines) < 1.5, max(lines)
    finally:
        imgui.text_colored = text_colored
    enlarge(d, 1.0)
    d.window.lecture.leave(d.window)
    d.settle()


def drive_the_lecture_ends(d: Driver) -> None:
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    d.window.lecture.go(d.window, 26)  # an image of 8 x 8 pixels
    d.settle()
    camera, scene = d.window.state.camera, d.window.state.scene
    d.ctx.menu_click("//##MainMenuBar/Lecture/End the lecture")
    d.settle()
    state = d.window.state
    assert not d.window.lecture.is_given and state.step is None
    assert (state.scene, state.camera) == (scene, camera)
    assert state.images.resolution is None and not state.preferences.presentation
    shown = {view.name for view in d.window.shell.stage.shown}
    assert {"Camera", "Raster", "Ray"} <= shown and LECTURE not in shown


def drive_the_laboratorys_table_is_whole_at_any_size(d: Driver) -> None:
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    d.window.lecture.go(d.window, KINDS_STEP)
    beyond: list[float] = []
    small_button = imgui.small_button

    def told(label: str) -> bool:
        pressed = small_button(label)
        edge = imgui.get_window_pos().x + imgui.get_window_size().x
        beyond.append(imgui.get_item_rect_max().x - edge)
        return bool(pressed)

    for scale in SCALES:
        enlarge(d, scale)
        imgui.small_button = told
        try:
            d.ctx.yield_(2)
        finally:
            imgui.small_button = small_button
        assert beyond and max(beyond) <= 0, (scale, max(beyond))
        beyond.clear()
    enlarge(d, 1.0)
    d.window.lecture.leave(d.window)
    d.settle()
