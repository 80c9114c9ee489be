"""The laboratory's two tables: what the kinds of image cost, and the array's cells.

Owns their looks. Knows nothing of how an image is made.
"""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from app import theme
from app.lettering import lettering
from app.options import Pixel
from app.teach.imagelab import disk, memory
from app.teach.imagelab.kinds import KINDS, LECTURE_SIZE
from app.teach.imagelab.pages import Image
from app.theme import Fonts
from renderer.images.display import LUMINANCE, luminance, to_srgb8
from renderer.scene.reading import size_text

CELL_EM = (8.6, 3.9)  # of one pixel of the array
MOST_CELLS = (7, 7)  # columns, rows
BARS = ("#e5484d", "#46a758", "#4f8ff7")  # red, green and blue, as light as text must be


def sizes_table(
    size: tuple[int, int], entries: tuple[disk.Entry, ...], fonts: Fonts
) -> disk.Format | None:
    """A line a kind: bits, bytes of the lecture's megapixel and of this image, and of its files.

    Gives the format whose button was pressed.
    """
    flags = imgui.TableFlags_.borders_inner_h | imgui.TableFlags_.sizing_fixed_fit
    if not imgui.begin_table("sizes", 5, int(flags | imgui.TableFlags_.no_saved_settings)):
        return None
    titles = (
        "",
        "bits a pixel",
        "x".join(map(str, LECTURE_SIZE)),
        f"this image, {size[0]}x{size[1]}",
    )
    for title in (*titles, "on disk (click to save)"):
        imgui.table_setup_column(title)
    with lettering(fonts.bold, imgui.get_font_size()):
        imgui.table_headers_row()
    chosen = None
    for kind in KINDS:
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text(kind.title)
        for text in (
            f"{kind.bits}",
            size_text(kind.storage_bytes(LECTURE_SIZE)),
            size_text(kind.storage_bytes(size)),
        ):
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


def luminance_weights(at: ImVec2, width: float, fonts: Fonts) -> None:
    """How colour becomes gray: Rec. 709's weights, as bars of their length."""
    em = imgui.get_font_size()
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold, em):
        draw.add_text(at, theme.u32(theme.TEXT), "From colour to gray")
    y = at.y + 1.15 * em
    draw.add_text(ImVec2(at.x, y), theme.u32(theme.DIM), "luminance of linear light (Rec. 709)")
    y += 2.0 * em
    longest = width - 6.5 * em
    for name, weight, color in zip("RGB", LUMINANCE, BARS, strict=True):
        with lettering(fonts.mono, em):
            draw.add_text(ImVec2(at.x, y), theme.u32(theme.TEXT), f"{weight:.4f} {name}")
        low = ImVec2(at.x + 5.5 * em, y + 0.1 * em)
        high = ImVec2(low.x + max(2.0, longest * float(weight)), y + 0.95 * em)
        draw.add_rect_filled(low, high, theme.u32(theme.rgb(color)), 2.0)
        y += 1.5 * em


def array_about(color: Image, pixel: Pixel, extent: ImVec2, one_based: bool) -> memory.Table:
    """As much of the array about a pixel as array_cells() has room for in an extent."""
    em = imgui.get_font_size()
    columns = max(1, min(MOST_CELLS[0], int(extent.x / (CELL_EM[0] * em))))
    rows = max(1, min(MOST_CELLS[1], int((extent.y - 3.0 * em) / (CELL_EM[1] * em))))
    return memory.table(color, *pixel, rows, columns, one_based)


def array_cells(
    table: memory.Table, image_width: int, pixel: Pixel, at: ImVec2, extent: ImVec2, fonts: Fonts
) -> Pixel | None:
    """The array about a pixel, cell by cell: index, values, place in memory. Gives the pixel that
    was clicked."""
    em = imgui.get_font_size()
    width, height = CELL_EM[0] * em, CELL_EM[1] * em
    width = min(extent.x / len(table.rows[0]), 1.5 * width)
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold, em):
        draw.add_text(at, theme.u32(theme.TEXT), "Row by row in memory")
    formula = memory.formula(image_width, one_based=table.one_based)
    with lettering(fonts.mono, em):
        draw.add_text(ImVec2(at.x, at.y + 1.15 * em), theme.u32(theme.DIM), formula)
    top = at.y + 2.5 * em
    chosen = None
    for r, row in enumerate(table.rows):
        for c, cell in enumerate(row):
            corner = ImVec2(at.x + c * width, top + r * height)
            imgui.set_cursor_screen_pos(corner)
            if imgui.invisible_button(f"cell {r} {c}", ImVec2(width - 3, height - 3)):
                chosen = (cell.i, cell.j)
            _cell(draw, cell, corner, (width - 3, height - 3), (cell.i, cell.j) == pixel, fonts)
    return chosen


def _cell(
    draw: imgui.ImDrawList,
    cell: memory.Cell,
    corner: ImVec2,
    size: tuple[float, float],
    marked: bool,
    fonts: Fonts,
) -> None:
    em = imgui.get_font_size()
    far = ImVec2(corner.x + size[0], corner.y + size[1])
    values = np.asarray(cell.values, np.float32)
    red, green, blue = (float(x) / 255 for x in to_srgb8(values))
    light = float(to_srgb8(luminance(values))) / 255 > 0.55
    ink = theme.rgb("#000000") if light else theme.rgb("#ffffff")
    draw.add_rect_filled(corner, far, theme.u32(ImVec4(red, green, blue, 1.0)), 3.0)
    if marked:
        draw.add_rect(corner, far, theme.u32(theme.MARK), 3.0, 3.0)
    x, y = corner.x + 0.4 * em, corner.y + 0.25 * em
    draw.push_clip_rect(corner, far, True)
    with lettering(fonts.mono, em):
        draw.add_text(ImVec2(x, y), theme.u32(ink), cell.label)
    with lettering(fonts.mono, 0.86 * em):
        numbers = " ".join(f"{value:.2f}" for value in cell.values)
        draw.add_text(ImVec2(x, y + 1.2 * em), theme.u32(ink), numbers)
        draw.add_text(ImVec2(x, y + 2.25 * em), theme.u32(ink), f"+{cell.offset_bytes} B")
    draw.pop_clip_rect()
