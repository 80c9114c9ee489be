"""The user's own text editor, opened as each platform provides."""

from __future__ import annotations

import shutil
import subprocess
import sys


def editor_command(path: str) -> list[str] | None:
    """Return the command that opens a text file in the user's editor; None if there is none.

    Never a program that would run it: Windows runs Python files that are opened.
    """
    if sys.platform == "darwin":
        return ["open", "-t", path]
    if sys.platform == "win32":
        return ["notepad.exe", path]
    return ["xdg-open", path] if shutil.which("xdg-open") else None


def open_in_editor(path: str) -> bool:
    """Open a file in the user's editor. Return True if there was one."""
    command = editor_command(path)
    if command is None:
        return False
    quiet = subprocess.DEVNULL
    try:
        subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True)
    except OSError:
        return False
    return True
