"""The state of a step, and its `options`: changes of the window's options, by name.

No option is named here, so a lecture can set any new one at once, within the bounds of its field.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, get_args, get_type_hints

import msgspec

from lucida.app.state.app_state import AppState, is_orthonormal
from lucida.app.state.bounds import check, files_of
from lucida.app.state.options import Options
from lucida.app.state.paths import stored
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.reading import suggestion
from lucida.renderer.files.tables import to_struct
from lucida.renderer.files.views import view_from_table
from lucida.renderer.system.errors import LucidaError, under

from .hiding import HideExercise
from .model import Step

_types = lru_cache(get_type_hints)  # get_type_hints() is slow

OWN = ("preferences", "bookmarks")  # the user's own options, which no step changes
CHOSEN = ("language",)  # options that stay until a step changes them
ELSEWHERE = (*OWN, "marked", "marked_size")  # options with their own fields in a step

NAMES = tuple(entry.name for entry in fields(Options) if entry.name not in ELSEWHERE)


def own(options: Options) -> Options:
    """Return the default options, except for the user's own."""
    return replace(Options(), **{name: getattr(options, name) for name in (*OWN, *CHOSEN)})


def state_of(step: Step, base: AppState) -> AppState:
    """Return the step's own state: its scene, its view and its options. The object to move in an
    exercise is selected.

    base: the current state. Only the user's own options, the language of programs and
    the place in the lecture are kept.
    """
    kept = {name: getattr(base.options, name) for name in (*OWN, *CHOSEN)}
    kept = {name: value for name, value in kept.items() if name not in step.changes}
    options = replace(step.options, marked=step.pixel, **kept)
    if isinstance(step.exercise, HideExercise):
        options = replace(options, objects=replace(options.objects, chosen=(step.exercise.item,)))
    return AppState(step.scene, step.view, is_orthonormal(step.view.camera), options, base.step)


def options_from_table(tables: dict[str, Any]) -> dict[str, Any]:
    """Return the changes for Options.with_changes(). Raises LucidaError."""
    types = _types(Options)
    changes: dict[str, Any] = {}
    for name, value in tables.items():
        if name not in NAMES:
            raise LucidaError(name, "is unknown", suggestion(name, NAMES))
        kind = types[name]
        if not is_dataclass(kind):
            changes[name] = getattr(to_struct({name: value}, _struct(Options)), name)
        elif not isinstance(value, dict):
            raise LucidaError(name, "is not a table", f"give e.g. {name}.{fields(kind)[0].name}")
        else:
            with under(name):
                changes[name] = _part(kind, value)
    check(Options, changes)
    return changes


def files_named(tables: Any) -> Iterator[str]:
    """Yield the files that a step's options name, even if other values are invalid."""
    for kind, _, part in _with_files(tables if isinstance(tables, dict) else {}):
        yield from (part[name] for name in files_of(kind) if isinstance(part.get(name), str))


def with_files(changes: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Return the changes with absolute paths of the files that they name, in the lecture's folder.
    Raises LucidaError if one does not exist.
    """
    changes = dict(changes)
    for kind, where, part in list(_with_files(changes)):
        found = {name: part[name] for name in files_of(kind) if part.get(name)}
        for name, file in found.items():
            path = (folder / file).absolute()
            if not path.exists():  # a set of cameras may be a folder
                raise LucidaError(f"{where}.{name}", f"{file!r} does not exist", "check its name")
            found[name] = stored(str(path))
        changes[where] = part | found
    return changes


def _with_files(tables: dict[str, Any]) -> Iterator[tuple[type, str, dict[str, Any]]]:
    """Yield the parts of options that can name files: class, name and content."""
    types = _types(Options)
    for name, part in tables.items():
        kind = types.get(name)
        if isinstance(kind, type) and is_dataclass(kind) and isinstance(part, dict):
            yield kind, name, part


def _part(kind: Any, table: dict[str, Any]) -> dict[str, Any]:
    """Return the changes of one part of the options. Its cameras are tables as in a scene file."""
    types = _types(kind)
    changes: dict[str, Any] = {}
    for name, value in table.items():
        if Camera in get_args(types.get(name)):
            if not isinstance(value, dict):
                raise LucidaError(name, "is not a table", f"give e.g. {name}.eye")
            with under(name):
                changes[name] = _camera(value)
    others = {name: value for name, value in table.items() if name not in changes}
    struct = to_struct(others, _struct(kind))
    return changes | {name: getattr(struct, name) for name in others}


def _camera(table: dict[str, Any]) -> Camera:
    """Return the camera of a table. Errors name its fields without "camera."."""
    try:
        return view_from_table(table).camera
    except LucidaError as error:
        field = error.field.removeprefix("camera").lstrip(".")
        raise LucidaError(field, error.problem, error.remedy) from None


def _struct(kind: Any) -> type[msgspec.Struct]:
    """Return a structure of a dataclass's fields, all optional. Unknown fields are errors."""
    types = _types(kind)
    kept = [
        (entry.name, types[entry.name], None)
        for entry in fields(kind)
        if Camera not in get_args(types[entry.name])
    ]
    return msgspec.defstruct(kind.__name__, kept, forbid_unknown_fields=True)
