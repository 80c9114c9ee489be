"""Saving the files of a format: all of them or none."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path

from lucida.renderer.system.atomic import atomic_write, check_writable
from lucida.renderer.system.errors import LucidaError


def save_files(path: Path, files: Mapping[str, bytes]) -> None:
    """Write one file (named "") or a folder of files.

    Raises LucidaError, and leaves the folder unchanged, if one of them cannot be written.
    """
    if "" in files:
        with atomic_write(path) as file:
            file.write(files[""])
        return
    is_new = not os.path.lexists(path)
    _check_folder(path, is_new, files)
    try:
        if is_new:
            path.mkdir()
        with contextlib.ExitStack() as stack:  # the files are renamed when all are written
            for name, data in files.items():
                file = stack.enter_context(atomic_write(path / name))
                file.write(data)
                file.flush()  # a full disk shows before any file is replaced
    except BaseException:
        if is_new:
            with contextlib.suppress(OSError):
                for name in files:
                    (path / name).unlink(missing_ok=True)
                path.rmdir()
        raise


def _check_folder(path: Path, is_new: bool, files: Mapping[str, bytes]) -> None:
    """Raise LucidaError if the folder cannot be made, or holds other files."""
    try:
        if not is_new and not path.is_dir():
            raise LucidaError("", "is a file", "give the name of a folder")
        check_writable(path if is_new else path / next(iter(files)))
        names = [] if is_new else sorted(os.listdir(path))
        if others := [name for name in names if name not in files and not name.startswith(".")]:
            problem = f"holds other files, such as {others[0]!r}"
            raise LucidaError("", problem, "give a folder of its own")
    except LucidaError as error:
        raise error.in_file(str(path)) from None
