"""The two pages, the laboratory and the quiz: their layout, from pictures that a thread has made.

panel.py and ui/picture_grid.py draw the parts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from imgui_bundle import ImVec2, imgui

from app.checking.mistakes.program import Mistakes, Program
from app.checking.reports.picture import changed_pixels, difference_picture
from app.instruments.mistakes import model, panel, question
from app.instruments.mistakes.model import Bytes, Compared, Situation
from app.instruments.mistakes.question import LETTERS, QuizQuestion
from app.state.options.mistakes import MistakesOptions
from app.state.options.shared import Notation, Pixel
from app.ui import theme
from app.ui.coded_text import coded_text
from app.ui.picture_grid import GridPicture, picture_grid
from app.ui.theme import Fonts
from app.ui.uploads import Uploads
from renderer.system.memo import Memo

WIDE = 1.2  # width / height of a page whose pictures are next to its text
TEXT_PART = 0.47  # of its width that the text then has
GAP_EM = 0.8  # between both
LEAST_PICTURES_EM = 8.0  # the height of pictures below the text, at least
ANSWER_MARGIN = 5  # letters before a choice's code
TITLES = {
    "which-line": "Which line made the second picture?",
    "which-picture": "Which picture does the wrong line make?",
}
STUDENTS = "student's"  # the wrong picture, and its camera in the outside view


@dataclass(frozen=True, eq=False)
class Made:
    """Pictures that the thread has made. of: the request."""

    of: Any
    now: Situation
    mistakes: Mistakes = ()
    compared: Compared | None = None
    question: QuizQuestion | None = None


Pictures = tuple[dict[str, Bytes], str]
MakePictures = Callable[[Made, float], Pictures]


def put_pictures(uploads: Uploads, make: MakePictures, made: Made, exposure_ev: float) -> str:
    """Upload the pictures that `make` returns. Return its text about them.

    Raises LucidaError if there is no memory for them.
    """
    pictures, told = make(made, exposure_ev)
    for name, picture in pictures.items():
        uploads.put_pixels(name, picture)
    return told


@dataclass(frozen=True)
class Page:
    """The target to draw into: its room, and the window's fonts and exposure.

    aspect: width / height of the pictures. put: put_pictures(), remembered.
    """

    room: ImVec2
    aspect: float
    fonts: Fonts
    exposure_ev: float
    uploads: Uploads
    put: Memo[Uploads, MakePictures, Made, float, str]
    notation: Notation


@dataclass(frozen=True)
class LaboratoryAnswer:
    """chosen: the mistakes that are to be on; None: as they are. pixel: that was clicked."""

    chosen: tuple[str, ...] | None = None
    pixel: Pixel | None = None


# The laboratory.


def laboratory(
    page: Page, now: Situation, made: Made | None, options: MistakesOptions
) -> LaboratoryAnswer:
    """Draw the program, the words on its wrong lines, and the pictures of both versions."""
    program = now.program.in_notation(page.notation)
    mistakes = model.named(program, options.chosen)
    told = [f"{one.hint} (lecture: {one.part})" for one in mistakes]
    text = _text(page)
    clicked = panel.program_lines(program, mistakes, text.width, page.fonts, page.notation)
    for one in told:
        coded_text(one, text.width, theme.TEXT, page.fonts)
    pixel = _compared(page, now, made, options, _pictures_room(page, text))
    if clicked is None:
        return LaboratoryAnswer(None, pixel)
    if clicked.mistake is None:
        return LaboratoryAnswer(model.without_line(program, options.chosen, clicked.key))
    return LaboratoryAnswer(model.switched(program, options.chosen, clicked.mistake.name))


def _compared(
    page: Page, now: Situation, made: Made | None, options: MistakesOptions, room: ImVec2
) -> Pixel | None:
    """Draw the correct picture, the wrong one, and their difference. Return the clicked pixel, or
    None.
    """
    if made is None or made.compared is None:
        imgui.text_colored(theme.DIM, "the first pictures are being traced ...")
        return None
    told = page.put(page.uploads, _comparison, made, page.exposure_ev)
    textures = page.uploads
    pixel = now.pixel if made.now.size == now.size else None
    shown = [GridPicture("right", "correct", textures.get("right"), pixel=pixel)]
    if made.mistakes:
        wrong = panel.wrong_color()
        shown.append(GridPicture("wrong", STUDENTS, textures.get("wrong"), "", wrong, pixel))
    if made.mistakes and options.difference:
        difference = textures.get("difference")
        shown.append(GridPicture("difference", "difference", difference, told))
    clicked = picture_grid(shown, made.now.size, room, page.fonts)
    return clicked.pixel if clicked is not None else None


def _comparison(made: Made, exposure_ev: float) -> Pictures:
    assert made.compared is not None
    both = made.compared
    right, wrong = (model.shown(one, exposure_ev) for one in (both.right, both.wrong))
    changed = changed_pixels(right, wrong)
    difference = difference_picture(right, changed)
    pictures = {"right": right, "wrong": wrong, "difference": difference}
    return pictures, model.told_difference(changed)


# The quiz.


def quiz(page: Page, made: Made | None, options: MistakesOptions) -> int | None:
    """Draw the question, and after the answer the reason. Return the number of the clicked
    answer.
    """
    asked = made.question if made is not None else None
    if made is None or asked is None:
        imgui.text_colored(theme.DIM, "drawing a question ...")
        return None
    if not asked.names:
        coded_text(asked.problem, page.room.x, theme.TEXT, page.fonts)
        return None
    # The reason replaces the question: in a low view the rest may have to be scrolled.
    told = TITLES[options.mode]
    if options.revealed:
        told = _reason(made.now.program.in_notation(page.notation), asked, options)
    if options.mode == "which-line":
        return _which_line(page, made, asked, options, told)
    return _which_picture(page, made, asked, options, told)


def _which_line(
    page: Page, made: Made, asked: QuizQuestion, options: MistakesOptions, told: str
) -> int | None:
    program = made.now.program.in_notation(page.notation)
    text = _text(page)
    letters = panel.letters_in(text.width) - ANSWER_MARGIN
    choices = [_code(program, name, letters) for name in asked.names]
    verdicts = [_verdict(asked, options, number) for number in range(len(choices))]
    _say(page, told, options, text)
    clicked = panel.choose_line(choices, verdicts, text.width, page.fonts)
    page.put(page.uploads, _choices, made, page.exposure_ev)
    wrong = page.uploads.get(f"picture {asked.right_at}")
    shown = [
        GridPicture("right", "correct", page.uploads.get("right")),
        GridPicture("wrong", STUDENTS, wrong, "", panel.wrong_color()),
    ]
    picture_grid(shown, made.now.size, _pictures_room(page, text), page.fonts)
    return clicked


def _which_picture(
    page: Page, made: Made, asked: QuizQuestion, options: MistakesOptions, told: str
) -> int | None:
    program = made.now.program.in_notation(page.notation)
    mistakes = model.named(program, (asked.names[asked.right_at],))
    keys = mistakes[0].keys
    lines = tuple(line for line in program.lines if line.key in keys)
    part = Program(lines, mistakes, program.results)  # the lines that the question is about
    text = _text(page)
    _say(page, told, options, text)
    panel.program_lines(part, mistakes, text.width, page.fonts, page.notation, can_change=False)
    page.put(page.uploads, _choices, made, page.exposure_ev)
    shown = [GridPicture("right", "correct line", page.uploads.get("right"))]
    for number, name in enumerate(asked.names):
        caption = name if options.revealed else ""
        verdict = _verdict(asked, options, number)
        texture = page.uploads.get(f"picture {number}")
        title, frame = LETTERS[number] + panel.SAID[verdict], panel.verdict_color(verdict)
        shown.append(GridPicture(f"picture {number}", title, texture, caption, frame))
    clicked = picture_grid(shown, made.now.size, _pictures_room(page, text), page.fonts)
    return clicked.number - 1 if clicked is not None and clicked.number else None


def _say(page: Page, told: str, options: MistakesOptions, text: PageText) -> None:
    color = panel.verdict_color(told.startswith("Correct")) if options.answer else None
    coded_text(told, text.width, color or theme.TEXT, page.fonts)


def _choices(made: Made, exposure_ev: float) -> Pictures:
    assert made.question is not None
    lights = {f"picture {n}": light for n, light in enumerate(made.question.pictures)}
    lights["right"] = made.question.right
    return {name: model.shown(one, exposure_ev) for name, one in lights.items()}, ""


def _code(program: Program, name: str, letters: int) -> tuple[str, ...]:
    mistake = next(one for one in program.mistakes if one.name == name)
    return tuple(row for _, code in mistake.lines for row in panel.rows_of(code, letters))


def _verdict(asked: QuizQuestion, options: MistakesOptions, number: int) -> bool | None:
    if not options.revealed:
        return None
    if number == asked.right_at:
        return True
    return False if asked.names[number] == options.answer else None


def _reason(program: Program, asked: QuizQuestion, options: MistakesOptions) -> str:
    truth = next(one for one in program.mistakes if one.name == asked.names[asked.right_at])
    said = question.reason(program, asked.names, asked.right_at, options.answer)
    return f"{said} (lecture: {truth.part})"


# Room.


@dataclass(frozen=True)
class PageText:
    """The layout of a page's text.

    corner: of the page, on the screen. beside: the pictures are next to the text, not below it.
    """

    corner: ImVec2
    width: float
    beside: bool


def _text(page: Page) -> PageText:
    """Put the pictures next to the text on a wide page, and below it on any other."""
    beside = page.room.x > WIDE * page.room.y
    width = TEXT_PART * page.room.x if beside else page.room.x
    return PageText(imgui.get_cursor_screen_pos(), width, beside)


def _pictures_room(page: Page, text: PageText) -> ImVec2:
    """Return the room for the pictures from the cursor on. Call after the text."""
    if text.beside:
        gap = GAP_EM * imgui.get_font_size()
        imgui.set_cursor_screen_pos(ImVec2(text.corner.x + text.width + gap, text.corner.y))
        return ImVec2(max(1.0, page.room.x - text.width - gap), page.room.y)
    left = page.room.y - (imgui.get_cursor_screen_pos().y - text.corner.y)
    least = LEAST_PICTURES_EM * imgui.get_font_size()  # which is scrolled to
    return ImVec2(page.room.x, max(least, left))
