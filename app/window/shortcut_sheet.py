"""The sheet of mouse and keys: every key that does something, by menu, in columns.

Made from the table of app/window/action_table.py, and from what the instruments say of their mouse
and keys. Owns its look.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

from app.host.action import Action
from app.widgets import theme
from app.widgets.messages import wrapped
from app.window.action_table import ACTIONS, MENUS, MOUSE
from app.window.instruments import INSTRUMENTS

COLUMN_EM = 20.5
MOST_COLUMNS = 4
ROW_PAD = 0.03  # above and below a row, in parts of its type
OWN_PART = 8  # a submenu of so many keys has a heading of its own
NARROW_EM = 18.0  # a column of less has what a key does below the key
KEYS = 0.36  # the keys' part of a column
NAME = "Mouse and keys"

Row = tuple[str, str]  # keys, what they do
ESCAPE: Row = ("Esc", "take back the drag of a handle; close what lies on top; leave presentation")
MOVING: tuple[Row, ...] = (
    ("Ctrl+Tab", "from view to view"),
    ("Tab, arrows", "from control to control; Space uses it"),
    ("arrows in the outside view", "turn it; Shift: faster"),
    *(row for instrument in INSTRUMENTS.values() for row in instrument.keyboard),
    ("Alt, F10", "into the menus and back"),
    ESCAPE,
)


def sections() -> list[tuple[str, list[Row]]]:
    """The sheet's parts in their order: a heading, and rows of keys and words."""
    parts: list[tuple[str, list[Row]]] = [("Mouse", list(MOUSE))]
    apart = [instrument for instrument in INSTRUMENTS.values() if instrument.heading]
    own = [action for instrument in apart for action in instrument.actions]
    for menu in MENUS:
        by_submenu: dict[str, list[Row]] = {}
        for action in ACTIONS:
            if action.keys and _is_in(action, menu) and action not in own:
                by_submenu.setdefault(action.menu, []).append((action.keys, action.name))
        folded = {name: _joined(_folded(rows)) for name, rows in by_submenu.items()}
        large = [name for name, rows in folded.items() if "/" in name and len(rows) >= OWN_PART]
        rest = [row for name, rows in folded.items() if name not in large for row in rows]
        if rest:
            parts.append((menu, rest))
        parts += [(name.split("/")[1], folded[name]) for name in large]
        for instrument in apart:
            # Of "Stepper: play and pause", the heading says the first part.
            keys = [
                (action.keys, action.name.rpartition(": ")[2])
                for action in instrument.actions
                if action.keys and _is_in(action, menu)
            ]
            if keys:
                parts.append((instrument.heading, keys))
    parts.append(("Everywhere", list(MOVING)))
    return parts


def _is_in(action: Action, menu: str) -> bool:
    """Return True if the action is in a menu of the bar, or in one of its submenus."""
    return action.menu.split("/")[0] == menu


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


def _joined(rows: list[Row]) -> list[Row]:
    """Neighbours of one kind, "Objects: move" and "Objects: turn", on the same modifier keys become
    one row."""
    joined: list[Row] = []
    for keys, what in rows:
        last_keys, last = joined[-1] if joined else ("", "")
        kind, mark, name = what.partition(": ")
        modifiers, _, key = keys.rpartition("+")
        if mark and last.startswith(kind + mark) and last_keys.rpartition("+")[0] == modifiers:
            joined[-1] = (f"{last_keys}, {key}", f"{last}, {name}")
        else:
            joined.append((keys, what))
    return joined


def _digits(text: str) -> str:
    return "".join(c for c in text if c.isdigit())


@dataclass(frozen=True)
class SheetPlan:
    """The layout of the sheet: the columns, and the height of the tallest."""

    columns: list[list[tuple[str, list[Row]]]]
    high_px: float


def planned(parts: Sequence[tuple[str, list[Row]]], room: ImVec2, em: float) -> SheetPlan:
    """Divide the sheet into columns. em: the window's type, in which its font is now."""
    widths = [
        [(imgui.calc_text_size(keys).x / em, imgui.calc_text_size(what).x / em) for keys, what in r]
        for _, r in parts
    ]
    count = max(1, min(MOST_COLUMNS, int(room.x / (COLUMN_EM * em))))
    lines = [_lines(rows, room.x / em / count - 1.5) for rows in widths]
    columns = in_columns(parts, count, lines)
    of_part = {heading: count for (heading, _), count in zip(parts, lines, strict=True)}
    tallest = max(sum(of_part[heading] + 2 for heading, _ in column) for column in columns)
    return SheetPlan(columns, tallest * (1 + 2 * ROW_PAD) * em)


def narrowed(parts: Sequence[tuple[str, list[Row]]], query: str) -> list[tuple[str, list[Row]]]:
    """Return the rows that hold all words of a query, in heading, keys or words."""
    words = query.lower().split()
    found = []
    for heading, rows in parts:
        text = [f"{heading} {keys} {what}".lower() for keys, what in rows]
        kept = [row for row, own in zip(rows, text, strict=True) if all(w in own for w in words)]
        if kept:
            found.append((heading, kept))
    return found


