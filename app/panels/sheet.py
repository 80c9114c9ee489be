"""The sheet of mouse and keys: every key that does something, by menu, in columns.

Made from the table of app/actions/table.py. Owns its look.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from imgui_bundle import ImVec2, imgui

from app import theme
from app.actions.table import ACTIONS, MENUS, MOUSE

COLUMN_EM = 22.5
NARROW_EM = 20.0  # a column of less has what a key does below the key
KEYS = 0.36  # the keys' part of a column
NAME = "Mouse and keys"

STEPPING = "Lecture/Loop stepper"  # the submenu whose keys hold only where the keyboard is

Row = tuple[str, str]  # keys, what they do
ESCAPE: Row = ("Esc", "close what lies on top; cancel loading; leave presentation")
MOVING: tuple[Row, ...] = (
    ("Ctrl+Tab", "from view to view"),
    ("Tab, arrows", "from widget to widget; Space or Enter uses it"),
    ("arrows in the probe", "another pixel; Shift: by ten"),
    ("Alt", "into the menus"),
    ESCAPE,
)


def sections() -> list[tuple[str, list[Row]]]:
    """The sheet's parts in their order: a heading, and rows of keys and words."""
    parts: list[tuple[str, list[Row]]] = [("Mouse", list(MOUSE))]
    for menu in MENUS:
        rows: list[Row] = []
        for action in ACTIONS:
            if action.keys and action.menu.split("/")[0] == menu and action.menu != STEPPING:
                rows.append((action.keys, action.name))
        if rows:
            parts.append((menu, _folded(rows)))
        if STEPPING.split("/")[0] == menu:
            keys = [
                (a.keys, a.name.removeprefix("Stepper: ")) for a in ACTIONS if a.menu == STEPPING
            ]
            parts.append(("Loop stepper, once it is clicked", keys))
    parts.append(("Everywhere", list(MOVING)))
    return parts


def _folded(rows: list[Row]) -> list[Row]:
    """Runs of rows that differ in a digit alone (bookmarks 1 to 9) become one."""
    folded: list[tuple[str, Row, Row]] = []  # pattern, first, last
    for row in rows:
        pattern = "".join("#" if c.isdigit() else c for c in f"{row[0]}|{row[1]}")
        if folded and folded[-1][0] == pattern and "#" in pattern.partition("|")[2]:
            folded[-1] = (pattern, folded[-1][1], row)
        else:
            folded.append((pattern, row, row))
    return [
        first
        if first == last
        else (f"{first[0]} to {last[0]}", f"{first[1]} to {_digits(last[1])}")
        for _, first, last in folded
    ]


def _digits(text: str) -> str:
    return "".join(c for c in text if c.isdigit())


def help_sheet(fonts: theme.Fonts, version: str) -> bool:
    """Draws the sheet; gives whether it stays open."""
    viewport = imgui.get_main_viewport()
    em = imgui.get_font_size()
    columns = max(1, min(3, int(0.94 * viewport.work_size.x / (COLUMN_EM * em))))
    size = ImVec2(
        min(columns * COLUMN_EM * em + 2 * em, 0.96 * viewport.work_size.x),
        0.9 * viewport.work_size.y,
    )
    imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.always, ImVec2(0.5, 0.5))
    imgui.set_next_window_size(size, imgui.Cond_.always)
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
    opened, still_open = imgui.begin(
        NAME,
        True,
        flags.no_docking | flags.no_collapse | flags.no_saved_settings | flags.no_resize,
    )
    imgui.pop_style_color()
    if opened:
        imgui.push_text_wrap_pos(0.0)
        imgui.text_colored(theme.DIM, f"lucida {version}: one camera, two renderers")
        imgui.pop_text_wrap_pos()
        if imgui.begin_table("columns", columns, imgui.TableFlags_.sizing_stretch_same):
            imgui.table_next_row()
            parts = sections()
            width = size.x / columns - 1.5 * em
            heights = [_lines(rows, width) for _, rows in parts]
            for part in in_columns(parts, columns, heights):
                imgui.table_next_column()
                for heading, rows in part:
                    _section(heading, rows, fonts)
            imgui.end_table()
    imgui.end()
    return bool(still_open)


def in_columns(
    parts: Sequence[tuple[str, list[Row]]], columns: int, lines: Sequence[int]
) -> list[list[tuple[str, list[Row]]]]:
    """The parts in their order, so that the longest column is as short as can be. lines: that the
    rows of each take."""
    heights = [count + 2 for count in lines]
    for most in range(max(heights), sum(heights) + 1):
        found: list[list[tuple[str, list[Row]]]] = [[]]
        room = most
        for part, height in zip(parts, heights, strict=True):
            if height > room:
                found.append([])
                room = most
            found[-1].append(part)
            room -= height
        if len(found) <= columns:
            return found
    return [list(parts)]


def _lines(rows: list[Row], width_px: float) -> int:
    """How many lines the rows take in a column; keys and words are broken in their own parts."""
    keys_px, words_px = KEYS * width_px, (1 - KEYS) * width_px
    parts = [
        max(imgui.calc_text_size(keys).x / keys_px, imgui.calc_text_size(what).x / words_px)
        for keys, what in rows
    ]
    return sum(max(1, math.ceil(1.1 * part)) for part in parts)


def _section(heading: str, rows: list[Row], fonts: theme.Fonts) -> None:
    narrow = imgui.get_content_region_avail().x < NARROW_EM * imgui.get_font_size()
    imgui.push_text_wrap_pos(0.0)
    imgui.push_font(fonts.bold, 0.0)
    imgui.text_colored(theme.legible(theme.RAY), heading)
    imgui.pop_font()
    if narrow:
        for keys, what in rows:
            imgui.push_font(fonts.bold, 0.0)
            imgui.text(keys)
            imgui.pop_font()
            imgui.indent()
            imgui.text(what)
            imgui.unindent()
    imgui.pop_text_wrap_pos()
    if not narrow and imgui.begin_table(heading, 2, imgui.TableFlags_.sizing_stretch_prop):
        # The same in every part: words stand below one another.
        stretch = imgui.TableColumnFlags_.width_stretch
        imgui.table_setup_column("keys", stretch, KEYS)
        imgui.table_setup_column("what", stretch, 1 - KEYS)
        for keys, what in rows:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.push_font(fonts.bold, 0.0)
            imgui.push_text_wrap_pos(0.0)
            imgui.text(keys)
            imgui.pop_font()
            imgui.table_next_column()
            imgui.text(what)
            imgui.pop_text_wrap_pos()
        imgui.end_table()
    imgui.spacing()
