"""The list of a scene's objects and lights: search, signs, switches, names, order.

Owns its look. Gets a state and returns another; what is chosen is told apart from what is changed,
since choosing is no step of undo.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from imgui_bundle import ImVec2, ImVec4, imgui

from app.cameras.focus import Focus
from app.objects import editing
from app.objects.choosing import choose, choose_also, chosen, rows_of
from app.objects.icons import WIDE_EM, icon, switch
from app.state.app_state import AppState
from app.widgets import theme
from renderer.errors import LucidaError
from renderer.scene_editing import objects
from renderer.scene_editing.changing import Item
from renderer.scene_editing.outline import OutlineRow

DRAGGED = "lucida item"  # what ImGui carries
EMPTY = "The scene has no objects. Add one, or drop a model here."
READ_ONLY = "This scene was made in Python, from meshes: it cannot be changed here."
NO_MATCH = "Nothing is called so."
NARROW_EM = 14.0  # a list that is narrower tells no triangles


@dataclass(frozen=True)
class Outliner:
    """What the list keeps. words: of the search. renamed: the item whose name is being typed, and
    the name; begun: whether its field was drawn already. anchor: where a range of rows begins."""

    words: str = ""
    renamed: tuple[Item, str] | None = None
    begun: bool = False
    anchor: Item | None = None


@dataclass(frozen=True)
class Listed:
    """changed: the state after edits; chosen: with another choice, no step of undo; None for none.
    problem: why an edit was not possible. framed: the item that the camera is to go to. model:
    whether a model's file is to be chosen."""

    outliner: Outliner
    changed: AppState | None = None
    chosen: AppState | None = None
    problem: str = ""
    framed: Item | None = None
    model: bool = False


def outliner_panel(outliner: Outliner, state: AppState, focus: Focus) -> Listed:
    """Draws the list into the current window."""
    result = _head(outliner, state, focus)
    rows = rows_of(state.scene)
    if rows and all(row.item is None for row in rows):
        imgui.text_wrapped(READ_ONLY)
    elif not rows:
        imgui.text_wrapped(EMPTY)
    found = editing.found_in(rows, result.outliner.words)
    if rows and not found:
        imgui.text_disabled(NO_MATCH)
    flags = (
        imgui.TableFlags_.scroll_y
        | imgui.TableFlags_.row_bg
        | imgui.TableFlags_.no_pad_outer_x
        | imgui.TableFlags_.sizing_fixed_fit
        | imgui.TableFlags_.no_saved_settings
        | imgui.TableFlags_.hideable
    )
    em = imgui.get_font_size()
    narrow = imgui.get_content_region_avail().x < NARROW_EM * em
    if found and imgui.begin_table("items", 3, int(flags)):
        imgui.table_setup_column("name", int(imgui.TableColumnFlags_.width_stretch))
        imgui.table_setup_column("triangles", 0, 4.2 * em)
        imgui.table_set_column_enabled(1, not narrow)
        imgui.table_setup_column("switches", 0, (2 * WIDE_EM + 0.3) * em)
        for row in found:
            result = _row(row, found, state, result)
        _end(state, result)
        result = _dropped_at_the_end(state, result)
        imgui.end_table()
    return result


def _head(outliner: Outliner, state: AppState, focus: Focus) -> Listed:
    """What adds, and the search."""
    result = Listed(outliner)
    if imgui.button("Add"):
        imgui.open_popup("add")
    imgui.set_item_tooltip("a shape, a light or a model")
    if imgui.begin_popup("add"):
        for kind in (*objects.SHAPES, "", *objects.LIGHTS):
            if not kind:
                imgui.separator()
                continue
            icon(kind, theme.TEXT)
            imgui.same_line()
            label = f"{kind} light" if kind in objects.LIGHTS else kind
            if imgui.menu_item(label.capitalize(), "", False)[0]:
                result = _tried(result, partial(editing.added, state, kind, focus))
        imgui.separator()
        icon("model", theme.TEXT)
        imgui.same_line()
        if imgui.menu_item("Model...", "", False)[0]:
            result = Listed(outliner, model=True)
        imgui.end_popup()
    imgui.same_line()
    imgui.set_next_item_width(-1)
    changed, words = imgui.input_text_with_hint("##search", "search", outliner.words)
    if changed:
        result = _with(result, outliner=_outliner(result, words=words))
    return result