def help_sheet(fonts: theme.Fonts, version: str, query: str) -> tuple[bool, str]:
    """Draw the sheet, narrowed to a query. Return True while it stays open, and the query."""
    viewport, style = imgui.get_main_viewport(), imgui.get_style()
    em = imgui.get_font_size()
    most = ImVec2(0.97 * viewport.work_size.x, 0.97 * viewport.work_size.y)
    around = 2 * imgui.get_frame_height() + 2 * style.window_padding.y + 3.0 * em
    room = ImVec2(most.x - 2 * style.window_padding.x - style.scrollbar_size, most.y - around)
    plan = planned(sections(), room, em)
    size = ImVec2(
        min(most.x, len(plan.columns) * 1.2 * COLUMN_EM * em), min(most.y, plan.high_px + around)
    )
    imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.always, (0.5, 0.5))
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
        pad = ImVec2(style.cell_padding.x, ROW_PAD * em)
        imgui.push_style_var(imgui.StyleVar_.cell_padding, pad)
        query = _filter(query)
        if not query and imgui.is_key_pressed(imgui.Key.escape, False):
            still_open = False  # the filter has the key otherwise
        kept = narrowed([part for column in plan.columns for part in column], query)
        wrapped(f"lucida {version}: one camera, two renderers", theme.DIM)
        stretched = imgui.TableFlags_.sizing_stretch_same
        if not kept:
            wrapped("No key or gesture has these words.", theme.DIM)
        elif imgui.begin_table("columns", len(plan.columns), stretched):
            imgui.table_next_row()
            for column in plan.columns:
                imgui.table_next_column()
                for heading, rows in narrowed(column, query):
                    _section(heading, rows, fonts)
            imgui.end_table()
        imgui.pop_style_var()
    imgui.end()
    return bool(still_open), query


def _filter(query: str) -> str:
    """Draw the filter's field, which has the keyboard from the beginning. Return what it holds."""
    if imgui.is_window_appearing():
        imgui.set_keyboard_focus_here()
    width = min(16 * imgui.get_font_size(), imgui.get_content_region_avail().x)
    imgui.set_next_item_width(width)
    flags = int(imgui.InputTextFlags_.escape_clears_all)
    return str(imgui.input_text_with_hint("##filter", "filter: a key or a word", query, flags)[1])


def in_columns(
    parts: Sequence[tuple[str, list[Row]]], columns: int, lines: Sequence[int]
) -> list[list[tuple[str, list[Row]]]]:
    """The parts in columns of about one height: each, the longest first, goes into the shortest
    column; there, and from column to column, they have their order. lines: that the rows of each
    take."""
    found: list[list[int]] = [[] for _ in range(columns)]
    heights = [0] * columns
    for number in sorted(range(len(parts)), key=lambda k: -lines[k]):
        shortest = heights.index(min(heights))
        found[shortest].append(number)
        heights[shortest] += lines[number] + 2
    return [[parts[k] for k in sorted(column)] for column in sorted(map(sorted, found)) if column]


def _lines(rows: Sequence[tuple[float, float]], width: float) -> int:
    """Return the number of lines that rows take in a column.

    The widths of keys and words are in multiples of the type size. Both wrap in their own part, or
    go below one another.
    """
    if width < NARROW_EM:
        return sum(max(1, math.ceil(k / width)) + max(1, math.ceil(w / width)) for k, w in rows)
    keys, words = KEYS * width, (1 - KEYS) * width
    return sum(max(1, math.ceil(1.1 * max(k / keys, w / words))) for k, w in rows)


def _section(heading: str, rows: list[Row], fonts: theme.Fonts) -> None:
    def bold(text: str, color: ImVec4 | None = None) -> None:
        imgui.push_font(fonts.bold, 0.0)
        wrapped(text, color)
        imgui.pop_font()

    narrow = imgui.get_content_region_avail().x < NARROW_EM * imgui.get_font_size()
    bold(heading, theme.legible(theme.RAY))
    if narrow:
        for keys, what in rows:
            bold(keys)
            imgui.indent()
            wrapped(what)
            imgui.unindent()
    elif imgui.begin_table(heading, 2, imgui.TableFlags_.sizing_stretch_prop):
        # The same in every part: words stand below one another.
        stretch = imgui.TableColumnFlags_.width_stretch
        imgui.table_setup_column("keys", stretch, KEYS)
        imgui.table_setup_column("what", stretch, 1 - KEYS)
        for keys, what in rows:
            imgui.table_next_row()
            imgui.table_next_column()
            bold(keys)
            imgui.table_next_column()
            wrapped(what)
        imgui.end_table()
    imgui.dummy((0, 0.3 * imgui.get_font_size()))
