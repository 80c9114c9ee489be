"""The file of the window's layout.

settings_file() finds its place and checks that it is usable. A settings file never keeps the window
from opening: one that cannot be read or written is not used.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

SMALLEST_PX, LARGEST_PX = 64, 16384  # plausible sides of a window
LARGEST_BYTES = 1 << 20


def settings_file(fresh: bool = False) -> Path | None:
    """Return the file for the layout, in the user's settings folder, which is created if necessary.

    Return None if the layout cannot be kept, or if the path is not a file. A file that no window
    can have written is moved aside; with `fresh`, any file is.
    """
    import platformdirs

    try:
        path = platformdirs.user_config_path("lucida", appauthor=False) / "window.ini"
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            return path if os.access(path.parent, os.W_OK) else None
        if not (path.is_file() and os.access(path, os.R_OK | os.W_OK)):
            return None
        if not _is_sane(path):
            path.replace(path.with_suffix(".broken"))
        elif fresh:
            path.replace(path.with_suffix(".before"))
        return path
    except (OSError, RuntimeError):  # RuntimeError: no home folder
        return None


def _is_sane(path: Path) -> bool:
    """Return True if the file is text of a plausible size with a window of a plausible size."""
    if path.stat().st_size > LARGEST_BYTES:
        return False
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return False
    entry = re.search(r"^WindowSize=(.*)$", text, re.MULTILINE)
    sides = re.fullmatch(r"(\d{1,6}),(\d{1,6})", entry[1].strip()) if entry else None
    return sides is not None and all(SMALLEST_PX <= int(n) <= LARGEST_PX for n in sides.groups())
