"""The list of a scene's objects and lights: the Add menu, the search, the rows.

Takes a state and returns another. Selecting is separate from editing, since it is no undo step.
Only visible rows are drawn.
"""

from __future__ import annotations

from functools import lru_cache, partial

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.instruments.objects import editing
from lucida.app.instruments.objects.choosing import choose, choose_also, chosen, rows_of
from lucida.app.instruments.objects.listed import Listed, Outliner, scroll_to
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.lettering import fitting_letters
from lucida.app.ui.rows import tip
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import Item
from lucida.renderer.editing.outline import OutlineRow
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import Scene

EMPTY = "The scene has no objects. Add one, or drop a model here."
READ_ONLY = "This scene was made in Python, from meshes: it cannot be changed here."
NO_MATCH = "No matching object or light."
SEARCH = "words of a name, a kind or a file; Enter selects all rows that match"
SHOWN = "shown by both renderers"
KIND_EM = 5.0


def outliner_panel(outliner: Outliner, state: AppState, focus: Focus) -> Listed:
    """Draw the list into the current window."""
    rows = rows_of(state.scene)
    result = _head(Listed(outliner, state), focus)
    if rows and all(row.item is None for row in rows):
        imgui.text_wrapped(READ_ONLY)
    elif not rows:
        imgui.text_wrapped(EMPTY)
    if rows and not result.rows:
        imgui.text_disabled(NO_MATCH)
    flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.no_pad_outer_x
    flags |= imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.no_saved_settings
    # A table that scrolls by itself is a window that Tab does not go into.
    imgui.begin_child("list", (0, 0), imgui.ChildFlags_.nav_flattened)
    if result.rows and imgui.begin_table("items", 3, int(flags)):
        imgui.table_setup_column("shown", 0, imgui.get_frame_height())
        imgui.table_setup_column("name", int(imgui.TableColumnFlags_.width_stretch))
        imgui.table_setup_column("kind", 0, KIND_EM * imgui.get_font_size())
        result = _visible_rows(result)
        imgui.end_table()
        imgui.text_disabled(_totals(state.scene))
    imgui.end_child()
    return result


def _visible_rows(result: Listed) -> Listed:
    """Draw the visible rows."""
    items = [row.item for row in result.rows]
    clipper = imgui.ListClipper()
    clipper.begin(len(items))
    while clipper.step():
        for row in result.rows[clipper.display_start : clipper.display_end]:
            result = _row(row, result)
    selected = chosen(result.state)
    last = selected[-1] if selected else None
    if last != result.outliner.seen:  # scroll to an item that was selected elsewhere
        if last in items and not imgui.is_window_hovered():
            place, room = items.index(last), imgui.get_window_height()
            imgui.set_scroll_y(scroll_to(place, clipper.items_height, imgui.get_scroll_y(), room))
        result = result.keeping(seen=last)
    return result


def _head(result: Listed, focus: Focus) -> Listed:
    """Draw the Add menu and the search."""
    if imgui.button("Add"):
        imgui.open_popup("add")
    tip("a shape, a light or a model")
    below = imgui.get_item_rect_min().x, imgui.get_item_rect_max().y
    imgui.set_next_window_pos(below, imgui.Cond_.appearing)
    if imgui.begin_popup("add"):
        for kind in (*objects.SHAPES, *objects.LIGHTS):
            label = f"{kind} light" if kind in objects.LIGHTS else kind
            if imgui.menu_item(label.capitalize(), "", False)[0]:
                result = result.tried(partial(editing.added, result.state, kind, focus))
        imgui.separator()
        if imgui.menu_item("Model...", "", False)[0]:
            result = result.but(model=True)
        imgui.end_popup()
    imgui.same_line()
    imgui.set_next_item_width(-1)
    flags = int(imgui.InputTextFlags_.enter_returns_true)
    enter, words = imgui.input_text_with_hint("##search", "search", result.outliner.words, flags)
    tip(SEARCH)
    result = result.keeping(words=words).but(rows=_found(result.state.scene, words))
    if enter:
        found = [row.item for row in result.rows if row.item is not None]
        result = result.but(chosen=choose(result.state, found))
    return result


@lru_cache(maxsize=1)
def _found(scene: Scene, words: str) -> list[OutlineRow]:
    """Return the rows found, cached because it is called in each frame."""
    return editing.found_in(rows_of(scene), words)


@lru_cache(maxsize=1)
def _totals(scene: Scene) -> str:
    """Return the totals of the scene as text."""
    rows = rows_of(scene)
    count, triangles = sum(len(row.ids) for row in rows), sum(row.triangles for row in rows)
    return f"{count:,} object{'s' * (count != 1)}, {triangles:,} triangles"


def _row(row: OutlineRow, result: Listed) -> Listed:
    """Draw a row of the table: a checkbox that shows it, its name and its kind."""
    item = row.item
    imgui.table_next_row()
    imgui.push_id(str(item if item is not None else f"part {row.ids.start}"))
    if imgui.table_next_column() and item is not None:
        result = _shown(row, item, result)
    imgui.table_next_column()
    result = _name(row, result)
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(row.kind)
    imgui.pop_id()
    return result


def _shown(row: OutlineRow, item: Item, result: Listed) -> Listed:
    changed, on = checkbox("##shown", not row.hidden)
    tip("Light on" if row.is_light else SHOWN)
    if not changed:
        return result
    state, items = result.state, result.acted_on(item)
    return result.tried(lambda: editing.with_scene(state, objects.hide(state.scene, items, not on)))


def _name(row: OutlineRow, result: Listed) -> Listed:
    item = row.item
    start = imgui.get_cursor_screen_pos()
    kinds = imgui.SelectableFlags_
    flags = kinds.allow_overlap
    accent = theme.ACCENT
    imgui.push_style_color(imgui.Col_.header, ImVec4(accent.x, accent.y, accent.z, 0.45))
    size = ImVec2(0, imgui.get_frame_height())
    clicked = imgui.selectable("##row", item in chosen(result.state), int(flags), size)[0]
    imgui.pop_style_color()
    imgui.set_cursor_screen_pos(start)
    imgui.align_text_to_frame_padding()
    shown = fitting_letters(row.shown, imgui.get_content_region_avail().x)
    imgui.text_colored(theme.DIM if row.hidden or item is None else theme.TEXT, shown)
    if shown != row.shown:
        tip(row.shown)
    if not clicked or item is None:
        return result
    io, state, anchor = imgui.get_io(), result.state, result.outliner.anchor
    if io.key_shift and anchor is not None:
        return result.but(chosen=choose(state, editing.reached(result.rows, anchor, item)))
    result = result.keeping(anchor=item)
    return result.but(chosen=choose_also(state, item) if io.key_ctrl else choose(state, (item,)))
