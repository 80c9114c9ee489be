"""A box to type a pixel's row and column into: the mark goes there.

Owns its look and the texts while they are typed. How pixels are counted says renderer/pixels.py.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import imgui

from app.state.app_state import AppState
from app.state.options import Pixel
from app.widgets import theme
from app.widgets.asking import TYPED, begin_box
from renderer.camera import Size
from renderer.errors import LucidaError
from renderer.pixels import Indexing

TITLE = "Go to pixel"
FIELDS = ("row i", "column j")


@dataclass(frozen=True)
class Going:
    """texts: row and column as typed so far. size: of the images, (width, height). problem: why
    they were not taken. appearing: in its first frame. focused: it has the keyboard."""

    texts: tuple[str, str]
    size: Size
    problem: str = ""
    appearing: bool = True
    focused: bool = True


def going(state: AppState, size: Size) -> Going:
    """The box as it opens: with the marked pixel, else the one in the middle."""
    row, column = state.options.indexing.numbers(state.marked or (size[1] // 2, size[0] // 2))
    return Going((str(row), str(column)), size)


def pixel_box(box: Going, state: AppState) -> tuple[Going | None, Pixel | None]:
    """Draw the box in the middle of the window. Return the box, None once it is closed, and the
    pixel that was entered. Tab goes from field to field, Enter to the pixel.
    """
    window = begin_box(TITLE)
    done, indexing = False, state.options.indexing
    if window.opened:
        texts = list(box.texts)
        for k, name in enumerate(FIELDS):
            if k:
                imgui.same_line()
            imgui.align_text_to_frame_padding()
            imgui.text(name)
            imgui.same_line()
            if box.appearing and not k:
                imgui.set_keyboard_focus_here()
            imgui.set_next_item_width(5 * imgui.get_font_size())
            entered, texts[k] = imgui.input_text(f"##{name}", box.texts[k], TYPED)
            done = done or entered
        imgui.same_line()
        done = imgui.button("Go") or done
        color = theme.ERROR if box.problem else theme.DIM
        imgui.text_colored(color, box.problem or _rule(box.size, indexing))
        box = replace(box, texts=(texts[0], texts[1]), appearing=False)
    box = replace(box, focused=window.focused)
    imgui.end()
    if done:
        try:
            return None, parsed_pixel(box.texts, box.size, indexing)
        except LucidaError as error:
            return replace(box, problem=str(error), appearing=True), None
    return (box if window.stays else None), None


def parsed_pixel(texts: tuple[str, str], size: Size, indexing: Indexing) -> Pixel:
    """The pixel that somebody has typed. Raises LucidaError where an image of that size has none
    there."""
    first, numbers = indexing.value, []
    for text, name, count in zip(texts, ("row", "column"), size[::-1], strict=True):
        text = text.strip()
        is_whole = text.isascii() and text.isdigit() and len(text) < 10
        if not is_whole or not first <= int(text) < count + first:
            problem = f"{text[:20]!r} is no {name} of this image"
            raise LucidaError("", problem, f"give {first} to {count + first - 1}")
        numbers.append(int(text))
    return indexing.pixel(numbers[0], numbers[1])


def _rule(size: Size, indexing: Indexing) -> str:
    first, (width, height) = indexing.value, size
    return f"rows {first} to {height + first - 1}, columns {first} to {width + first - 1}"
