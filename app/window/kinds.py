"""The kinds of files that a user opens, drops or names on the command line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal

from lucida.app.images.photograph.reading import is_photograph
from lucida.app.instruments.poses.reading import is_cameras
from lucida.app.lecture.reading import is_lecture
from lucida.renderer.files import SCENE_NAMES
from lucida.renderer.files.reading import check_file, first_bytes

CODE_ENDING, TOML_ENDING = ".py", ".toml"
SNIFFED_BYTES = 1 << 20

Kind = Literal["tasks", "photograph", "view", "lecture", "cameras", "code", "scene"]


def kind_of(source: str) -> Kind:
    """Return a source's kind, by its name and its contents. Built-in scenes, scene files, models
    and all unrecognized sources are scenes.
    """
    if source in SCENE_NAMES:
        return "scene"
    return next((kind for kind, is_it in _KINDS if is_it(source)), "scene")


def found_code(source: str) -> str:
    """Return the absolute path of a program. Raise LucidaError if it is not an ordinary file."""
    check_file(Path(source))
    return str(Path(source).absolute())


def _is_tasks(source: str) -> bool:
    """Return True for a course's tasks, which have a table [[tasks]]."""
    lines = _toml(source).splitlines()
    return any(line.replace(b" ", b"").startswith(b"[[tasks]]") for line in lines)


def _is_view(source: str) -> bool:
    """Return True for a view file, which has a camera and no objects."""
    text = _toml(source)
    return b"[camera]" in text and b"objects" not in text


def _is_code(source: str) -> bool:
    return source.lower().endswith(CODE_ENDING)


def _toml(source: str) -> bytes:
    """Return the beginning of a TOML file; empty bytes for other files."""
    if not source.lower().endswith(TOML_ENDING):
        return b""
    try:
        return first_bytes(Path(source), SNIFFED_BYTES)
    except (OSError, ValueError):
        return b""


_KINDS: tuple[tuple[Kind, Callable[[str], bool]], ...] = (
    ("tasks", _is_tasks),
    ("photograph", is_photograph),
    ("lecture", is_lecture),
    ("view", _is_view),  # not before lectures, whose steps have cameras
    ("cameras", is_cameras),
    ("code", _is_code),
)
