"""Folders that nobody but this user can have written into: for files that are trusted as code.

Knows nothing of what is kept in them.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from renderer.errors import LucidaError

_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


def private_folder(folder: Path) -> Path:
    """The folder, links followed; it is made, and what is missing above it, for this user only.

    Raises LucidaError where somebody else could write into it, now or by exchanging a folder above
    it; OSError where it cannot be made.
    """
    folder = folder.resolve()
    _check(folder)
    for path in (*reversed(folder.parents), folder):
        if not path.exists():
            path.mkdir(0o700, exist_ok=True)
    _check(folder)  # somebody may have been quicker
    return folder


def _check(folder: Path) -> None:
    """Windows has neither owners nor rights in these terms: a user's folders are theirs there.

    Above the folder, what belongs to the administrator will do: no rights keep them out. So will
    what everybody may write into if it is sticky, as /tmp: only its owner can rename or remove
    what is in there.
    """
    if not hasattr(os, "geteuid"):
        return
    user = os.geteuid()
    for path in (folder, *folder.parents):
        try:
            status = path.stat()
        except FileNotFoundError:
            continue
        is_above = path != folder
        if status.st_uid != user and not (is_above and status.st_uid == 0):
            problem = f"{path} belongs to somebody else"
            raise LucidaError("", problem, "choose another folder", str(folder))
        if status.st_mode & _OTHERS_WRITE and not (is_above and status.st_mode & stat.S_ISVTX):
            problem = f"others can write into {path}"
            raise LucidaError("", problem, f"chmod go-w '{path}'", str(folder))
