"""Files that are replaced whole: a reader sees the old file or the new one, never a part of one.

Knows nothing of what is written.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from renderer.errors import LucidaError


def check_writable(path: str | Path) -> Path:
    """The file that writing to `path` would replace, links followed.

    Raises LucidaError where that cannot work: no such folder, no right to write into it, or
    something at `path` that is not an ordinary file.
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


@contextlib.contextmanager
def atomic_write(path: str | Path) -> Iterator[BinaryIO]:
    """A binary file to write to; it becomes `path` when the block ends without an exception.

    Otherwise nothing is left behind, and an old file at `path` stays as it was. The new file has
    the old one's access rights. Raises LucidaError where `path` cannot be written.
    """
    target = check_writable(path)
    scratch = target.with_name(f".{target.name[:100]}.{secrets.token_hex(6)}.part")
    # Not the tempfile module: its files are private, a picture takes the user's umask.
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    try:
        with open(os.open(scratch, flags, 0o666), "w+b") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        with contextlib.suppress(FileNotFoundError):
            scratch.chmod(stat.S_IMODE(target.stat().st_mode))
        os.replace(scratch, target)
    except OSError as error:
        raise LucidaError("", f"cannot be written: {_reason(error)}", source=str(path)) from error
    finally:
        with contextlib.suppress(OSError):
            scratch.unlink()


def _reason(error: BaseException) -> str:
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]
