"""The sheet of mouse and keys, which lists every shortcut by menu.

It is made from the table of app/window/action_table.py and from the instruments' rows for mouse and
keys.
"""

from __future__ import annotations

import re

from .action_table import ACTIONS, MOUSE
from .documents import KEYS
from .instruments import INSTRUMENTS

Row = tuple[str, str]  # keys, what they do
Part = tuple[str, list[Row]]  # a heading, and its rows
ESCAPE: Row = ("Esc", "cancel the drag of a handle; close the topmost box; leave presentation")
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
    """Return the rows. Merge those that differ only in a digit (bookmarks 1 to 9)."""
    alike: dict[str, list[Row]] = {}
    for row in rows:
        alike.setdefault(re.sub(r"\d", "#", "|".join(row)), []).append(row)
    return [
        few[0] if len(few) == 1 else (f"{few[0][0]} to {few[-1][0]}", f"{few[0][1]} to {len(few)}")
        for few in alike.values()
    ]


def keys_document() -> str:
    """Return the sheet as a document in Markdown."""
    lines = [f"# {KEYS}"]
    for heading, rows in sections():
        lines += ["", f"## {heading}", "", "| | |", "|---|---|"]
        lines += [f"| **{_plain(keys)}** | {_plain(does)} |" for keys, does in rows]
    return "\n".join(lines)


def _plain(text: str) -> str:
    """Escape the characters that have a meaning in Markdown."""
    return re.sub(r"([\\`*_\[\]|<])", r"\\\1", text)
