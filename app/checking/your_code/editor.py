"""The user's text editor."""

from __future__ import annotations

import contextlib
import shutil
import subprocess
import sys

# Never a program that would run the file: Windows runs Python files that are opened.
COMMANDS = {"darwin": ["open", "-t"], "win32": ["notepad.exe"]}


def open_in_editor(path: str) -> bool:
    """Open a text file in the user's editor. Return True if there was one."""
    command, quiet = COMMANDS.get(sys.platform, ["xdg-open"]), subprocess.DEVNULL
    if shutil.which(command[0]) is None:
        return False
    with contextlib.suppress(OSError):
        subprocess.Popen(
            [*command, path], stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True
        )
        return True
    return False
