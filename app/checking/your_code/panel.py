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
RUNNING_S = 0.3  # a longer run shows its progress
TEXT_PART = 0.42  # fraction of the height for the words below the pictures

INVITATION = (
    "Write the ray of a pixel yourself. Lucida runs your Python file on the camera that you see"
    " here, again whenever you save it, and shows your picture next to the correct one."
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
    tip("a Python file with an empty function and its task")
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


def pictures_room() -> ImVec2:
    """Return the space for the pictures, above the words."""
    room, em = imgui.get_content_region_avail(), imgui.get_font_size()
    words = max(TEXT_PART * room.y, min(8 * em, 0.6 * room.y))
    return ImVec2(room.x, room.y - words - imgui.get_style().item_spacing.y)


def words(lines: Sequence[ToldLine], fonts: Fonts) -> str:
    """Draw the findings in the rest of the view, the verdict on top, and let them scroll if
    necessary. Return the title of the lecture's step whose link was clicked, or "".
    """
    title = ""
    if imgui.begin_child("told", imgui.get_content_region_avail()):
        for number, line in enumerate(lines):
            font = fonts.bold if number == 0 else fonts.text
            with lettering(fonts.mono if line.role == "code" else font):
                if line.role == "read":
                    if imgui.text_link(line.text):
                        title = line.text.removeprefix(READ).removesuffix(".")
                else:
                    wrapped(line.text, _color(line.role))
    imgui.end_child()
    return title


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
    tip("the pictures' size: one call per pixel")
    return chosen
