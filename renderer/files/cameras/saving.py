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

    Raises LucidaError, and leaves everything as it was, if one of them cannot be written.
    """
    if "" in files:
        with atomic_write(path) as file:
            file.write(files[""])
        return
    is_new = not path.is_dir()
    if is_new:
        check_writable(path)
        try:
            path.mkdir()
        except OSError:
            raise LucidaError("", "is a file", "give the name of a folder", str(path)) from None
    others = [n for n in sorted(os.listdir(path)) if n not in files and not n.startswith(".")]
    if others:
        problem = f"holds other files, such as {others[0]!r}"
        raise LucidaError("", problem, "give a folder of its own", str(path))
    try:
        with contextlib.ExitStack() as stack:  # the files are renamed when all are written
            for name, data in files.items():
                file = stack.enter_context(atomic_write(path / name))
                file.write(data)
                file.flush()  # a full disk shows before any file is replaced
    except BaseException:
        if is_new:
            with contextlib.suppress(OSError):
                path.rmdir()
        raise
