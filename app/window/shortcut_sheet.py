"""The sheet of mouse and keys: every key that does something, by menu, in columns.

Made from the table of app/window/action_table.py, and from what the instruments say of their mouse
and keys. Owns its look.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.lettering import lettering
from lucida.app.ui.messages import wrapped

from .action_table import ACTIONS, MOUSE
from .instruments import INSTRUMENTS

COLUMN_EM = 24.0
MOST_COLUMNS = 4
KEYS = 0.36  # the keys' part of a column
NAME = "Mouse and keys"

Row = tuple[str, str]  # keys, what they do
Part = tuple[str, list[Row]]  # a heading, and its rows
ESCAPE: Row = ("Esc", "take back the drag of a handle; close what lies on top; leave presentation")
MOVING: tuple[Row, ...] = (
    ("Ctrl+Tab", "from view to view"),
    ("Tab, arrows", "from control to control; Space uses it"),
    ("arrows in the outside view", "turn it; Shift: faster"),
    *(row for instrument in INSTRUMENTS for row in instrument.keyboard),
    ("Alt, F10", "into the menus and back"),
    ESCAPE,
)


def sections() -> list[Part]:
    """Return the sheet's parts in their order."""
    parts: dict[str, list[Row]] = {"Mouse": list(MOUSE)}
    for action in ACTIONS:
        if action.keys:
            heading = action.menu.split("/")[0]
            parts.setdefault(heading, []).append((action.keys, action.name))
    parts["Everywhere"] = list(MOVING)
    return [(heading, _folded(rows)) for heading, rows in parts.items()]


def _folded(rows: list[Row]) -> list[Row]:
    """Return the rows; those that differ in a digit alone (bookmarks 1 to 9) become one."""
    alike: dict[str, list[Row]] = {}
    for row in rows:
        alike.setdefault(re.sub(r"\d", "#", "|".join(row)), []).append(row)
    return [
        few[0] if len(few) == 1 else (f"{few[0][0]} to {few[-1][0]}", f"{few[0][1]} to {len(few)}")
        for few in alike.values()
    ]


def help_sheet(fonts: theme.Fonts, version: str) -> bool:
    """Draw the sheet. Return True while it stays open."""
    viewport, em = imgui.get_main_viewport(), imgui.get_font_size()
    room = viewport.work_size * 0.97
    count = max(1, min(MOST_COLUMNS, int(room.x / (COLUMN_EM * em))))
    width = min(room.x, count * 1.1 * COLUMN_EM * em)
    imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.always, (0.5, 0.5))
    imgui.set_next_window_size_constraints((width, 0), (width, room.y))
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
    opened, still_open = imgui.begin(
        NAME,
        True,
        flags.no_docking | flags.no_collapse | flags.no_saved_settings | flags.always_auto_resize,
    )
    imgui.pop_style_color()
    if opened:
        imgui.push_style_var(imgui.StyleVar_.cell_padding, (0.2 * em, 0.03 * em))
        wrapped(f"lucida {version}: one camera, two renderers", theme.DIM)
        if imgui.begin_table("columns", count, imgui.TableFlags_.sizing_stretch_same):
            for column in in_columns(sections(), count):
                imgui.table_next_column()
                for heading, rows in column:
                    _section(heading, rows, fonts)
            imgui.end_table()
        imgui.pop_style_var()
    imgui.end()
    return bool(still_open)


def in_columns(parts: Sequence[Part], columns: int) -> list[list[Part]]:
    """Return the parts in columns of about one height: each, the longest first, goes into the
    shortest column. There, and from column to column, they keep their order.
    """
    found: list[list[int]] = [[] for _ in range(columns)]
    heights = [0] * columns
    for number in sorted(range(len(parts)), key=lambda k: -len(parts[k][1])):
        shortest = heights.index(min(heights))
        found[shortest].append(number)
        heights[shortest] += len(parts[number][1]) + 2
    return [[parts[k] for k in sorted(column)] for column in sorted(map(sorted, found)) if column]


def _section(heading: str, rows: list[Row], fonts: theme.Fonts) -> None:
    with lettering(fonts.bold):
        wrapped(heading, theme.legible(theme.RAY))
    if imgui.begin_table(heading, 2, imgui.TableFlags_.sizing_stretch_prop):
        # The same in every part: words stand below one another.
        stretch = imgui.TableColumnFlags_.width_stretch
        imgui.table_setup_column("keys", stretch, KEYS)
        imgui.table_setup_column("what", stretch, 1 - KEYS)
        for keys, what in rows:
            imgui.table_next_column()
            with lettering(fonts.bold):
                wrapped(keys)
            imgui.table_next_column()
            wrapped(what)
        imgui.end_table()
    imgui.dummy((0, 0.3 * imgui.get_font_size()))
