"""The menu bar: the table's actions, and lists of scenes, recent files, views and last steps."""

from __future__ import annotations

from collections.abc import Sequence

from imgui_bundle import ImVec2, imgui

from lucida.app.cameras.camera_panel.actions import SCENE_VIEW, go_to_view
from lucida.app.lecture.view import LECTURE
from lucida.app.state.app_state import History
from lucida.app.state.changes import change
from lucida.app.ui import layout, theme
from lucida.app.ui.action import draw_entry
from lucida.app.ui.host import Host
from lucida.app.ui.stage import Stage
from lucida.renderer.files import SCENE_NAMES
from lucida.renderer.system.errors import one_line

from .action_table import ACTIONS, MENUS

HISTORY_STEPS = 15
ARROW = (-0.5, -0.25), (0.5, -0.25), (0, 0.4)  # corners, as fractions of its size


def menu_bar(window: Host, history: History, stage: Stage) -> None:
    """Draw all menus, in one of them if the bar is too narrow. Call in HelloImGui's show_menus."""
    name, style = layout.current().name, imgui.get_style()
    gap = 2 * style.item_spacing.x
    width = imgui.calc_text_size(name).x + imgui.get_font_size()  # with the arrow
    left = imgui.get_window_width() - width - gap
    if sum(imgui.calc_text_size(menu).x + gap for menu in MENUS[:-1]) <= left:
        _menus(MENUS[:-1], window, history, stage)
        imgui.set_cursor_pos_x(left)
        _layouts(window, name)
    elif imgui.begin_menu("Menu"):
        _menus(MENUS, window, history, stage)
        imgui.end_menu()


def menu_button(window: Host, history: History, stage: Stage) -> None:
    """Draw a button with all menus in the lower right corner of a lecture's text, in line with its
    footer, where it covers nothing.
    """
    column = stage.rects.get(LECTURE)
    if column is None:
        return
    imgui.set_next_window_pos(column[2:], pivot=(1, 1))
    flags = imgui.WindowFlags_
    imgui.begin(
        "##stage menu",
        None,
        flags.no_decoration
        | flags.always_auto_resize
        | flags.no_saved_settings
        | flags.no_docking
        | flags.no_background,
    )
    if imgui.button("Menu"):
        imgui.open_popup("menus")
    if imgui.begin_popup("menus"):
        _menus(MENUS, window, history, stage)
        imgui.end_popup()
    imgui.end()


def _menus(menus: Sequence[str], window: Host, history: History, stage: Stage) -> None:
    for menu in menus:
        if imgui.begin_menu(menu):
            if menu == "Instruments":
                _views(stage)
            _actions(menu, window, history)
            imgui.end_menu()


def _actions(menu: str, window: Host, history: History) -> None:
    """Draw the actions of a menu. A submenu is at the place of its first action."""
    drawn: set[str] = set()
    for action in ACTIONS:
        if action.menu == menu:
            draw_entry(action, window)
            if action.name == "Open...":
                _scenes(window)
                _recent(window)
            elif action.name == "Redo":
                _history(window, history)
            elif action.name == SCENE_VIEW:
                _file_views(window)
            continue
        parent, _, rest = action.menu.partition("/")
        if parent != menu or rest in drawn:
            continue
        drawn.add(rest)
        if action.separated:
            imgui.separator()
        if imgui.begin_menu(rest):
            _entries(action.menu, window)
            imgui.end_menu()


def _entries(menu: str, window: Host) -> None:
    for number, entry in enumerate(one for one in ACTIONS if one.menu == menu):
        draw_entry(entry, window, first=number == 0, below=menu == MENUS[-1])


def _scenes(window: Host) -> None:
    if imgui.begin_menu("Built-in scenes"):
        for name in SCENE_NAMES:
            if imgui.menu_item(name, "", False)[0]:
                window.files.open(name)
        imgui.end_menu()


def _recent(window: Host) -> None:
    recent = window.files.recent
    entries = recent.entries
    if not imgui.begin_menu("Recent files", bool(entries)):
        return
    if imgui.is_window_appearing():
        recent.look()
    for number, path in enumerate(entries):
        label = f"{one_line(path.name)}###recent{number}"
        if imgui.menu_item(label, _short(one_line(str(path.parent))), False)[0]:
            window.files.open(str(path))
    imgui.separator()
    if imgui.menu_item("Clear the list", "", False)[0]:
        recent.clear()
    imgui.end_menu()


def _file_views(window: Host) -> None:
    """Draw the cameras of the scene's file other than the initial view."""
    views = window.state.scene.views
    if imgui.begin_menu("From the file", bool(views)):
        for number, named in enumerate(views):
            shown = window.state.view == named.view
            if imgui.menu_item(f"{named.name}###view{number}", "", shown)[0]:
                go_to_view(window, named.view)
        imgui.end_menu()


def _short(text: str, most: int = 40) -> str:
    return text if len(text) <= most else "..." + text[3 - most :]


def _history(window: Host, history: History) -> None:
    """Draw the last steps, the newest on top; a click undoes or redoes up to that step."""
    if not imgui.begin_menu("History", bool(history.past or history.future)):
        return
    states = [*history.past, history.present, *history.future]
    here = len(history.past)
    first = max(0, here - HISTORY_STEPS)
    last = min(len(states) - 1, here + HISTORY_STEPS)
    for index in range(last, first - 1, -1):
        text = change(states[index - 1], states[index]) if index else "the beginning"
        if imgui.menu_item(f"{text}###step{index}", "", index == here)[0]:
            for _ in range(abs(index - here)):
                window.undo() if index < here else window.redo()
    imgui.end_menu()


def _views(stage: Stage) -> None:
    for name, view in stage.views.items():
        shown = stage.is_shown(name)
        label = " ".join(view.title.split())
        if imgui.menu_item(f"{label}###{name}", "", shown)[0]:
            stage.show(name, not shown)
    imgui.separator()


def _layouts(window: Host, name: str) -> None:
    """Draw the layout's name at the right end of the bar, as a menu to select another."""
    arrow, style = 0.5 * imgui.get_font_size(), imgui.get_style()
    corner = imgui.get_cursor_screen_pos()
    opened = imgui.begin_menu(f"{name}    ###{MENUS[-1]}")
    end = imgui.calc_text_size(name).x + style.item_spacing.x + arrow
    middle = corner + ImVec2(end, 0.5 * imgui.get_frame_height())
    draw = imgui.get_foreground_draw_list()
    first, second, tip = (middle + ImVec2(x, y) * arrow for x, y in ARROW)
    draw.add_triangle_filled(first, second, tip, theme.u32(theme.DIM))
    if opened:
        _entries(MENUS[-1], window)
        imgui.end_menu()
