"""The conventions of courses and books as task files: `--tasks cornell-cs4620`.

These are conventions only, taken from the public pages and code that each file names.
"""

from __future__ import annotations

from pathlib import Path

from lucida.renderer.files.reading import suggestion
from lucida.renderer.system.errors import LucidaError

FOLDER = Path(__file__).parent


def course_names() -> list[str]:
    """Return the names that --tasks accepts besides files."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def task_path(named: str) -> Path:
    """Return the file of a course's name or of a path. The user's own file takes precedence.

    Raises LucidaError if it is neither.
    """
    path = Path(named)
    if path.suffix or path.exists() or path.name != named:
        return path
    names = course_names()
    if named in names:
        return FOLDER / f"{named}.toml"
    raise LucidaError(
        "--tasks", f"{named!r} is neither a file nor a course", suggestion(named, names)
    )