def _row(row: OutlineRow, rows: list[OutlineRow], state: AppState, result: Listed) -> Listed:
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.push_id(str(row.item if row.item is not None else f"part {row.ids.start}"))
    result = _name(row, rows, state, result)
    if imgui.table_next_column() and row.triangles:
        text = f"{row.triangles:,}"
        room = imgui.get_content_region_avail().x - imgui.calc_text_size(text).x
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(room, 0.0))
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(text)
        imgui.set_item_tooltip("triangles")
    imgui.table_next_column()
    if row.item is not None:
        result = _switches(row, state, result)
    imgui.pop_id()
    return result


def _name(row: OutlineRow, rows: list[OutlineRow], state: AppState, result: Listed) -> Listed:
    item, items = row.item, chosen(state)
    dim = row.hidden or item is None
    renamed = result.outliner.renamed
    if renamed is not None and renamed[0] == item:
        icon(row.kind, theme.TEXT)
        imgui.same_line(0, 0)
        return _rename_field(row, state, result)
    start = imgui.get_cursor_screen_pos()
    indent = WIDE_EM * imgui.get_font_size()
    opened = False
    if row.parts:
        opened = imgui.tree_node_ex("##parts", int(imgui.TreeNodeFlags_.no_tree_push_on_open))
        imgui.same_line(0, 0)
        start = imgui.get_cursor_screen_pos()
    kinds = imgui.SelectableFlags_
    flags = kinds.allow_double_click | kinds.allow_overlap | kinds.span_all_columns
    accent = theme.ACCENT
    imgui.push_style_color(imgui.Col_.header, ImVec4(accent.x, accent.y, accent.z, 0.45))
    imgui.push_style_var(imgui.StyleVar_.selectable_text_align, (0.0, 0.5))
    size = ImVec2(0, imgui.get_frame_height())
    clicked = imgui.selectable("##row", item is not None and item in items, int(flags), size)[0]
    imgui.pop_style_var()
    imgui.pop_style_color()
    if item is not None:
        result = _row_menu(row, state, result)
        result = _dragged(row, state, result)
    imgui.set_cursor_screen_pos(start)
    icon(row.kind, theme.DIM if dim else theme.TEXT)
    imgui.same_line(0, 0.3 * imgui.get_font_size())
    imgui.align_text_to_frame_padding()
    imgui.text_colored(theme.DIM if dim else theme.TEXT, row.shown)
    if clicked and item is not None:
        if imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            result = _with(result, outliner=_outliner(result, renamed=(item, row.name)))
        else:
            result = _clicked(item, rows, state, result)
    if opened:
        for part in row.parts:
            imgui.indent(2 * indent)
            imgui.text_disabled(part.name or f"part {part.number}")
            imgui.unindent(2 * indent)
    return result


def _clicked(item: Item, rows: list[OutlineRow], state: AppState, result: Listed) -> Listed:
    io = imgui.get_io()
    outliner = _outliner(result, anchor=item)
    if io.key_shift and result.outliner.anchor is not None:
        reached = editing.reached(rows, result.outliner.anchor, item)
        return _with(result, chosen=choose(state, reached))
    if io.key_ctrl:
        return _with(result, chosen=choose_also(state, item), outliner=outliner)
    return _with(result, chosen=choose(state, (item,)), outliner=outliner)


