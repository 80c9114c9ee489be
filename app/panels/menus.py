"""The menu bar, and the sheet of mouse and keys. Made from the table of actions.

Owns their look. Knows nothing of what actions do.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, hello_imgui, imgui

from app import theme
from app.actions import ACTIONS, MENUS, MOUSE, Window
from app.layout import LAYOUTS


def menu_bar(
    window: Window, builtin_scenes: tuple[str, ...], open_scene: Callable[[str], None]
) -> None:
    """All menus; call in HelloImGui's show_menus."""
    for menu in MENUS:
        if imgui.begin_menu(menu):
            if menu == "View":
                _windows()
            for action in ACTIONS:
                if action.menu != menu:
                    continue
                if action.separated:
                    imgui.separator()
                on = action.is_on(window.state) if action.is_on else False
                can = action.can(window) if action.can else True
                if imgui.menu_item(action.name, action.keys, on, can)[0]:
                    action.run(window)
                if action.name == "Open..." and imgui.begin_menu("Built-in scenes"):
                    for name in builtin_scenes:
                        if imgui.menu_item(name, "", False)[0]:
                            open_scene(name)
                    imgui.end_menu()
            imgui.end_menu()


def help_sheet(window: Window, fonts: theme.Fonts, version: str) -> None:
    """The sheet of mouse and keys, in the middle of the window."""
    center = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(center, imgui.Cond_.appearing, ImVec2(0.5, 0.5))
    flags = imgui.WindowFlags_
    opened, still_open = imgui.begin(
        "Mouse and keys",
        True,
        flags.no_docking | flags.always_auto_resize | flags.no_collapse | flags.no_saved_settings,
    )
    if opened:
        keys = [(action.keys, action.name) for action in ACTIONS if action.keys]
        _table("mouse", MOUSE, fonts)
        imgui.separator()
        _table("keys", keys, fonts)
        imgui.separator()
        imgui.text_disabled(f"lucida {version}: one camera, two renderers")
    imgui.end()
    if not still_open or imgui.is_key_pressed(imgui.Key.escape):
        window.toggle_help()


def _windows() -> None:
    for dockable in hello_imgui.get_runner_params().docking_params.dockable_windows:
        label = dockable.label.partition("###")[0]
        _, dockable.is_visible = imgui.menu_item(label, "", dockable.is_visible)
    imgui.separator()
    for layout in LAYOUTS:
        shown = layout.name == hello_imgui.current_layout_name()
        if imgui.menu_item(f"Layout: {layout.name}", "", shown)[0]:
            hello_imgui.switch_layout(layout.name)
    if imgui.menu_item("Reset the layout", "", False)[0]:
        hello_imgui.get_runner_params().docking_params.layout_reset = True
    imgui.separator()


def _table(name: str, rows: object, fonts: theme.Fonts) -> None:
    if imgui.begin_table(name, 2, imgui.TableFlags_.sizing_fixed_fit):
        for key, text in rows:  # type: ignore[attr-defined]
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.push_font(fonts.bold, 0.0)
            imgui.text(f"{key}   ")
            imgui.pop_font()
            imgui.table_next_column()
            imgui.text(text)
        imgui.end_table()
