"""A box to type a resolution into.

Owns its look and the text while it is typed. Which sizes are legal says imaging.py.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import imgui

from app.images.imaging import parsed_size, size_text, with_resolution
from app.state.app_state import AppState
from app.widgets import theme
from app.widgets.asking import TYPED, begin_box
from renderer.errors import LucidaError

TITLE = "Resolution of both images"


@dataclass(frozen=True)
class SizeEntry:
    """text: as typed so far. problem: why it was not taken. appearing: in its first frame.
    focused: it has the keyboard."""

    text: str
    problem: str = ""
    appearing: bool = True
    focused: bool = True


def asked(state: AppState, size: tuple[int, int]) -> SizeEntry:
    """The box as it opens. size: of the images now."""
    return SizeEntry(size_text(state.images.resolution or size))


def resolution_box(box: SizeEntry, state: AppState) -> tuple[SizeEntry | None, AppState]:
    """Draws the box in the middle of the window; None once it is closed."""
    window = begin_box(TITLE)
    done = False
    if window.opened:
        imgui.text("Width x height, in pixels:")
        if box.appearing:
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(12 * imgui.get_font_size())
        entered, text = imgui.input_text("##size", box.text, TYPED)
        box = replace(box, text=text, appearing=False)
        imgui.same_line()
        done = imgui.button("Draw") or entered
        imgui.text_colored(
            theme.ERROR if box.problem else theme.DIM,
            box.problem or "16 x 9 to 4096 x 2160 and beyond; 4 x 3 as on the blackboard",
        )
    imgui.end()
    if done:
        try:
            return None, with_resolution(state, parsed_size(box.text))
        except LucidaError as error:
            return replace(box, problem=str(error), appearing=True), state
    return (replace(box, focused=window.focused) if window.stays else None), state
