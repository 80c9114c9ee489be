"""Which files are a student's programs, and whether one is there; which are a course's tasks."""

from __future__ import annotations

from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.reading import first_bytes

CODE_ENDING, TASKS_ENDING = ".py", ".toml"
SNIFFED_BYTES = 1 << 16


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


def is_tasks(source: str) -> bool:
    """Whether a name is that of a file of tasks, by what is in it: a table [[tasks]]."""
    if not source.lower().endswith(TASKS_ENDING):
        return False
    try:
        lines = first_bytes(Path(source), SNIFFED_BYTES).splitlines()
    except (OSError, ValueError):
        return False
    return any(line.replace(b" ", b"").startswith(b"[[tasks]]") for line in lines)
