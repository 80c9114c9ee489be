"""Exercises on the screen: fields to type into, options to select, and the replies."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.state.kept_lecture import Answers, Judgement
from lucida.app.ui import theme
from lucida.app.ui.areas import press_area
from lucida.app.ui.checks import verdict_sign
from lucida.app.ui.explaining import symbols
from lucida.app.ui.formula import vector_colors
from lucida.app.ui.lettering import lettering, underline
from lucida.app.ui.rows import button_width, follow
from lucida.app.ui.theme import Fonts

from .exercises import ChoiceExercise, TypedExercise
from .hiding import HideExercise
from .model import Exercise
from .slide import Slides
from .text import parse

LETTERS = "ABCDEFGH"


def _option_px(size: float) -> tuple[float, float]:
    """Return an option's margin, and the width of that margin and its letter."""
    return 0.34 * size, 1.9 * size


def exercise(
    task: Exercise,
    answers: Answers,
    slides: Slides,
    fonts: Fonts,
    said: Judgement | None = None,
) -> bool:
    """Draw an exercise, and store the user's input.

    said: the reply to an exercise that is answered in the views; None until it is known.
    Return True if the solution must be shown in the views.
    """
    room = imgui.get_content_region_avail()
    if imgui.get_scroll_max_y() <= 0:  # the reply to an answer may need a scrollbar
        room.x -= imgui.get_style().scrollbar_size
    size = imgui.get_font_size()
    slides.text(parse(task.question), room.x)
    imgui.dummy(ImVec2(0, 0.4 * size))
    asked = False
    if isinstance(task, HideExercise):
        _solution(answers)
        if answers.solved:
            follow(button_width("Put it there"))
            asked = imgui.button("Put it there")
    elif isinstance(task, ChoiceExercise):
        _choice(task, answers, slides, size)
    else:
        _vectors(task, answers, fonts, size)
    if reply := said or answers.verdict:
        imgui.dummy(ImVec2(0, 0.3 * size))
        wrong = theme.TEXT if said else theme.legible(theme.ERROR)
        slides.text(parse(reply.text), room.x, theme.GOOD if reply.right else wrong)
    if answers.solved:
        imgui.dummy(ImVec2(0, 0.3 * size))
        slides.text(parse(task.solution()), room.x)
    return asked


def _vectors(task: TypedExercise, answers: Answers, fonts: Fonts, size: float) -> None:
    entered = False
    shown = {name: symbols.answer(name) for name in task.fields}
    wide = max(imgui.calc_text_size(name).x for name in shown.values()) + 0.8 * size
    for name in task.fields:
        start = imgui.get_cursor_pos_x()
        imgui.align_text_to_frame_padding()
        wrong = answers.verdict is not None and answers.verdict.field == name
        vector = vector_colors().get(name)
        color = theme.TEXT if vector is None else theme.legible(vector)
        with lettering(fonts.text if vector is None else fonts.bold):
            imgui.text_colored(theme.legible(theme.ERROR) if wrong else color, shown[name])
            if wrong:
                underline(theme.legible(theme.ERROR))
        imgui.same_line(start + wide)
        imgui.set_next_item_width(-1)
        with lettering(fonts.mono):
            done, text = imgui.input_text_with_hint(
                f"##{name}",
                "( , , )",
                answers.texts.get(name, ""),
                imgui.InputTextFlags_.enter_returns_true,
            )
        if text != answers.texts.get(name, ""):
            answers.texts[name] = text
            answers.verdict = None
        entered = entered or done
    imgui.dummy(ImVec2(0, 0.2 * size))
    if imgui.button("Check") or entered:
        answers.verdict = task.check(answers.texts)
    follow(button_width(_solution_label(answers)))
    _solution(answers)


def _choice(task: ChoiceExercise, answers: Answers, slides: Slides, size: float) -> None:
    for number, option in enumerate(task.options):
        chosen = answers.chosen == number
        width = imgui.get_content_region_avail().x
        pad, letter = _option_px(size)
        blocks = parse(option.text)
        height = slides.height(blocks, width - letter - pad) + 2 * pad
        corner = imgui.get_cursor_screen_pos()
        if press_area(f"option {number}", ImVec2(width, height)):
            answers.chosen, answers.verdict = number, task.check(number)
        hovered = imgui.is_item_hovered()
        fill = theme.FRAME_HOVERED if hovered else theme.FRAME
        edge = theme.LINE
        if chosen and answers.verdict is not None:
            edge = theme.GOOD if answers.verdict.right else theme.ERROR
        draw = imgui.get_window_draw_list()
        far = ImVec2(corner.x + width, corner.y + height)
        draw.add_rect_filled(corner, far, theme.u32(fill), theme.px(4))
        draw.add_rect(corner, far, theme.u32(edge), theme.px(4), theme.line_px(2 if chosen else 1))
        at = ImVec2(corner.x + 0.6 * size, corner.y + pad + 0.16 * size)
        draw.add_text(at, theme.u32(theme.DIM), LETTERS[number % len(LETTERS)])
        if chosen and answers.verdict is not None:
            verdict_sign(ImVec2(far.x - 0.8 * size, at.y + 0.5 * size), answers.verdict.right)
        below = imgui.get_cursor_screen_pos()
        imgui.set_cursor_screen_pos(ImVec2(corner.x + letter, corner.y + pad))
        slides.text(blocks, width - letter - pad)
        imgui.set_cursor_screen_pos(below)
    imgui.dummy(ImVec2(0, 0.1 * size))
    _solution(answers)


def _solution(answers: Answers) -> None:
    label = _solution_label(answers)
    if button_width(label) > imgui.get_content_region_avail().x:
        label = label.partition(" ")[0]
    if imgui.button(f"{label}###solution"):
        answers.solved = not answers.solved


def _solution_label(answers: Answers) -> str:
    return "Hide the solution" if answers.solved else "Show the solution"
