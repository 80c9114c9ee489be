"""The conventions of courses and books as task files: `--tasks cornell-cs4620`.

Conventions only, from their public pages and code: what each file says was looked up there.
"""

from __future__ import annotations

from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.reading import suggestion

FOLDER = Path(__file__).parent


def course_names() -> list[str]:
    """The names that --tasks takes beside files."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def task_path(named: str) -> Path:
    """The file that a course's name, or a path, means. A file of the user's goes first.

    Raises LucidaError for what is neither."""
    path = Path(named)
    if path.suffix or path.exists() or path.name != named:
        return path
    names = course_names()
    if named in names:
        return FOLDER / f"{named}.toml"
    raise LucidaError(
        "--tasks", f"{named!r} is neither a file nor a course", suggestion(named, names)
    )
