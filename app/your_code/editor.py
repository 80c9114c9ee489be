"""The user's own editor, by what each platform has for that."""

from __future__ import annotations

import shutil
import subprocess
import sys


def editor_command(path: str) -> list[str] | None:
    """What opens a text file in the editor that the user has chosen; None where there is none. Not
    what would run it: Windows runs Python files that are opened."""
    if sys.platform == "darwin":
        return ["open", "-t", path]
    if sys.platform == "win32":
        return ["notepad.exe", path]
    return ["xdg-open", path] if shutil.which("xdg-open") else None


def open_in_editor(path: str) -> bool:
    """Gives whether there was one to begin."""
    command = editor_command(path)
    if command is None:
        return False
    quiet = subprocess.DEVNULL
    try:
        subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True)
    except OSError:
        return False
    return True
