"""What is asked of students' code, and which processes it left."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from app.checking.calls import Call

CAMERA = {
    "eye": [0.0, 0.0, 5.0],
    "u": [1.0, 0.0, 0.0],
    "v": [0.0, 1.0, 0.0],
    "w": [0.0, 0.0, 1.0],
    "distance": 1.0,
    "left": -1.0,
    "right": 1.0,
    "bottom": -0.75,
    "top": 0.75,
    "projection": "perspective",
}


def called(function: str, vectorised: bool = False, /, **arguments) -> Call:
    return Call(function, tuple(arguments.items()), vectorised)


def command_lines(part: str) -> list[str]:
    """The processes that were called with that. Linux."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            found.append((process / "cmdline").read_text("utf-8", "replace").replace("\0", " "))
    return [line for line in found if part in line]


def bearers(name: str) -> list[str]:
    """The processes with that in their environment, as they are called. Linux."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if name.encode() in (process / "environ").read_bytes():
                found.append((process / "cmdline").read_text().replace("\0", " "))
        except OSError:
            continue
    return found
