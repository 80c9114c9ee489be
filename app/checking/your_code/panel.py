"""The panel of the view "Your code": its controls and its findings.

Functions take values and return wishes.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.checking.mistakes.diagnosis import READ
from lucida.app.checking.own_words import returned, signature
from lucida.app.instruments.stepper.panel import CANVASES
from lucida.app.state.options.your_code import YourCodeOptions
from lucida.app.ui import theme
from lucida.app.ui.explaining.symbols import arguments
from lucida.app.ui.lettering import lettering
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import button_width, follow, tip
from lucida.app.ui.theme import Fonts
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.errors import one_line

from .model import RAY_TASK
from .runs import CodeRuns
from .words import ToldLine, ToldRole

CodeWish = Literal["", "open", "starter", "run", "stop"]
RUNNING_S = 0.3  # a run that takes longer shows how far it is
BESIDE = 2.0  # width / height from which words are next to the pictures
WORDS_EM = 24.0  # the least width of the words there
TEXT_PART = 0.42  # of the height, for the words below the pictures
VERDICT = 1.25  # its size, in that of the other words
VERDICT_LONGEST = 70  # characters; longer text explains why there is none

INVITATION = (
    "Write the ray of a pixel yourself. Lucida runs your Python file on the camera that you see"
    " here, again whenever you save it, and shows your picture beside the correct one."
)
SIGNATURE = "def {}:\n    ...\n    return {}"
TRUST = (
    "It has not been run: you have not opened it yourself. It would run in a process of its own,"
    " with your rights. Read it first: {}"
)


def invitation(fonts: Fonts) -> CodeWish:
    """Draw the panel when no file is open."""
    wrapped(INVITATION)
    with lettering(fonts.mono):
        code = SIGNATURE.format(
            signature(RAY_TASK), arguments(returned(RAY_TASK), RAY_TASK.notation)
        )
        imgui.text_colored(theme.DIM, code)
    wish: CodeWish = ""
    if imgui.button("Write a file to begin with..."):
        wish = "starter"
    tip("a Python file with an empty function, and what it is to return")
    follow(button_width("Open a Python file..."))
    if imgui.button("Open a Python file..."):
        wish = "open"
    return wish


def head(
    file: Path,
    options: YourCodeOptions,
    runs: CodeRuns | None,
    fonts: Fonts,
) -> tuple[CodeWish, Size]:
    """Draw the file and its buttons. Return the wish and the selected canvas size.

    runs: None if the file may not run, because the user has not opened it.
    """
    wish: CodeWish = ""
    with lettering(fonts.bold):
        imgui.align_text_to_frame_padding()
        imgui.text(one_line(file.name))
    tip(one_line(str(file.parent)))
    running_s = runs.running_s if runs is not None else 0.0
    buttons: list[tuple[CodeWish, str, str]] = [("open", "Open...", "another Python file")]
    if running_s > RUNNING_S:
        buttons.insert(0, ("stop", "Stop", "end its process"))
    elif runs is not None:
        buttons.insert(0, ("run", "Run", "as when the file is saved"))
    for name, shown, tooltip in buttons:
        follow(button_width(shown))
        if imgui.button(f"{shown}###{name}"):
            wish = name
        tip(tooltip)
    canvas = options.canvas if runs is None else _canvas(options.canvas)
    if running_s > RUNNING_S:
        text = f"running for {running_s:.0f} s"
        follow(imgui.calc_text_size(text).x)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, text)
    return wish, canvas


def rooms(room: ImVec2, has_pictures: bool) -> tuple[ImVec2, ImVec2, bool]:
    """Return the space for the pictures and for the words, and True if they are side by side."""
    gap = imgui.get_style().item_spacing
    if not has_pictures:
        return ImVec2(0, 0), room, False
    em = imgui.get_font_size()
    if room.x > BESIDE * room.y and room.x > 2 * WORDS_EM * em:
        words = max(WORDS_EM * em, 0.34 * room.x)
        return ImVec2(room.x - words - gap.x, room.y), ImVec2(words, room.y), True
    height = max(TEXT_PART * room.y, min(8 * em, 0.6 * room.y))
    return ImVec2(room.x, room.y - height - gap.y), ImVec2(room.x, height), False


def words(lines: Sequence[ToldLine], room: ImVec2, fonts: Fonts) -> str:
    """Draw the findings, the verdict above all. Scroll them if they do not fit. Return the title of
    the lecture's step whose link was clicked, or "".
    """
    title = ""
    if imgui.begin_child("told", room):
        for number, line in enumerate(lines):
            with lettering(*_lettering(line, number, fonts)):
                if line.role == "code":
                    wrapped(line.text)
                elif line.role == "read":
                    if imgui.text_link(line.text):
                        title = line.text.removeprefix(READ).removesuffix(".")
                else:
                    wrapped(line.text, _color(line.role))
    imgui.end_child()
    return title


def _lettering(line: ToldLine, number: int, fonts: Fonts) -> tuple[imgui.ImFont | None, float]:
    """Return the font of a line, and its type's size in parts of the usual one."""
    if line.role == "code":
        return fonts.mono, 1.0
    is_verdict = number == 0 and line.role in ("good", "bad")
    if is_verdict and len(line.text) <= VERDICT_LONGEST:  # the last row is to read it
        return fonts.bold, VERDICT
    return fonts.text, 1.0


def _color(role: ToldRole) -> ImVec4:
    return {"good": theme.GOOD, "bad": theme.ERROR, "dim": theme.DIM}.get(role, theme.TEXT)


def _canvas(chosen: Size) -> Size:
    def name(size: Size) -> str:
        return f"{size[0]} x {size[1]} pixels"

    width = imgui.calc_text_size("64 x 48 pixels").x + 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##canvas", name(chosen)):
        for size in CANVASES:
            if imgui.selectable(name(size), size == chosen)[0]:
                chosen = size
        imgui.end_combo()
    tip("the pictures' size: one call a pixel")
    return chosen
