"""Which files are a student's programs, and whether one is there."""

from __future__ import annotations

from pathlib import Path

from renderer.errors import LucidaError

CODE_ENDING = ".py"


def is_code(source: str) -> bool:
    """Whether a name is that of a program, never of a scene."""
    return source.lower().endswith(CODE_ENDING)


def found_code(source: str) -> str:
    """The absolute path of a program. Raises LucidaError where it is not there."""
    path = Path(source).absolute()
    try:
        found, is_folder = path.is_file(), path.is_dir()
    except (OSError, ValueError):
        found = is_folder = False
    if is_folder:
        raise LucidaError("", "is a folder", "give a Python file", source)
    if not found:
        raise LucidaError("", "does not exist", "check its name", source)
    return str(path)
