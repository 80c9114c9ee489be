"""Folders that only this user can write to, for files that are trusted as code."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from .errors import LucidaError

_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


def private_folder(folder: Path) -> Path:
    """Return the folder after following links. Create it, and missing parents, for this user only.

    Raises LucidaError if another user could write to it, now or by replacing a folder above it;
    OSError if it cannot be created.
    """
    folder = folder.resolve()
    _check(folder)
    for path in (*reversed(folder.parents), folder):
        if not path.exists():
            path.mkdir(0o700, exist_ok=True)
    _check(folder)  # another user may have created it meanwhile
    return folder


def _check(folder: Path) -> None:
    """Raise LucidaError if another user can write to the folder, or replace one above it.

    Nothing is checked on Windows, where a user's folders are private. Folders above may belong to
    the administrator, whom no permissions keep out. They may also be writable for everybody if they
    are sticky, like /tmp, because only an entry's owner can then rename or delete it.
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
            raise LucidaError("", problem, "give another folder", str(folder))
        if status.st_mode & _OTHERS_WRITE and not (is_above and status.st_mode & stat.S_ISVTX):
            problem = f"others can write into {path}"
            raise LucidaError("", problem, f"chmod go-w '{path}'", str(folder))
