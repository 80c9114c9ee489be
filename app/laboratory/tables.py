"""Tables next to the laboratory's kinds of image: their sizes, and how colour becomes gray."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.laboratory import disk
from app.laboratory.kinds import KINDS, LECTURE_SIZE
from app.widgets import theme
from app.widgets.lettering import fitting_words, lettering
from app.widgets.rows import button_width, follow
from app.widgets.theme import Fonts
from renderer.images.display import LUMINANCE
from renderer.scene.reading import size_text

WHOLE_EM = 42.0  # the width of the whole table
BITS_EM = 21.0  # the least with the column of bits, which captions show as well
BARS = ("#e5484d", "#46a758", "#4f8ff7")  # red, green and blue, as light as text must be


def sizes_table(
    size: tuple[int, int], entries: tuple[disk.DiskRow, ...], fonts: Fonts
) -> disk.DiskFormat | None:
    """Draw a line for each kind: bits, bytes of the lecture's megapixel, of this image and of its
    files.

    Returns the format whose button was pressed.
    """
    narrow = is_narrow()
    flags = imgui.TableFlags_.borders_inner_h | imgui.TableFlags_.sizing_fixed_fit
    titles = ["", "x".join(map(str, LECTURE_SIZE))]
    if has_bits := imgui.get_content_region_avail().x > BITS_EM * imgui.get_font_size():
        titles.insert(1, "bits")
    if not narrow:
        titles.append(f"this image, {size[0]}x{size[1]}")
    last = "on disk" if narrow else "on disk (click to save)"
    if not imgui.begin_table(
        "sizes", len(titles) + 1, int(flags | imgui.TableFlags_.no_saved_settings)
    ):
        return None
    for title in titles:
        imgui.table_setup_column(title)
    imgui.table_setup_column(last, imgui.TableColumnFlags_.width_stretch)
    with lettering(fonts.bold):
        imgui.table_headers_row()
    chosen = None
    for kind in KINDS:
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text(kind.title)
        bytes_of = [size_text(kind.storage_bytes(each)) for each in (LECTURE_SIZE, size)]
        for text in (*[f"{kind.bits:>4}"][:has_bits], *bytes_of[: 1 if narrow else 2]):
            imgui.table_next_column()
            with lettering(fonts.mono):
                imgui.text(f"{text:>8}" if text in bytes_of else text)
        imgui.table_next_column()
        for number, entry in enumerate(one for one in entries if one.format.kind is kind):
            name = f"{entry.format.name} {size_text(entry.file_bytes)}"
            if number:
                follow(button_width(name))
            if imgui.small_button(f"{name}##{kind.name}{entry.format.ending}"):
                chosen = entry.format
            imgui.set_item_tooltip(f"{entry.format.note}; click to save")
    imgui.end_table()
    return chosen


def table_px() -> float:
    """Return the height of sizes_table()."""
    return (12.4 if is_narrow() else 7.6) * float(imgui.get_text_line_height_with_spacing())


def is_narrow() -> bool:
    """Return True if the table leaves out a column, and a kind's files need two rows."""
    return bool(imgui.get_content_region_avail().x < WHOLE_EM * imgui.get_font_size())


def luminance_weights(at: ImVec2, room: ImVec2, fonts: Fonts) -> None:
    """Draw how colour becomes gray: Rec. 709's weights, as bars of their length."""
    em, width = imgui.get_font_size(), room.x
    line = max(1.1 * em, min(1.5 * em, (room.y - 2.8 * em) / len(BARS)))
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold):
        draw.add_text(at, theme.u32(theme.TEXT), "Luminance")
    y = at.y + 1.15 * em
    caption = "from colour to gray; Rec. 709, of linear light"
    draw.add_text(ImVec2(at.x, y), theme.u32(theme.DIM), fitting_words(caption, width))
    y += 1.65 * em
    longest = width - 6.5 * em
    for name, weight, color in zip("RGB", LUMINANCE, BARS, strict=True):
        with lettering(fonts.mono):
            draw.add_text(ImVec2(at.x, y), theme.u32(theme.TEXT), f"{weight:.4f} {name}")
        low = ImVec2(at.x + 5.5 * em, y + 0.1 * em)
        high = ImVec2(low.x + max(2.0, longest * float(weight)), y + 0.95 * em)
        draw.add_rect_filled(low, high, theme.u32(theme.rgb(color)), 2.0)
        y += line
