"""A line of the list of objects: its icon and name, its triangles, its switches, its menu.

It handles clicks, double clicks and drags.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from app.objects import editing
from app.objects.choosing import choose, choose_also
from app.objects.icons import LOCKED, SHOWN, WIDE_EM, icon, switch
from app.objects.listed import Listed, ListLine
from app.widgets import theme
from app.widgets.lettering import fitting_letters
from app.widgets.rows import tip
from renderer.scene_editing import objects
from renderer.scene_editing.changing import Item
from renderer.scene_editing.outline import ModelPart, OutlineRow

DRAGGED = "lucida item"  # what ImGui carries


def draw_line(line: ListLine, result: Listed) -> Listed:
    """Draw a row of the table, in the current window."""
    row = line.row
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.push_id(str(row.item if row.item is not None else f"part {row.ids.start}"))
    if line.part is not None:
        _part(line.part)
    else:
        result = _name(row, result)
    shown = row.triangles if line.part is None else line.part.triangles
    if imgui.table_next_column() and shown:
        text = f"{shown:,}"
        room = imgui.get_content_region_avail().x - imgui.calc_text_size(text).x
        if room >= 0:
            imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + room)
            imgui.align_text_to_frame_padding()
            imgui.text_disabled(text)
            tip("triangles")
    imgui.table_next_column()
    if row.item is not None and line.part is None:
        result = _switches(row, result)
    imgui.pop_id()
    return result


def _part(part: ModelPart) -> None:
    imgui.dummy(ImVec2(2.5 * WIDE_EM * imgui.get_font_size(), imgui.get_frame_height()))
    imgui.same_line(0, 0)
    imgui.align_text_to_frame_padding()
    name = part.name or f"part {part.number}"
    imgui.text_disabled(fitting_letters(name, imgui.get_content_region_avail().x))
    tip(name)


def _name(row: OutlineRow, result: Listed) -> Listed:
    item = row.item
    dim = row.hidden or item is None
    renamed = result.outliner.renamed
    if renamed is not None and renamed[0] == item:
        icon(row.kind, theme.TEXT)
        imgui.same_line(0, 0)
        return _rename_field(row, result)
    start = imgui.get_cursor_screen_pos()
    if row.parts and item is not None:
        imgui.set_next_item_open(item in result.outliner.opened)
        imgui.tree_node_ex("##parts", int(imgui.TreeNodeFlags_.no_tree_push_on_open))
        if imgui.is_item_toggled_open():
            result = result.keeping(opened=result.outliner.opened ^ {item})
        imgui.same_line(0, 0)
        start = imgui.get_cursor_screen_pos()
    kinds = imgui.SelectableFlags_
    flags = kinds.allow_double_click | kinds.allow_overlap | kinds.span_all_columns
    accent = theme.ACCENT
    imgui.push_style_color(imgui.Col_.header, ImVec4(accent.x, accent.y, accent.z, 0.45))
    imgui.push_style_var(imgui.StyleVar_.selectable_text_align, (0.0, 0.5))
    size = ImVec2(0, imgui.get_frame_height())
    clicked = imgui.selectable("##row", item in result.items, int(flags), size)[0]
    imgui.pop_style_var()
    imgui.pop_style_color()
    if item is not None:
        result = _row_menu(row, item, result)
        result = _dragged(row, item, result)
    imgui.set_cursor_screen_pos(start)
    icon(row.kind, theme.DIM if dim else theme.TEXT)
    imgui.same_line(0, 0.3 * imgui.get_font_size())
    imgui.align_text_to_frame_padding()
    shown = fitting_letters(row.shown, imgui.get_content_region_avail().x)
    imgui.text_colored(theme.DIM if dim else theme.TEXT, shown)
    if shown != row.shown:
        tip(row.shown)
    if clicked and item is not None:
        if imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            return result.renaming(row)
        return _clicked(item, result)
    return result


def _clicked(item: Item, result: Listed) -> Listed:
    io, state, anchor = imgui.get_io(), result.state, result.outliner.anchor
    if io.key_shift and anchor is not None:
        return result.but(chosen=choose(state, editing.reached(result.rows, anchor, item)))
    result = result.keeping(anchor=item)
    return result.but(chosen=choose_also(state, item) if io.key_ctrl else choose(state, (item,)))


def _rename_field(row: OutlineRow, result: Listed) -> Listed:
    assert result.outliner.renamed is not None
    item, name = result.outliner.renamed
    if not result.outliner.begun:
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(-1)
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    done, name = imgui.input_text("##name", name, int(flags))
    if not (done or imgui.is_item_deactivated()):
        return result.keeping(renamed=(item, name), begun=True)
    result = result.keeping(renamed=None, begun=False)
    if imgui.is_key_pressed(imgui.Key.escape) or name == row.name:
        return result
    state = result.state
    return result.tried(lambda: editing.with_scene(state, objects.rename(state.scene, item, name)))


def _switches(row: OutlineRow, result: Listed) -> Listed:
    assert row.item is not None
    state, items = result.state, result.meant(row.item)
    eye, lock = "no eye" if row.hidden else "eye", "lock" if row.locked else "no lock"
    if switch("eye", eye, not row.hidden, SHOWN):
        scene, hidden = state.scene, not row.hidden
        result = result.tried(lambda: editing.with_scene(state, objects.hide(scene, items, hidden)))
    imgui.same_line(0, 0)
    if switch("lock", lock, row.locked, LOCKED):
        scene, locked = state.scene, not row.locked
        result = result.tried(lambda: editing.with_scene(state, objects.lock(scene, items, locked)))
    return result


def _row_menu(row: OutlineRow, item: Item, result: Listed) -> Listed:
    if not imgui.begin_popup_context_item("menu"):
        return result
    state = result.state
    if item not in result.items:
        result = result.but(chosen=choose(state, (item,)))
    if imgui.menu_item("Rename", "", False)[0]:
        result = result.renaming(row)
    if not row.is_light and imgui.menu_item("Frame it", "", False)[0]:
        result = result.but(framed=item)
    if imgui.menu_item("Delete", "", False, not row.locked)[0]:
        result = result.tried(lambda: editing.deleted(choose(state, (item,))))
    imgui.end_popup()
    return result


def _dragged(row: OutlineRow, item: Item, result: Listed) -> Listed:
    """Let a row be dragged, and accept drops on it."""
    if imgui.begin_drag_drop_source():
        imgui.set_drag_drop_payload_py_id(DRAGGED, item)
        imgui.text(row.shown)
        imgui.end_drag_drop_source()
    return dropped(item, result)


def dropped(before: Item | None, result: Listed) -> Listed:
    """Return the rows dropped on the last item, and the item to place them before; None for the
    end.
    """
    if not imgui.begin_drag_drop_target():
        return result
    payload = imgui.accept_drag_drop_payload_py_id(DRAGGED)
    imgui.end_drag_drop_target()
    if payload is None or payload.data_id == before:
        return result
    item = int(payload.data_id)
    return result.tried(lambda: editing.reordered(result.state, item, before))
