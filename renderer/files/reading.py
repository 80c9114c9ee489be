"""Read a user's file completely and within size limits, or report the reason in one line."""

from __future__ import annotations

import contextlib
import difflib
import os
import stat
from collections.abc import Iterable, Iterator
from pathlib import Path

from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.file_dependencies import note

MODEL_ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")


@contextlib.contextmanager
def naming(source: str | Path) -> Iterator[None]:
    """Name the file in errors of the block that name none."""
    try:
        yield
    except LucidaError as error:
        raise error if error.source else error.in_file(str(source)) from None


def path_of(source: str | Path, field: str) -> Path:
    """Return the path that a Python user passed. Raises LucidaError for None and other types."""
    try:
        return Path(source)
    except TypeError:
        problem = f"is of type {type(source).__name__}, not a path"
        raise LucidaError(field, problem, "give text, or a pathlib.Path") from None


def full_path(path: str | Path) -> Path:
    """Return a file's absolute path without `..`, so that its parts show its folders.

    Links stay, except for those that a `..` leads through.
    """
    full = Path(path).absolute()
    return Path(os.path.realpath(full.parent)) / full.name if ".." in full.parts else full


def first_bytes(path: Path, most: int) -> bytes:
    """Return the first bytes of an ordinary file, b"" for any other, such as a pipe. Raise OSError
    or ValueError if it cannot be read."""
    if not stat.S_ISREG(path.stat().st_mode):
        return b""
    with path.open("rb") as file:
        return file.read(most)


def read_file(path: Path, most_bytes: int) -> bytes:
    """Return the bytes of an ordinary file of at most `most_bytes`. Raise LucidaError naming it."""
    note(path)
    size = check_file(path)
    check_bytes(size, most_bytes, str(path))
    try:
        with open(path, "rb", opener=_open_at_once) as file:
            data = file.read(size) or b""  # not read(): a file may grow without end
    except OSError as error:
        raise _unreadable(path, error) from None
    if not data:
        raise LucidaError("", "is empty", "give a file with something in it", str(path))
    return data


def _open_at_once(path: str, flags: int) -> int:
    """Open a file without blocking: a pipe may have taken its place since it was checked."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def check_file(path: Path) -> int:
    """Return the size of an ordinary file, in bytes. Raise LucidaError naming any other file: a
    pipe or a device may have no end."""
    source = str(path)
    try:
        status = path.stat()
    except FileNotFoundError:
        raise LucidaError("", absence(path), "check its name and folder", source) from None
    except (OSError, ValueError) as error:
        raise _unreadable(path, error) from None
    if stat.S_ISDIR(status.st_mode):
        raise LucidaError("", "is a folder", "give the name of a file", source)
    if not stat.S_ISREG(status.st_mode):
        raise LucidaError("", "is not an ordinary file", "copy it into one", source)
    return status.st_size


def _unreadable(path: Path, error: OSError | ValueError) -> LucidaError:
    reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    problem = f"cannot be read: {reason[:1].lower()}{reason[1:]}"
    return LucidaError("", problem, "check its name and rights", str(path))


def damaged(problem: str) -> LucidaError:
    """Return the error for a file that is not what its ending or its header says."""
    return LucidaError("", problem, "it is cut off or of another kind; export it again")


def check_bytes(size_bytes: int, most_bytes: int, source: str) -> None:
    """Raise LucidaError if a file is too large for its kind."""
    if size_bytes > most_bytes:
        raise LucidaError(
            "",
            f"is too large, {size_text(size_bytes)}",
            f"stay within {size_text(most_bytes)} for a file of this kind",
            source,
        )


def check_count(
    count: int, most: int, what: str, field: str = "", remedy: str = "stay within {}"
) -> None:
    """Raise LucidaError for too many of something."""
    if count > most:
        verb = "holds" if field else "has"
        raise LucidaError(field, f"{verb} {count} {what}", remedy.format(most))


def decode_text(data: bytes, source: str) -> str:
    """Return text from UTF-8, with or without a byte order mark. Raises LucidaError."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise LucidaError(
            f"line {line}", "is not text in UTF-8", "save the file as UTF-8 text", source
        ) from None


def suggestion(given: str, known: Iterable[str]) -> str:
    """Return `did you mean 'x'?` if a known name is close, or else a list of all."""
    known = list(known)
    close = close_matches(given[:100], known)
    return f"did you mean {close[0]!r}?" if close else f"give one of {', '.join(known)}"


def close_matches(given: str, known: Iterable[str]) -> list[str]:
    """Return a list of the most similar known name, ignoring case; it is empty if none is close."""
    names = {name.lower(): name for name in reversed(list(known))}
    return [names[name] for name in difflib.get_close_matches(given.lower(), names, 1)]


def absence(path: Path) -> str:
    """Return the problem of a missing file, with the folder of a relative path."""
    problem = "does not exist"
    with contextlib.suppress(OSError, ValueError):
        if not path.is_absolute():
            problem += f" in {os.path.abspath(path.parent)}"
    return problem


def size_text(size_bytes: int) -> str:
    """Return a size as text: 512 bytes, 4 MiB, 2.5 GiB."""
    if size_bytes < 1024:
        return f"{size_bytes} bytes"
    size = float(size_bytes)
    for unit in ("KiB", "MiB"):
        size /= 1024
        if size < 1024:
            return f"{size:.3g} {unit}"
    return f"{size / 1024:.3g} GiB"
