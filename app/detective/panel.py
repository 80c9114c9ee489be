"""The detective's panel: the text, its readings' pictures, and the selected one written down.

Takes values and returns requests.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import moderngl
from imgui_bundle import ImVec2, ImVec4, imgui

from app.detective import ranking, writing
from app.detective.model import Findings, beyond
from app.detective.options import DetectiveOptions
from app.detective.ranking import Ranked
from app.detective.readings import MIRRORED
from app.widgets import theme
from app.widgets.checks import radio_button
from app.widgets.lettering import lettering
from app.widgets.picture_grid import GAP_EM, HEADING_EM, GridPicture, columns_for, picture_grid
from app.widgets.rows import follow, tip
from app.widgets.theme import Fonts
from renderer.intrinsics import PixelOrigin

Picked = tuple[Ranked | None, int | None]
MatrixWish = Literal["", "paste", "example", "copy"]

INVITATION = (
    "Somebody has given you a camera as a matrix, and not said what it means: does it take the"
    " world to the camera or the camera to the world, does it stand by rows or by columns, which"
    " way do its axes point? Copy it, and press Ctrl+V: each reading is drawn in the scene that is"
    " open, the likeliest first. Click the picture that is correct."
)
FORMS = (
    "4 x 4 or 3 x 4, or R and t; K may stand beside, with the image's size. P = K [R | t], or"
    " projection times view. As NumPy, Python, MATLAB, C, JSON and others print them."
)
FLAT = imgui.ChildFlags_.nav_flattened  # Tab goes into it
BESIDE = 1.25  # width / height from which the text is next to the pictures
TEXT_PART, TEXT_EM, MOST_TEXT_EM = 0.34, 19.0, 34.0  # the text's part of the width then
ABOVE_LINES = 5.5  # of the text, if it is above
LEAST_PICTURE_EM = 11.5  # a picture's width, from which its words can be read
CODE_PART = 0.3  # of the height, for the part below the pictures
ORIGINS: dict[PixelOrigin, tuple[str, str]] = {
    "center": ("centres", "integers stand at the pixels' centres: OpenCV, ROS"),
    "corner": ("corners", "integers stand at corners, centres at .5: COLMAP, NeRF, renderers"),
}


@dataclass(frozen=True)
class DetectiveAnswer:
    """The user's input.

    options: as edited.
    chosen: the reading whose picture was clicked, or on which Enter was pressed.
    at: as in ReadingsShown, after the arrow keys.
    """

    options: DetectiveOptions
    wish: MatrixWish = ""
    chosen: Ranked | None = None
    at: int | None = None


@dataclass(frozen=True)
class ReadingsShown:
    """texture: of a reading's picture, by its number; None until it is there. here: the numbers of
    the readings that the camera is at. note: the progress or the error. at: the number of the one
    with the keyboard; None for none.
    """

    texture: Callable[[int], moderngl.Texture | None]
    here: frozenset[int] = frozenset()
    note: str = ""
    at: int | None = None


@dataclass(frozen=True)
class _Pressed:
    """Arrow keys, and Enter."""

    across: int = 0
    down: int = 0
    enter: bool = False


def panel(
    options: DetectiveOptions, findings: Findings, shown: ReadingsShown, fonts: Fonts
) -> DetectiveAnswer:
    """Draw everything into the current window."""
    wish, options = _controls(options, findings)
    if not options.text:
        _paragraph(INVITATION, theme.TEXT)
        _paragraph(FORMS, theme.DIM)
        return DetectiveAnswer(options, wish)
    pressed = _keys(shown.at is not None)
    room, em = imgui.get_content_region_avail(), imgui.get_font_size()
    chosen: Picked = (None, None)
    if room.x > BESIDE * room.y:
        width = min(max(TEXT_PART * room.x, TEXT_EM * em), MOST_TEXT_EM * em, 0.5 * room.x)
        if imgui.begin_child("text", ImVec2(width, room.y), FLAT):
            options = _text(options, 0.32 * room.y, fonts)
            wish = _told(options, findings, fonts) or wish
        imgui.end_child()
        imgui.same_line()
        room = imgui.get_content_region_avail()
        chosen = _pictures(findings, shown, options, room, fonts, pressed)
        return DetectiveAnswer(options, wish, *chosen)
    options = _text(options, min(ABOVE_LINES * em, 0.25 * room.y), fonts)
    left = imgui.get_content_region_avail()
    if findings.given is not None:
        room = ImVec2(left.x, left.y - CODE_PART * room.y)
        chosen = _pictures(findings, shown, options, room, fonts, pressed)
    if imgui.begin_child("told", ImVec2(0, 0), FLAT):
        wish = _told(options, findings, fonts) or wish
    imgui.end_child()
    return DetectiveAnswer(options, wish, *chosen)


def _controls(options: DetectiveOptions, findings: Findings) -> tuple[MatrixWish, DetectiveOptions]:
    wish: MatrixWish = ""
    if imgui.button("Paste"):
        wish = "paste"
    tip("the matrix that is in the clipboard (Ctrl+V)")
    if _button("Practice matrix"):
        wish = "example"
    tip("the present camera, as another program would print it: which program, which way?")
    if options.text and findings.counts_pixels:
        label = "integers at pixels'"
        follow(imgui.calc_text_size(label).x)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, label)
        for origin, (name, said) in ORIGINS.items():
            follow(imgui.calc_text_size(name).x + 1.5 * imgui.get_frame_height())
            if radio_button(f"{name}##origin", options.pixel_origin == origin):
                options = replace(options, pixel_origin=origin)
            tip(said)
    return wish, options


def _button(label: str) -> bool:
    follow(imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x)
    return bool(imgui.button(label))


def _text(options: DetectiveOptions, height: float, fonts: Fonts) -> DetectiveOptions:
    """Draw the pasted text, to correct or extend; no higher than necessary."""
    lines, em = options.text.split("\n"), imgui.get_font_size()
    height = min(height, 1.15 * em * max(len(lines) + 2, 5))
    with lettering(fonts.mono):
        edited, text = imgui.input_text_multiline("##matrix", options.text, ImVec2(-1, height))
    return replace(options, text=text, chosen="") if edited else options


def _told(options: DetectiveOptions, findings: Findings, fonts: Fonts) -> MatrixWish:
    """Draw the error in the text, or how the selected reading is written down."""
    wish: MatrixWish = ""
    if findings.error:
        _paragraph(findings.error, theme.ERROR)
        return wish
    assert findings.given is not None
    if told := beyond(findings.given):
        _paragraph(told, theme.legible(theme.MARK))
    chosen = findings.named(options.chosen)
    if chosen is None:
        _paragraph(
            "Which picture is correct? Click it, or go there with the arrow keys.", theme.TEXT
        )
        _paragraph(_aside(findings), theme.DIM)
        return wish
    up, convention = findings.case.up, chosen.reading.convention
    _paragraph(ranking.sentence(chosen, up), theme.TEXT)
    if convention.axes:
        _paragraph(writing.WHO[convention.axes], theme.DIM)
    _paragraph(writing.formula(convention, up), theme.TEXT)
    if imgui.button("Copy as Python"):
        wish = "copy"
    text = code_of(findings, chosen)
    with lettering(fonts.mono):
        imgui.text_unformatted(text)
    return wish


def code_of(findings: Findings, one: Ranked) -> str:
    assert findings.given is not None
    case = findings.case
    return writing.code(one.reading, findings.given, case.up, case.pixel_origin)


def _aside(findings: Findings) -> str:
    """Draw the number of further readings, and the impossible ones."""
    words = []
    if findings.others:
        words.append(f"{findings.others} readings that are less likely are not shown.")
    words += [f"Not {name}: {reason}." for name, reason in findings.left_out if reason != MIRRORED]
    mirrored = sum(reason == MIRRORED for _, reason in findings.left_out)
    if mirrored:
        words.append(f"{mirrored} readings would show the scene mirrored.")
    return " ".join(words)


def _pictures(
    findings: Findings,
    shown: ReadingsShown,
    options: DetectiveOptions,
    room: ImVec2,
    fonts: Fonts,
    pressed: _Pressed,
) -> Picked:
    """Draw the grid. Return the selected reading, and the number of the one with the keyboard."""
    if findings.given is None:
        return None, None
    chosen, at = None, shown.at
    if imgui.begin_child("pictures", room, FLAT):
        imgui.set_cursor_pos(ImVec2(theme.px(3), theme.px(3)))
        if shown.note:
            _paragraph(shown.note, theme.DIM)
        room, columns = _grid_room(imgui.get_content_region_avail(), findings)
        at, is_entered = _moved(shown.at, pressed, columns, len(findings.shown))
        grid = _grid(findings, shown, options, at)
        scroll_to = at if at != shown.at else None
        answer = picture_grid(grid, findings.case.size, room, fonts, scroll_to)
        if answer is not None:
            at = answer.number
        if answer is not None or is_entered:
            chosen = findings.shown[at or 0]
    imgui.end_child()
    return chosen, at


def _grid(
    findings: Findings, shown: ReadingsShown, options: DetectiveOptions, at: int | None
) -> list[GridPicture]:
    up, chosen = findings.case.up, findings.named(options.chosen)
    is_mixed = len({one.reading.convention.columns for one in findings.shown}) > 1
    grid = []
    for number, one in enumerate(findings.shown):
        frame = theme.GOOD if one is chosen else theme.ACCENT if number == at else None
        here = " (here)" if number in shown.here else ""
        title = ranking.title(one.reading.convention, up, is_mixed)
        grid.append(
            GridPicture(
                f"reading {number}",
                f"{number + 1}  {title}{here}",
                shown.texture(number),
                frame=frame,
                line=one.told.replace(" of the scene", ""),
                tip=ranking.sentence(one, up),
            )
        )
    return grid


def _keys(at: bool) -> _Pressed:
    """Return the pressed keys in the view's own window, whichever of its parts has the keyboard.

    at: the keyboard is among the pictures, which take Enter.
    """
    key, route = imgui.Key, int(imgui.InputFlags_.route_focused)
    repeated = route | int(imgui.InputFlags_.repeat)
    left, right, up, down = (
        imgui.shortcut(int(arrow), repeated)
        for arrow in (key.left_arrow, key.right_arrow, key.up_arrow, key.down_arrow)
    )
    enter = [imgui.shortcut(int(one), route) for one in (key.enter, key.keypad_enter)] if at else []
    return _Pressed(right - left, down - up, any(enter))


def _moved(at: int | None, pressed: _Pressed, columns: int, count: int) -> tuple[int | None, bool]:
    """Return the reading with the keyboard after the arrow keys, and whether Enter was pressed
    there.
    """
    step = pressed.across + columns * pressed.down
    if step:
        to = 0 if at is None else at + step
        at = to if 0 <= to < count else at
    if at is None or at >= count:
        return None, False
    return at, pressed.enter


def _grid_room(room: ImVec2, findings: Findings) -> tuple[ImVec2, int]:
    """Return the room for the pictures, and the number of columns.

    It is higher than the view, and scrolls, if the text above the pictures would be too small to
    read.
    """
    em, margin, count = imgui.get_font_size(), theme.px(3), len(findings.shown)
    aspect = findings.case.size[0] / findings.case.size[1]
    heading, gap = 2 * HEADING_EM * em, GAP_EM * em
    wide = room.x - margin
    columns, width = columns_for(count, aspect, (wide, room.y - margin), heading, gap)
    if width >= LEAST_PICTURE_EM * em:
        return ImVec2(wide, room.y - margin), columns
    wide -= imgui.get_style().scrollbar_size
    columns = min(count, max(1, int((wide + gap) / (LEAST_PICTURE_EM * em + gap))))
    high = (wide - gap * (columns - 1)) / columns / aspect + heading
    rows = -(-count // columns)
    return ImVec2(wide, rows * (high + gap) - gap), columns


def _paragraph(text: str, color: ImVec4) -> None:
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(color, text)
    imgui.pop_text_wrap_pos()
