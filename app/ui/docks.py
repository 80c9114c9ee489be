"""Check ImGui's text of docks before ImGui reads it: one that is no tree ends the program."""

from __future__ import annotations

import re

DATA = "[Docking][Data]\n"
_NODE = re.compile(r" *Dock(Space|Node) +ID=(0x[0-9A-Fa-f]+)((?: \w+=[-\w,]+)*) *")


def are_sound(windows: str, own: str) -> bool:
    """Return whether the docks in ImGui's text are binary trees, and the window's own is one.

    own: ImGui's text of the window as it is.
    """
    roots = _roots(windows)
    return roots is not None and (_roots(own) or set()) <= roots


def _roots(windows: str) -> set[str] | None:
    """Return the dock spaces of a text; None if its docks are not whole."""
    free: dict[str, int] = {}  # places for children in each dock
    roots, centres = set(), 0
    for line in windows.partition(DATA)[2].partition("\n\n")[0].splitlines():
        node = _NODE.fullmatch(line)
        if node is None or node[2] in free or not int(node[2], 16):
            return None
        fields = dict(field.split("=", 1) for field in node[3].split())
        parent, is_split = fields.get("Parent"), "Split" in fields
        centres += "CentralNode" in fields
        if centres > 1 or (is_split and "CentralNode" in fields):
            return None
        if node[1] == "Space":
            roots.add(node[2])
        if parent is not None:
            free[parent] = free.get(parent, 0) - 1
            if free[parent] < 0:
                return None
        free[node[2]] = 2 if is_split else 0
    return None if any(free.values()) else roots
