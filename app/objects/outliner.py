"""The list of a scene's objects and lights: the Add menu, the search, the lines.

Takes a state and returns another. Selecting is separate from editing, since it is no undo step.
Only visible lines are drawn.
"""

from __future__ import annotations

from functools import lru_cache, partial

from imgui_bundle import ImVec2, imgui

from app.objects import editing
from app.objects.choosing import choose, chosen, rows_of
from app.objects.icons import WIDE_EM, icon
from app.objects.listed import Listed, ListLine, Outliner, lines_of, scroll_to
from app.objects.outliner_row import draw_line, dropped
from app.state.app_state import AppState
from app.widgets import theme
from app.widgets.rows import tip
from renderer.focus import Focus
from renderer.scene.model import Scene
from renderer.scene_editing import objects
from renderer.scene_editing.changing import Item
from renderer.scene_editing.outline import OutlineRow

EMPTY = "The scene has no objects. Add one, or drop a model here."
READ_ONLY = "This scene was made in Python, from meshes: it cannot be changed here."
NO_MATCH = "Nothing is called so."
SEARCH = "of a name, a kind, a material; Enter chooses all that is found"
NARROW_EM = 18.0  # narrower lists show no triangle counts


def outliner_panel(outliner: Outliner, state: AppState, focus: Focus) -> Listed:
    """Draw the list into the current window."""
    rows = rows_of(state.scene)
    result = _head(Listed.of(outliner, state), focus)
    if rows and all(row.item is None for row in rows):
        imgui.text_wrapped(READ_ONLY)
    elif not rows:
        imgui.text_wrapped(EMPTY)
    if rows and not result.rows:
        imgui.text_disabled(NO_MATCH)
    flags = (
        imgui.TableFlags_.row_bg
        | imgui.TableFlags_.no_pad_outer_x
        | imgui.TableFlags_.sizing_fixed_fit
        | imgui.TableFlags_.no_saved_settings
        | imgui.TableFlags_.hideable
    )
    em = imgui.get_font_size()
    narrow = imgui.get_content_region_avail().x < NARROW_EM * em
    # A table that scrolls by itself is a window that Tab does not go into.
    imgui.begin_child("list", (0, 0), imgui.ChildFlags_.nav_flattened)
    if result.rows and imgui.begin_table("items", 3, int(flags)):
        imgui.table_setup_column("name", int(imgui.TableColumnFlags_.width_stretch))
        imgui.table_setup_column("triangles", 0, 4.2 * em)
        imgui.table_set_column_enabled(1, not narrow)
        imgui.table_setup_column("switches", 0, (2 * WIDE_EM + 0.3) * em)
        result = _lines(result)
        _plain_row()
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(_whole(state.scene))
        result = _dropped_at_the_end(result)
        imgui.end_table()
    imgui.end_child()
    return result


def _lines(result: Listed) -> Listed:
    """Draw the visible lines, and the one whose name is being typed."""
    lines = _kept_lines(result.state.scene, result.outliner.words, result.outliner.opened)
    height = imgui.get_frame_height() + 2 * imgui.get_style().cell_padding.y
    result = _follow(lines, height, result)
    clipper = imgui.ListClipper()
    clipper.begin(len(lines), height)
    if result.outliner.renamed is not None:
        typed = result.outliner.renamed[0]
        for number, line in enumerate(lines):
            if line.row.item == typed and line.part is None:
                clipper.include_item_by_index(number)
    while clipper.step():
        for line in lines[clipper.display_start : clipper.display_end]:
            result = draw_line(line, result)
    return result


def _follow(lines: list[ListLine], height: float, result: Listed) -> Listed:
    """Scroll to what was selected elsewhere, in a view or with Tab."""
    items = chosen(result.state)
    last = items[-1] if items else None
    if last == result.outliner.seen:
        return result
    if last is not None and not imgui.is_window_hovered():
        for number, line in enumerate(lines):
            if line.row.item == last:
                room = imgui.get_window_height()
                imgui.set_scroll_y(scroll_to(number, height, imgui.get_scroll_y(), room))
                break
    return result.keeping(seen=last)


def _head(result: Listed, focus: Focus) -> Listed:
    """Draw the Add menu and the search."""
    if imgui.button("Add"):
        imgui.open_popup("add")
    tip("a shape, a light or a model")
    below = imgui.get_item_rect_min().x, imgui.get_item_rect_max().y
    imgui.set_next_window_pos(below, imgui.Cond_.appearing)
    if imgui.begin_popup("add"):
        for kind in (*objects.SHAPES, "", *objects.LIGHTS):
            if not kind:
                imgui.separator()
                continue
            label = f"{kind} light" if kind in objects.LIGHTS else kind
            if _offered(kind, label.capitalize()):
                result = result.tried(partial(editing.added, result.state, kind, focus))
        imgui.separator()
        if _offered("model", "Model..."):
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


def _offered(kind: str, label: str) -> bool:
    icon(kind, theme.TEXT)
    imgui.same_line()
    imgui.align_text_to_frame_padding()
    return bool(imgui.menu_item(label, "", False)[0])


@lru_cache(maxsize=1)
def _found(scene: Scene, words: str) -> list[OutlineRow]:
    """Return the rows found, cached because it is called in each frame."""
    return editing.found_in(rows_of(scene), words)


@lru_cache(maxsize=1)
def _kept_lines(scene: Scene, words: str, opened: frozenset[Item]) -> list[ListLine]:
    return lines_of(_found(scene, words), opened)


@lru_cache(maxsize=1)
def _whole(scene: Scene) -> str:
    """Return the totals of the scene as text."""
    rows = rows_of(scene)
    count, triangles = sum(len(row.ids) for row in rows), sum(row.triangles for row in rows)
    return f"{count:,} object{'s' * (count != 1)}, {triangles:,} triangles"


def _plain_row() -> None:
    """Draw a row that is not a line of the list."""
    imgui.table_next_row()
    imgui.table_set_bg_color(imgui.TableBgTarget_.row_bg0, 0)
    imgui.table_next_column()


def _dropped_at_the_end(result: Listed) -> Listed:
    room = imgui.get_content_region_avail()
    _plain_row()
    imgui.dummy(ImVec2(-1 if room.x < 1 else room.x, max(imgui.get_frame_height(), 1.0)))
    return dropped(None, result)
