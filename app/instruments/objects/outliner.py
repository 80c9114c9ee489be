"""The list of a scene's objects and lights: the Add menu, and the rows.

Selecting does not add an undo step. Only visible rows are drawn.
"""

from __future__ import annotations

from functools import lru_cache

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.ui import theme
from lucida.app.ui.action import draw_entry
from lucida.app.ui.checks import checkbox
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import fitting_letters
from lucida.app.ui.rows import tip
from lucida.renderer.editing.changing import Item
from lucida.renderer.editing.outline import OutlineRow
from lucida.renderer.scene.model import Scene

from . import editing
from .actions import ADDING, edit
from .choosing import choose, choose_also, chosen, rows_of

EMPTY = "The scene has no objects. Add one, or drop a model here."
READ_ONLY = "This scene was made from meshes in Python and cannot be changed here."
SHOWN = "shown by both renderers"
KIND_EM = 5.0


def outliner_panel(host: Host, seen: Item | None) -> Item | None:
    """Draw the list into the current window. Return the item that it has scrolled to.

    seen: the previous frame's result.
    """
    rows = rows_of(host.state.scene)
    _add_menu(host)
    if rows and all(row.item is None for row in rows):
        imgui.text_wrapped(READ_ONLY)
    elif not rows:
        imgui.text_wrapped(EMPTY)
    flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.no_pad_outer_x
    flags |= imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.no_saved_settings
    # A scrolling table would be a window of its own, which Tab does not enter.
    imgui.begin_child("list", (0, 0), imgui.ChildFlags_.nav_flattened)
    if rows and imgui.begin_table("items", 3, int(flags)):
        imgui.table_setup_column("shown", 0, imgui.get_frame_height())
        imgui.table_setup_column("name", int(imgui.TableColumnFlags_.width_stretch))
        imgui.table_setup_column("kind", 0, KIND_EM * imgui.get_font_size())
        seen = _visible_rows(host, rows, seen)
        imgui.end_table()
        imgui.text_disabled(_totals(host.state.scene))
    imgui.end_child()
    return seen


def _visible_rows(host: Host, rows: tuple[OutlineRow, ...], seen: Item | None) -> Item | None:
    """Draw the visible rows, and scroll to an item that was selected elsewhere."""
    clipper = imgui.ListClipper()
    clipper.begin(len(rows))
    while clipper.step():
        for row in rows[clipper.display_start : clipper.display_end]:
            _row(host, row)
    last = next(iter(chosen(host.state)[-1:]), None)
    items = [row.item for row in rows]
    if last != seen and last in items and not imgui.is_window_hovered():
        place, room = items.index(last), imgui.get_window_height()
        imgui.set_scroll_y(scroll_to(place, clipper.items_height, imgui.get_scroll_y(), room))
    return last


def scroll_to(line: int, height: float, scrolled: float, room: float) -> float:
    """Return the least scrolling that makes a line visible.

    height: of a line; scrolled, room: the present scrolling, and the visible height.
    """
    top = line * height
    return min(max(scrolled, top + height - room), top)


def _add_menu(host: Host) -> None:
    if imgui.button("Add", (-1, 0)):
        imgui.open_popup("add")
    tip("a shape, a light or a model")
    below = imgui.get_item_rect_min().x, imgui.get_item_rect_max().y
    imgui.set_next_window_pos(below, imgui.Cond_.appearing)
    if imgui.begin_popup("add"):
        for action in ADDING:
            draw_entry(action, host)
        imgui.end_popup()


@lru_cache(maxsize=1)
def _totals(scene: Scene) -> str:
    """Return the totals of the scene as text."""
    rows = rows_of(scene)
    count, triangles = sum(len(row.ids) for row in rows), sum(row.triangles for row in rows)
    return f"{count:,} object{'s' * (count != 1)}, {triangles:,} triangles"


def _row(host: Host, row: OutlineRow) -> None:
    """Draw a row of the table: a checkbox that shows it, its name and its kind."""
    item = row.item
    imgui.table_next_row()
    imgui.push_id(str(item if item is not None else f"part {row.ids.start}"))
    if imgui.table_next_column() and item is not None:
        changed, on = checkbox("##shown", not row.hidden)
        tip("Light on" if row.is_light else SHOWN)
        if changed:
            edit(host, lambda state: editing.hidden(state, item, not on))
    imgui.table_next_column()
    _name(host, row)
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(row.kind)
    imgui.pop_id()


def _name(host: Host, row: OutlineRow) -> None:
    item, start, accent = row.item, imgui.get_cursor_screen_pos(), theme.ACCENT
    flags = imgui.SelectableFlags_.allow_overlap
    imgui.push_style_color(imgui.Col_.header, ImVec4(accent.x, accent.y, accent.z, 0.45))
    size = ImVec2(0, imgui.get_frame_height())
    clicked = imgui.selectable("##row", item in chosen(host.state), int(flags), size)[0]
    imgui.pop_style_color()
    imgui.set_cursor_screen_pos(start)
    imgui.align_text_to_frame_padding()
    shown = fitting_letters(row.shown, imgui.get_content_region_avail().x)
    imgui.text_colored(theme.DIM if row.hidden or item is None else theme.TEXT, shown)
    if shown != row.shown:
        tip(row.shown)
    if clicked and item is not None:
        io = imgui.get_io()
        more = io.key_ctrl or io.key_shift
        host.amend(choose_also(host.state, item) if more else choose(host.state, (item,)))
