"""Boxes to type into: the resolution of both images, and a pixel that the mark goes to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

from imgui_bundle import imgui

from lucida.app.images.imaging import parsed_size, size_text, with_resolution
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.asking import TYPED, begin_box
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.system.errors import LucidaError

T = TypeVar("T")
PIXEL_TITLE = "Go to pixel"


@dataclass(frozen=True)
class EntryBox:
    """A box with fields to type into.

    fields: their names. width_em: of each. texts: as typed so far. button: its label. size: of the
    images, (width, height). caption: above the fields, in place of their names. problem: the last
    error. appearing: True in the first frame. focused: it has the keyboard.
    """

    title: str
    fields: tuple[str, ...]
    width_em: float
    texts: tuple[str, ...]
    button: str
    size: Size
    caption: str = ""
    problem: str = ""
    appearing: bool = True
    focused: bool = True


def asking_size(state: AppState, size: Size) -> EntryBox:
    """Return the box for a resolution. size: of the images now."""
    text = size_text(state.images.resolution or size)
    title, caption = "Resolution of both images", "Width x height, in pixels:"
    return EntryBox(title, ("size",), 12, (text,), "Draw", size, caption)


def asking_pixel(state: AppState, size: Size) -> EntryBox:
    """Return the box for a pixel, with the marked one, or the one in the middle."""
    row, column = state.options.indexing.numbers(state.marked or (size[1] // 2, size[0] // 2))
    return EntryBox(PIXEL_TITLE, ("row i", "column j"), 5, (str(row), str(column)), "Go", size)


def resolution_box(box: EntryBox, state: AppState) -> tuple[EntryBox | None, AppState]:
    """Draw the box in the middle of the window. Return None once it is closed."""
    rule = "16 x 9 to 4096 x 2160 and beyond; 4 x 3 as on the blackboard"
    left, size = _entry_box(box, rule, lambda texts: parsed_size(texts[0]))
    return left, with_resolution(state, size) if size is not None else state


def pixel_box(box: EntryBox, state: AppState) -> tuple[EntryBox | None, Pixel | None]:
    """Draw the box in the middle of the window. Return the box, None once it is closed, and the
    pixel that was entered. Tab moves from field to field, Enter goes to the pixel.
    """
    indexing, (width, height) = state.options.indexing, box.size
    first = indexing.value
    rule = f"rows {first} to {height + first - 1}, columns {first} to {width + first - 1}"
    return _entry_box(box, rule, lambda texts: parsed_pixel(texts, box.size, indexing))


def _entry_box(
    box: EntryBox, rule: str, parsed: Callable[[tuple[str, ...]], T]
) -> tuple[EntryBox | None, T | None]:
    window, done, texts = begin_box(box.title), False, list(box.texts)
    if window.opened:
        if box.caption:
            imgui.text(box.caption)
        for k, name in enumerate(box.fields):
            if k:
                imgui.same_line()
            if not box.caption:
                imgui.align_text_to_frame_padding()
                imgui.text(name)
                imgui.same_line()
            if box.appearing and not k:
                imgui.set_keyboard_focus_here()
            imgui.set_next_item_width(box.width_em * imgui.get_font_size())
            entered, texts[k] = imgui.input_text(f"##{name}", texts[k], TYPED)
            done = done or entered
        imgui.same_line()
        done = imgui.button(box.button) or done
        imgui.text_colored(theme.ERROR if box.problem else theme.DIM, box.problem or rule)
        box = replace(box, texts=tuple(texts), appearing=False)
    imgui.end()
    box = replace(box, focused=window.focused)
    if not done:
        return (box if window.stays else None), None
    try:
        return None, parsed(box.texts)
    except LucidaError as error:
        return replace(box, problem=str(error), appearing=True), None


def parsed_pixel(texts: tuple[str, ...], size: Size, indexing: Indexing) -> Pixel:
    """Return a typed pixel. Raises LucidaError if an image of that size has no such pixel."""
    first, numbers = indexing.value, []
    for text, name, count in zip(texts, ("row", "column"), size[::-1], strict=True):
        text = text.strip()
        is_whole = text.isascii() and text.isdigit() and len(text) < 10
        if not is_whole or not first <= int(text) < count + first:
            problem = f"{text[:20]!r} is no {name} of this image"
            raise LucidaError("", problem, f"give {first} to {count + first - 1}")
        numbers.append(int(text))
    return indexing.pixel(numbers[0], numbers[1])
