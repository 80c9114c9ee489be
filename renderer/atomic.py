"""Files that are replaced whole: a reader sees the old file or the new one, never a part of one.

Knows nothing of what is written.
"""

from __future__ import annotations

import contextlib
import os
import stat
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import BinaryIO

from renderer.errors import LucidaError

if sys.platform != "win32":
    import fcntl

_PREFIX, _SUFFIX = ".lucida-", ".part"
_LOCKS = sys.platform != "win32"


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

    If the process is killed meanwhile, the new file goes with it where the system has files without
    a name; elsewhere it stays beside `path` until a process writes into the folder again.
    """
    target = check_writable(path)
    _remove_parts(target.parent)
    part = _new_name(target.parent)
    try:
        is_named = not _has_unnamed(target.parent)
        # Not the tempfile module: its files are private, a picture takes the user's umask.
        if is_named:
            part, descriptor = _open_named(target.parent)
        else:
            descriptor = _open_unnamed(target.parent)
        with open(descriptor, "w+b") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
            if not is_named:
                _give_name(file.fileno(), part)
            if _LOCKS:  # while it is known to be in use
                _move(part, target)
        if not _LOCKS:  # Windows moves no open files
            _move(part, target)
    except OSError as error:
        raise LucidaError("", f"cannot be written: {_reason(error)}", source=str(path)) from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink()


def _new_name(folder: Path) -> Path:
    """For an unfinished file. Not made of the target's, which may be as long as names can be."""
    return folder / f"{_PREFIX}{os.urandom(8).hex()}{_SUFFIX}"


def _move(part: Path, target: Path) -> None:
    with contextlib.suppress(FileNotFoundError):
        part.chmod(stat.S_IMODE(target.stat().st_mode))
    os.replace(part, target)


# Unfinished files with a name. Whoever writes one holds a lock on it, which ends with the process.


def _open_named(folder: Path) -> tuple[Path, int]:
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    while True:
        part = _new_name(folder)
        descriptor = os.open(part, flags, 0o666)
        if _hold(descriptor):
            return part, descriptor
        os.close(descriptor)  # whoever took it removes it


def _hold(descriptor: int) -> bool:
    """Tells that a file is in use; False where it was just taken for one that was left behind."""
    try:
        _lock(descriptor)
    except BlockingIOError:
        return False
    except OSError:  # the file system has no locks
        return True
    return not _LOCKS or os.fstat(descriptor).st_nlink > 0


def _lock(descriptor: int) -> None:
    if sys.platform != "win32":
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


@cache
def _remove_parts(folder: Path) -> None:
    """Removes what killed processes have left in a folder; once, for it may hold many files."""
    with contextlib.suppress(OSError):
        for part in folder.glob(f"{_PREFIX}*{_SUFFIX}"):
            with contextlib.suppress(OSError):
                if not _LOCKS:
                    part.unlink()  # Windows removes no open files
                    continue
                descriptor = os.open(part, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
                try:
                    _lock(descriptor)
                    part.unlink()
                finally:
                    os.close(descriptor)


# Unfinished files without one, which Linux has in most file systems.


def _open_unnamed(folder: Path) -> int:
    descriptor = os.open(folder, os.O_RDWR | os.O_TMPFILE, 0o666)
    _hold(descriptor)  # for the moment in which it has a name, but not the final one
    return descriptor


def _give_name(descriptor: int, part: Path) -> None:
    # Given src_dir_fd, Python calls linkat(), which follows the link; link() does not.
    os.link(f"/proc/self/fd/{descriptor}", part, src_dir_fd=descriptor, follow_symlinks=True)


@cache
def _has_unnamed(folder: Path) -> bool:
    """Whether a folder takes files without a name, and gives them one afterwards."""
    if not hasattr(os, "O_TMPFILE"):
        return False
    part = _new_name(folder)
    try:
        descriptor = _open_unnamed(folder)
        try:
            _give_name(descriptor, part)
        finally:
            os.close(descriptor)
        part.unlink()
    except OSError:
        return False
    return True


def _reason(error: BaseException) -> str:
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]
