"""Which files are a student's programs, and whether one is there; which are a course's tasks."""

from __future__ import annotations

from pathlib import Path

from lucida.renderer.files.reading import check_file, first_bytes

CODE_ENDING, TASKS_ENDING = ".py", ".toml"
SNIFFED_BYTES = 1 << 16


def is_code(source: str) -> bool:
    """Return True for the name of a program, never of a scene."""
    return source.lower().endswith(CODE_ENDING)


def found_code(source: str) -> str:
    """Return the absolute path of a program. Raise LucidaError if it is not an ordinary file."""
    check_file(Path(source))
    return str(Path(source).absolute())


def is_tasks(source: str) -> bool:
    """Return True for a file of tasks, by its contents: a table [[tasks]]."""
    if not source.lower().endswith(TASKS_ENDING):
        return False
    try:
        lines = first_bytes(Path(source), SNIFFED_BYTES).splitlines()
    except (OSError, ValueError):
        return False
    return any(line.replace(b" ", b"").startswith(b"[[tasks]]") for line in lines)