def _rename_field(row: OutlineRow, state: AppState, result: Listed) -> Listed:
    assert result.outliner.renamed is not None
    item, name = result.outliner.renamed
    if not result.outliner.begun:
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(-1)
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    done, name = imgui.input_text("##name", name, int(flags))
    left = imgui.is_item_deactivated()
    outliner = _outliner(result, renamed=(item, name), begun=True)
    if not (done or left):
        return _with(result, outliner=outliner)
    result = _with(result, outliner=_outliner(result, renamed=None))
    if imgui.is_key_pressed(imgui.Key.escape) or name == row.name:
        return result
    return _tried(
        result,
        lambda: editing.with_scene(state, objects.rename(state.scene, item, name)),
    )


def _switches(row: OutlineRow, state: AppState, result: Listed) -> Listed:
    assert row.item is not None
    items = chosen(state) if row.item in chosen(state) else (row.item,)
    eye = "no eye" if row.hidden else "eye"
    if switch("eye", eye, not row.hidden, "shown by both renderers, or hidden"):
        hidden = not row.hidden
        result = _tried(
            result, lambda: editing.with_scene(state, objects.hide(state.scene, items, hidden))
        )
    imgui.same_line(0, 0)
    lock = "lock" if row.locked else "no lock"
    if switch("lock", lock, row.locked, "locked: clicks and handles leave it alone"):
        locked = not row.locked
        result = _tried(
            result, lambda: editing.with_scene(state, objects.lock(state.scene, items, locked))
        )
    return result


def _row_menu(row: OutlineRow, state: AppState, result: Listed) -> Listed:
    item = row.item
    assert item is not None
    if not imgui.begin_popup_context_item("menu"):
        return result
    if item not in chosen(state):
        result = _with(result, chosen=choose(state, (item,)))
    if imgui.menu_item("Rename", "", False)[0]:
        result = _with(result, outliner=_outliner(result, renamed=(item, row.name)))
    if not row.is_light and imgui.menu_item("Frame it", "", False)[0]:
        result = _with(result, framed=item)
    if imgui.menu_item("Delete", "", False, not row.locked)[0]:
        result = _tried(result, lambda: editing.deleted(choose(state, (item,))))
    imgui.end_popup()
    return result


def _dragged(row: OutlineRow, state: AppState, result: Listed) -> Listed:
    """A row that is dragged, and one that something is dropped on."""
    assert row.item is not None
    if imgui.begin_drag_drop_source():
        imgui.set_drag_drop_payload_py_id(DRAGGED, row.item)
        imgui.text(row.shown)
        imgui.end_drag_drop_source()
    return _dropped(row.item, state, result)


def _dropped(before: Item | None, state: AppState, result: Listed) -> Listed:
    if not imgui.begin_drag_drop_target():
        return result
    payload = imgui.accept_drag_drop_payload_py_id(DRAGGED)
    imgui.end_drag_drop_target()
    if payload is None or payload.data_id == before:
        return result
    item = int(payload.data_id)
    return _tried(result, lambda: editing.reordered(state, item, before))


def _dropped_at_the_end(state: AppState, result: Listed) -> Listed:
    room = imgui.get_content_region_avail()
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.dummy(ImVec2(-1 if room.x < 1 else room.x, max(imgui.get_frame_height(), 1.0)))
    return _dropped(None, state, result)


def _end(state: AppState, result: Listed) -> None:
    """What the whole holds."""
    objects_count = sum(len(row.ids) for row in rows_of(state.scene))
    triangles = sum(row.triangles for row in rows_of(state.scene))
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    noun = "object" if objects_count == 1 else "objects"
    imgui.text_disabled(f"{objects_count:,} {noun}, {triangles:,} triangles")


def _tried(result: Listed, edit: Callable[[], AppState]) -> Listed:
    """An edit, or why it is not possible."""
    try:
        return _with(result, changed=edit())
    except LucidaError as error:
        return _with(result, problem=str(error))


def _with(result: Listed, **changes: object) -> Listed:
    return replace(result, **changes)  # type: ignore[arg-type]


def _outliner(result: Listed, **changes: object) -> Outliner:
    begun = {} if "renamed" not in changes or "begun" in changes else {"begun": False}
    return replace(result.outliner, **{**begun, **changes})  # type: ignore[arg-type]
