"""Entry boxes for the resolution of both images, and for a pixel to mark."""

from __future__ import annotations

from dataclasses import replace

from lucida.app.images.imaging import parsed_size, size_text, with_resolution
from lucida.app.images.placement import shown_pixel
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.entry_box import EntryBox
from lucida.app.ui.host import Host
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.system.errors import LucidaError

PIXEL_TITLE = "Go to pixel"


def ask_resolution(host: Host) -> None:
    """Open the box for the images' resolution."""

    def enter(texts: tuple[str, ...]) -> None:
        host.change(with_resolution(host.state, parsed_size(texts[0])))

    fields = {"width x height": size_text(host.state.images.resolution or host.renderers.size)}
    rule = "16 x 9 to 4096 x 2160 and beyond; 4 x 3, as on the blackboard"
    host.box = EntryBox("Resolution of both images", fields, "Draw", rule, enter, 10.0)


def ask_pixel(host: Host) -> None:
    """Open the box for a pixel; it holds the marked pixel, or the middle one."""
    size, indexing = host.renderers.size, host.options.indexing
    if not min(size):
        return

    def enter(texts: tuple[str, ...]) -> None:
        pixel, state = parsed_pixel(texts, size, indexing), host.state
        placement = host.renderers.placement(state)
        state = state.with_options(replace(state.options, marked=pixel))
        if placement is not None:
            state = state.with_options(shown_pixel(state.images, placement, pixel))
        host.change(state)

    (width, height), first = size, indexing.value
    row, column = indexing.numbers(host.state.marked or (height // 2, width // 2))
    rule = f"rows {first} to {height + first - 1}, columns {first} to {width + first - 1}"
    fields = {"row i": str(row), "column j": str(column)}
    host.box = EntryBox(PIXEL_TITLE, fields, "Go", rule, enter)


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
