"""Tables next to the laboratory's kinds of image: their sizes, and how colour becomes gray."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.laboratory import disk
from app.laboratory.kinds import KINDS, LECTURE_SIZE
from app.widgets import theme
from app.widgets.lettering import at_most, fitted_text, lettering
from app.widgets.theme import Fonts
from renderer.images.display import LUMINANCE
from renderer.scene.reading import size_text

LONGEST_KIND, LONGEST_FILE = "Single float", "PNG 00.00 KiB"
BARS = ("#e5484d", "#46a758", "#4f8ff7")  # red, green and blue, as light as text must be


def sizes_table(
    size: tuple[int, int], entries: tuple[disk.DiskRow, ...], fonts: Fonts
) -> disk.DiskFormat | None:
    """Draw a line for each kind: bits, bytes of the lecture's megapixel, of this image and of its
    files.

    A narrow page leaves out the bytes of this image, which its pictures say, and has smaller type.
    Returns the format whose button was pressed.
    """
    titles = ["", "bits per pixel", "x".join(map(str, LECTURE_SIZE))]
    titles += [f"this image, {size[0]}x{size[1]}", "on disk (click to save)"]
    em, room = imgui.get_font_size(), imgui.get_content_region_avail().x
    with lettering(fonts.bold, em):
        needed = sum(imgui.calc_text_size(text).x for text in (LONGEST_KIND, *titles[1:-1]))
        needed += 2 * imgui.calc_text_size(LONGEST_FILE).x + 8 * em
        is_whole = needed <= room
        if not is_whole:
            needed -= imgui.calc_text_size(titles.pop(3)).x + em
    with at_most(em * min(1.0, room / needed)):
        return _sizes_table(size, entries, fonts, titles, is_whole)


def _sizes_table(
    size: tuple[int, int],
    entries: tuple[disk.DiskRow, ...],
    fonts: Fonts,
    titles: list[str],
    is_whole: bool,
) -> disk.DiskFormat | None:
    flags = imgui.TableFlags_.borders_inner_h | imgui.TableFlags_.sizing_fixed_fit
    if not imgui.begin_table(
        "sizes", len(titles), int(flags | imgui.TableFlags_.no_saved_settings)
    ):
        return None
    for title in titles:
        imgui.table_setup_column(title)
    with lettering(fonts.bold, imgui.get_font_size()):
        imgui.table_headers_row()
    chosen = None
    for kind in KINDS:
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text(kind.title)
        bytes_of = (LECTURE_SIZE, size) if is_whole else (LECTURE_SIZE,)
        for text in (f"{kind.bits}", *(size_text(kind.storage_bytes(one)) for one in bytes_of)):
            imgui.table_next_column()
            with lettering(fonts.mono, imgui.get_font_size()):
                imgui.text(f"{text:>8}")
        imgui.table_next_column()
        for entry in entries:
            if entry.format.kind is not kind:
                continue
            name = f"{entry.format.name} {size_text(entry.file_bytes)}"
            if imgui.small_button(f"{name}##{kind.name}{entry.format.ending}"):
                chosen = entry.format
            imgui.set_item_tooltip(f"{entry.format.note}; click to save")
            imgui.same_line()
        imgui.new_line()
    imgui.end_table()
    return chosen


def luminance_weights(at: ImVec2, room: ImVec2, fonts: Fonts) -> None:
    """Draw how colour becomes gray: Rec. 709's weights, as bars of their length."""
    em, width = imgui.get_font_size(), room.x
    line = min(1.5 * em, (room.y - 2.8 * em) / len(BARS))
    size = min(em, 0.9 * line)
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold, em):
        draw.add_text(at, theme.u32(theme.TEXT), "From colour to gray")
    y = at.y + 1.15 * em
    caption = "luminance of linear light (Rec. 709)"
    fitted_text(draw, ImVec2(at.x, y), theme.u32(theme.DIM), caption, width)
    y += 1.65 * em
    longest = width - 6.5 * em
    for name, weight, color in zip("RGB", LUMINANCE, BARS, strict=True):
        with lettering(fonts.mono, size):
            draw.add_text(ImVec2(at.x, y), theme.u32(theme.TEXT), f"{weight:.4f} {name}")
        low = ImVec2(at.x + 5.5 * em, y + 0.1 * size)
        high = ImVec2(low.x + max(2.0, longest * float(weight)), y + 0.95 * size)
        draw.add_rect_filled(low, high, theme.u32(theme.rgb(color)), 2.0)
        y += line
