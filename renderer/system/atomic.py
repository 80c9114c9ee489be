"""Atomic file writes: a reader sees the old file or the new one, never part of one."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import stat
import time
import unicodedata
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import BinaryIO

from .errors import LucidaError

_PART = ".lucida-*.part"
_DAY_S = 86_400


def check_writable(path: str | Path) -> Path:
    """Return the file that writing to `path` would replace, after following links.

    Raises LucidaError if it cannot be written: its folder does not exist or is not writable, or
    `path` is not an ordinary file.
    """
    source = str(path)
    try:
        target = Path(os.path.realpath(path))
        mode = target.stat().st_mode if target.exists() else None
    except (OSError, ValueError) as error:
        raise LucidaError("", f"cannot be written: {_reason(error)}", source=source) from None
    if mode is not None and not stat.S_ISREG(mode):
        what = "a folder" if stat.S_ISDIR(mode) else "not an ordinary file"
        raise LucidaError("", f"is {what}", "give the name of a file", source)
    folder = target.parent
    if not folder.is_dir():
        raise LucidaError("", f"folder {folder} does not exist", "make it first", source)
    if not os.access(folder, os.W_OK | os.X_OK):
        raise LucidaError("", f"folder {folder} is not writable", "write elsewhere", source)
    if mode is not None and not os.access(target, os.W_OK):
        raise LucidaError("", "is write-protected", "write elsewhere or change its rights", source)
    return target


def file_stem(name: str) -> str:
    """Return a scene's name as a file name without ending. Letters with their combining marks,
    digits, spaces and _ stay; "-" replaces any other character.
    """
    return "".join(
        c if c.isalnum() or c in " _" or unicodedata.category(c)[0] == "M" else "-" for c in name
    )


@contextlib.contextmanager
def atomic_write(path: str | Path) -> Iterator[BinaryIO]:
    """Open a temporary file that replaces `path` when the block ends normally.

    On any error `path` stays unchanged. Links are followed, and an existing file keeps its mode.
    Raises LucidaError if `path` cannot be written.
    """
    target = check_writable(path)
    _remove_old_parts(target.parent)
    part = target.with_name(_PART.replace("*", secrets.token_hex(8)))
    try:
        with open(part, "xb+") as file:  # not tempfile, which ignores the user's umask
            yield file
            file.flush()
            os.fsync(file.fileno())
        if target.exists():
            shutil.copymode(target, part)
        os.replace(part, target)
    except OSError as error:
        raise LucidaError("", f"cannot be written: {_reason(error)}", source=str(path)) from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink()


@cache  # once per process: the folder may hold many files
def _remove_old_parts(folder: Path) -> None:
    """Delete files that killed processes left in a folder more than a day ago."""
    for part in folder.glob(_PART):
        with contextlib.suppress(OSError):
            if time.time() - part.lstat().st_mtime > _DAY_S:
                part.unlink()


def _reason(error: BaseException) -> str:
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]
