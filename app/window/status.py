"""The status line: both renderers' times, the agreement, the pixel under the mouse.

Numbers have a fixed width, so that nothing moves while they change.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.images.agreement import Verdict
from lucida.app.ui import theme
from lucida.app.ui.lettering import fitting_words
from lucida.renderer.camera.pixels import Indexing, Pixel
from lucida.renderer.system.errors import describe

DIVIDER_PX = 25.0  # at 100 %: a line between two texts, with its margins


@dataclass(frozen=True)
class Status:
    """The contents of the line.

    size: the full image's size. factor: the coarseness of the ray image, 1 for full, 0 for none.
    raster_factor: the same for the raster image. agreement: a text, empty while unknown. agrees:
    True if the images agree, None if unknown. differing: True if there are differing pixels to
    show. pixel: the pixel under the mouse, or the marked one. indexing: its numbering. loading: the
    name of the source being opened, or "". brief: True to omit times and sizes, for an audience.
    awaited: True if an unknown agreement will be known; otherwise it is omitted.
    """

    raster_s: float
    raster_factor: int
    ray_s: float
    size: tuple[int, int]
    factor: int
    agreement: str
    agrees: bool | None
    pixel: Pixel | None = None
    indexing: Indexing = Indexing.LECTURE
    seen: str = ""
    loading: str = ""
    brief: bool = False
    awaited: bool = True
    differing: bool = False


def told(verdict: Verdict | None, failure: Exception | None) -> str:
    """Return the line's text on both images; empty while it is unknown."""
    return verdict.text if verdict else describe(failure) if failure else ""


def is_good_news(verdict: Verdict | None, failure: Exception | None) -> bool | None:
    """Return True if both images agree; None if nothing was compared."""
    if verdict is None:
        return None if failure is None else False
    return verdict.agrees


def status_line(status: Status, fonts: theme.Fonts) -> bool:
    """Draw the line at the cursor. Return True if the button that shows the differing pixels was
    pressed.
    """
    start = imgui.get_cursor_pos_x()
    room = imgui.get_window_width() - 2 * imgui.get_style().window_padding.x
    imgui.push_font(fonts.mono, 0.0)
    parts = [] if status.brief else [(text, theme.TEXT) for text in time_texts(status)]
    good = theme.GOOD if status.agrees else theme.ERROR
    if status.agrees is None:
        good = theme.DIM
    agreement = agreement_text(status)
    if agreement:
        parts.append((agreement, good if status.agreement else theme.DIM))
    widths = [_width(text) for text, _ in parts]
    rights = right_texts(status)
    left, right = fitting(widths, list(map(_width, rights)), room, theme.px(DIVIDER_PX))
    pressed = False
    for index, (text, color) in enumerate(parts[left:]):
        if index:
            _divider()
        shown = fitting_words(text, room)  # a single text may be wider than the window
        if text == agreement and status.differing:
            pressed = _link(shown, color)
            continue
        imgui.align_text_to_frame_padding()
        imgui.text_colored(color, shown)
        if shown != text:
            imgui.set_item_tooltip(text)
    if rights[right]:
        imgui.same_line(start + room - _width(rights[right]))
        color = theme.TEXT if status.loading else theme.legible(theme.MARK)
        imgui.text_colored(color, rights[right])
    imgui.pop_font()
    return pressed


def time_texts(status: Status) -> list[str]:
    """Return the time of each image that a view requested."""
    coarseness = f" 1/{status.raster_factor}" if status.raster_factor > 1 else "    "
    texts = []
    if status.raster_s > 0:
        texts.append(f"raster {milliseconds(status.raster_s)}{coarseness}")
    if status.factor or status.awaited:
        texts.append(ray_text(status))
    return texts


def agreement_text(status: Status) -> str:
    """Return the agreement of the images, in words; empty if no view shows both.

    The words name the two images, since other views show pairs that differ on purpose.
    """
    return (status.agreement or "raster and ray: ...") if status.awaited else ""


def right_texts(status: Status) -> list[str]:
    """Return the texts for the right end, from the longest to none."""
    if status.loading:
        return [f"loading {status.loading} ...", "loading ...", ""]
    if status.pixel is None:
        return [""]
    pixel = f"pixel {status.indexing.text(status.pixel)}"
    told = f"{pixel} {status.indexing.told}"
    return [f"{status.seen}  {told}".strip(), told, pixel, ""]


def fitting(
    lefts: list[float], rights: list[float], room: float, divider: float = DIVIDER_PX
) -> tuple[int, int]:
    """Return the index of the first left text that fits, and of the right text that fits with it.

    lefts, rights, divider: widths; those of the right texts decrease to 0. If space is short, the
    times at the left are omitted first, never the agreement; then the right text is shortened.
    """
    first = 0
    while first < len(lefts) - 1 and sum(lefts[first:]) + divider * (len(lefts) - first) > room:
        first += 1
    free = room - sum(lefts[first:]) - divider * (len(lefts) - first)
    return first, next(number for number, width in enumerate(rights) if width <= max(free, 0))


def milliseconds(time_s: float) -> str:
    """Return a time in eight characters: ` 12.3 ms`."""
    ms = time_s * 1e3
    return f"{ms:5.1f} ms" if ms < 1000 else f"{time_s:5.1f} s "


def ray_text(status: Status) -> str:
    """Return the ray image's time, size and refinement, in constant width. The time is blank before
    there is an image.
    """
    width, height = status.size
    took = milliseconds(status.ray_s) if status.factor else f"{'...':>8}"
    detail = {0: "", 1: "full"}.get(status.factor, f"1/{status.factor}")
    return f"ray {took}, {width}x{height} {detail:4}"


def _width(text: str) -> float:
    return imgui.calc_text_size(text).x


def _link(text: str, color: ImVec4) -> bool:
    """Draw underlined text that can be pressed, without padding."""
    imgui.push_style_var(
        imgui.StyleVar_.frame_padding, ImVec2(0, imgui.get_style().frame_padding.y)
    )
    imgui.push_style_color(imgui.Col_.button, theme.UNSEEN)
    imgui.push_style_color(imgui.Col_.text, color)
    pressed = imgui.button(f"{text}###differing")
    imgui.pop_style_color(2)
    imgui.pop_style_var()
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    foot = high.y - imgui.get_style().frame_padding.y
    draw = imgui.get_window_draw_list()
    draw.add_line(ImVec2(low.x, foot), ImVec2(high.x, foot), theme.u32(color), 1.0)
    imgui.set_item_tooltip("Show these pixels, in the view Compare")
    return bool(pressed)


def _divider() -> None:
    imgui.same_line(0, theme.px(12))
    at = imgui.get_cursor_screen_pos()
    height = imgui.get_frame_height()
    draw = imgui.get_window_draw_list()
    draw.add_line(
        ImVec2(at.x, at.y + 3), ImVec2(at.x, at.y + height - 3), theme.u32(theme.LINE), 1.0
    )
    imgui.dummy((1, height))
    imgui.same_line(0, theme.px(12))
