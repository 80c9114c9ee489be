"""Reading a user's file, whole, within bounds, or saying in one line why not.

Knows nothing of what is in the file.
"""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterable
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.noting import note


def path_of(source: str | Path, field: str) -> Path:
    """The path that a Python user gave; raises LucidaError for what is none, such as None."""
    try:
        return Path(source)
    except TypeError:
        problem = f"is a {type(source).__name__}, not a path"
        raise LucidaError(field, problem, "give text, or a pathlib.Path") from None


def full_path(path: str | Path) -> Path:
    """A file's path from the root, without `..`: what is below its folder is told by its parts.
    Links stay as they are, but for those that a `..` leads through."""
    full = Path(path).absolute()
    return Path(os.path.realpath(full.parent)) / full.name if ".." in full.parts else full


def first_bytes(path: Path, most: int) -> bytes:
    """Return the first bytes of an ordinary file; none of any other, such as a pipe. Raise OSError
    or ValueError if it cannot be read."""
    if not stat.S_ISREG(path.stat().st_mode):
        return b""
    with path.open("rb") as file:
        return file.read(most)


def read_file(path: Path, most_bytes: int) -> bytes:
    """Return the bytes of an ordinary file of at most `most_bytes`. Raise LucidaError naming it."""
    source = str(path)
    note(path)
    try:
        status = path.stat()
        if stat.S_ISDIR(status.st_mode):
            raise LucidaError("", "is a folder", "give the name of a file", source)
        # A pipe or a device may have no end.
        if not stat.S_ISREG(status.st_mode):
            raise LucidaError("", "is not an ordinary file", "copy it into one", source)
        check_bytes(status.st_size, most_bytes, source)
        with path.open("rb") as file:
            data = file.read(status.st_size)  # not read(): a file may grow without end
    except FileNotFoundError:
        problem, remedy = absence(path)
        raise LucidaError("", problem, remedy, source) from None
    except LucidaError:
        raise
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        reason = reason[:1].lower() + reason[1:]
        raise LucidaError(
            "", f"cannot be read: {reason}", "check its name and rights", source
        ) from None
    if not data:
        raise LucidaError("", "is empty", "give a file with something in it", source)
    return data


def check_bytes(size_bytes: int, most_bytes: int, source: str) -> None:
    """Raises LucidaError where a file is larger than its kind may be."""
    if size_bytes > most_bytes:
        raise LucidaError(
            "",
            f"is too large, {size_text(size_bytes)}",
            f"stay within {size_text(most_bytes)} for a file of this kind",
            source,
        )


def decode_text(data: bytes, source: str) -> str:
    """UTF-8 text, with or without a byte order mark; otherwise LucidaError."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise LucidaError(
            f"line {line}", "is not text in UTF-8", "save the file as UTF-8 text", source
        ) from None


def suggestion(given: str, known: Iterable[str]) -> str:
    """`did you mean 'x'?` where a known name is close to the given one, else a list of all."""
    known = list(known)
    close = close_matches(given[:100], known)
    return f"did you mean {close[0]!r}?" if close else f"give one of {', '.join(known)}"


def close_matches(given: str, known: Iterable[str], least: float = 0.6) -> list[str]:
    """The known name that is most alike, if one is so to this degree, of 1."""
    import difflib  # here: nobody needs it who makes no mistake

    return difflib.get_close_matches(given, list(known), 1, least)


def absence(path: Path) -> tuple[str, str]:
    """The problem and the remedy of a file that is not there: a link that leads nowhere, or
    one of a similar name beside it, if any."""
    with contextlib.suppress(OSError, ValueError):
        target = str(path.readlink())  # fails for what is no link
        return f"is a link to {target!r}, which does not exist", "mend the link"
    return "does not exist", _neighbours(path)


def _neighbours(path: Path) -> str:
    try:
        with os.scandir(path.parent) as entries:
            names = [entry.name for entry, _ in zip(entries, range(10_000), strict=False)]
    except (OSError, ValueError):
        return "check its name and folder"
    close = close_matches(path.name[:255], names, 0.75)
    return f"did you mean {str(path.with_name(close[0]))!r}?" if close else "check its name"


def size_texts(one_bytes: int, other_bytes: int) -> tuple[str, str]:
    """Two sizes that differ, as people say them; to the byte where they would look alike."""
    one, other = size_text(one_bytes), size_text(other_bytes)
    return (one, other) if one != other else (f"{one_bytes:,} bytes", f"{other_bytes:,} bytes")


def size_text(size_bytes: int) -> str:
    """A size as people say it: 512 bytes, 4 MiB, 2.5 GiB."""
    if size_bytes < 1024:
        return f"{size_bytes} bytes"
    size = float(size_bytes)
    for unit in ("KiB", "MiB"):
        size /= 1024
        if size < 1024:
            return f"{size:.3g} {unit}"
    return f"{size / 1024:.3g} GiB"
