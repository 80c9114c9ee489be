"""The two pages, the laboratory and the quiz: their layout, from pictures that a thread has made.

panel.py and widgets/picture_grid.py draw the parts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from imgui_bundle import ImVec2, imgui

from app.checking.mistakes.program import Mistakes, Program
from app.mistakes import model, panel, question
from app.mistakes.model import Bytes, Compared, Situation
from app.mistakes.options import MistakesOptions
from app.mistakes.question import LETTERS, QuizQuestion
from app.state.options import Notation, Pixel
from app.widgets import theme
from app.widgets.coded_text import coded_text
from app.widgets.picture_grid import GridPicture, picture_grid
from app.widgets.theme import Fonts
from app.widgets.uploads import Uploads
from renderer.memo import Memo

WIDE = 1.2  # width / height of a page whose pictures are next to its text
LEAST_PART, MOST_PART = 0.45, 0.6  # of its width that the text then has
GAP_EM = 0.8  # between both
REFERENCE_PART = 0.36  # of the width below the text: the correct picture
LEAST_PICTURES_EM = 8.0  # the height of pictures below the text, at least
ANSWER_MARGIN, CARET_MARGIN = 5, 3  # letters before a choice's code; behind a line's
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
    text = _program_text(page, program, mistakes)
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
    changed = model.changed_pixels(right, wrong)
    difference = model.difference_picture(right, changed)
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
    told = (asked.problem,) if asked.problem else ()
    # First of all, and in place of the question: in a low view the rest may have to be scrolled.
    first = TITLES[options.mode]
    if options.revealed:
        first = _reason(made.now.program.in_notation(page.notation), asked, options)
    if options.mode == "which-line":
        return _which_line(page, made, asked, options, (first, *told))
    return _which_picture(page, made, asked, options, (first, *told))


def _which_line(
    page: Page, made: Made, asked: QuizQuestion, options: MistakesOptions, told: tuple[str, ...]
) -> int | None:
    program = made.now.program.in_notation(page.notation)
    lines = [_code(program, name, 999) for name in asked.names]
    text = _text(page, ANSWER_MARGIN + max(len(row) for one in lines for row in one))
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
    page: Page, made: Made, asked: QuizQuestion, options: MistakesOptions, told: tuple[str, ...]
) -> int | None:
    program = made.now.program.in_notation(page.notation)
    mistakes = model.named(program, (asked.names[asked.right_at],))
    keys = mistakes[0].keys
    lines = tuple(line for line in program.lines if line.key in keys)
    part = Program(lines, mistakes, program.results)  # the lines that the question is about
    text = _program_text(page, part, mistakes)
    _say(page, told, options, text)
    panel.program_lines(part, mistakes, text.width, page.fonts, page.notation, can_change=False)
    page.put(page.uploads, _choices, made, page.exposure_ev)
    reference = [GridPicture("right", "correct line", page.uploads.get("right"))]
    room = _pictures_room(
        page, text, lambda room: picture_grid(reference, made.now.size, room, page.fonts)
    )
    shown = []
    for number, name in enumerate(asked.names):
        caption = name if options.revealed else ""
        verdict = _verdict(asked, options, number)
        texture = page.uploads.get(f"picture {number}")
        title, frame = LETTERS[number] + panel.SAID[verdict], panel.verdict_color(verdict)
        shown.append(GridPicture(f"picture {number}", title, texture, caption, frame))
    clicked = picture_grid(shown, made.now.size, room, page.fonts)
    return clicked.number if clicked is not None else None


def _say(page: Page, told: tuple[str, ...], options: MistakesOptions, text: PageText) -> None:
    for number, one in enumerate(told):
        answered = bool(options.answer) and number == 0
        color = panel.verdict_color(one.startswith("Correct")) if answered else None
        coded_text(one, text.width, color or theme.TEXT, page.fonts)


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


def _text(page: Page, longest: int) -> PageText:
    """Put the pictures next to the text on a wide page, and below it on any other.

    longest: letters of the longest line of code.
    """
    room, corner = page.room, imgui.get_cursor_screen_pos()
    if room.x < WIDE * room.y:
        return PageText(corner, room.x, False)
    code = imgui.get_font_size() * (0.52 * longest + 2.0)  # a letter is half as wide as high
    return PageText(corner, min(max(code, LEAST_PART * room.x), MOST_PART * room.x), True)


def _program_text(page: Page, program: Program, mistakes: Mistakes) -> PageText:
    return _text(page, panel.longest_line(program, mistakes) + CARET_MARGIN)


def _pictures_room(
    page: Page, text: PageText, reference: Callable[[ImVec2], object] | None = None
) -> ImVec2:
    """Return the room for the pictures from the cursor on. Call after the text.

    reference: draws what comes before them: below a text that is next to them, else at their left.
    """
    here, gap = imgui.get_cursor_screen_pos(), GAP_EM * imgui.get_font_size()
    left = page.room.y - (here.y - text.corner.y)
    if text.beside:
        if reference is not None:
            reference(ImVec2(text.width, max(1.0, left)))
        imgui.set_cursor_screen_pos(ImVec2(text.corner.x + text.width + gap, text.corner.y))
        return ImVec2(max(1.0, page.room.x - text.width - gap), page.room.y)
    least = LEAST_PICTURES_EM * imgui.get_font_size()  # which is scrolled to
    room = ImVec2(page.room.x, max(least, left))
    if reference is not None:
        width = REFERENCE_PART * room.x
        reference(ImVec2(width - gap, room.y))
        imgui.set_cursor_screen_pos(ImVec2(here.x + width, here.y))
        room.x -= width
    return room
