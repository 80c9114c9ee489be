"""The built-in tasks, and those of a lecturer's task file.

builtin.toml has one task for each part of the lecture. A lecturer's task begins as the built-in one
of its kind. Every mistake is reported with its file, line and field.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import msgspec

from lucida.app.ui.explaining.symbols import Notation, spoken
from lucida.renderer.files.places import Places, located
from lucida.renderer.files.reading import decode_text, read_file, suggestion
from lucida.renderer.files.tables import parse_toml, to_struct
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.system.errors import LucidaError, under

from .cases import camera_kinds
from .conventions import CAMERA_WORDS, PAIRS, PIXEL_WORDS, Conventions, Named
from .kinds import KINDS
from .kinds.kind import CheckKind
from .task_schema import ConventionsTable, TaskFile, TaskTable
from .tasks import CAMERA_KINDS, MOST_CALLS, WITH_CAMERAS, CheckTask, Limits

# Removed fields, with the values that may be ignored. Other values changed the task, so they are
# errors.
REMOVED: dict[str, tuple[Any, ...]] = {
    "vectorised": (True, False),
    "vectors": ("column",),
    "origin": ("exact",),
    "at_threshold": (1,),
    "views": ([],),
}
REMOVED_KINDS = ("to-gray", "to-bitmap", "memory-offset")
# Words that give the size of a parallel view.
SIZED = {"left", "right", "viewport", "viewport_width", "viewport_height", "horizontal"}
SIZED |= {"pixel00", "top_left", "bottom_left"}
NAME = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True)
class TaskSet:
    """The tasks of a file, and its limits. notes: sentences on ignored parts of the file."""

    tasks: tuple[CheckTask, ...]
    limits: Limits
    notes: tuple[str, ...] = ()


@lru_cache
def builtin_tasks(notation: Notation) -> tuple[CheckTask, ...]:
    """Return the built-in tasks in a notation."""
    data = Path(__file__).with_name("builtin.toml").read_bytes()
    found = []
    for table in msgspec.toml.decode(data, type=TaskFile).tasks:
        entry = to_struct(table, TaskTable)
        kind = KINDS[entry.kind]
        base = CheckTask(kind.name, kind.name, kind.function, "", "", notation=notation)
        text = spoken(entry.text, notation)
        found.append(_task(msgspec.structs.replace(entry, text=text), TaskFile(tasks=[]), base))
    return tuple(found)


def load_tasks(path: str | Path) -> TaskSet:
    """Return the tasks in a file. Raises LucidaError: `file:line: field: problem; remedy`."""
    source = str(path)
    text = decode_text(read_file(Path(path), TOML_BYTES), source)
    try:
        tables = parse_toml(text)
    except LucidaError as error:
        if error.field == "lucida":
            raise located(error, Places(text), source) from None
        raise error.at_its_line(source) from None
    try:
        notes = [f"{name} is ignored; see CHANGELOG.md" for name in _without_removed(tables)]
        if tables.get("network") is False:
            notes.append("network = false is not enforced: a container without a network does it")
        found = _tasks(to_struct(tables, TaskFile))
        return replace(found, notes=(*notes, *found.notes))
    except LucidaError as error:
        raise located(error, Places(text), source) from None


def _tasks(file: TaskFile) -> TaskSet:
    _check_words("conventions.camera", file.conventions.camera or {}, CAMERA_WORDS)
    tasks: list[CheckTask] = []
    notes = []
    for number, table in enumerate(file.tasks):
        field = f"tasks[{number}]"
        if table.get("kind") in REMOVED_KINDS:
            notes.append(f"{field}: {table['kind']} is no longer checked; see CHANGELOG.md")
            continue
        entry: TaskTable = to_struct(table, TaskTable, field)
        with under(field):
            check_known("kind", entry.kind, KINDS)
            base = next(t for t in builtin_tasks(file.notation) if t.kind == entry.kind)
            task = _task(entry, file, base)
            if any(task.name == other.name for other in tasks):
                remedy = "give each task a name of its own"
                raise LucidaError("name", f"{task.name!r} is there already", remedy)
            tasks.append(task)
    limits = Limits()
    limits = Limits(file.seconds or limits.seconds, file.memory_mb or limits.memory_mb)
    return TaskSet(tuple(tasks), limits, tuple(notes))


def _without_removed(tables: dict[str, Any]) -> tuple[str, ...]:
    """Delete the fields that may be ignored. Return their names."""
    tasks = tables.get("tasks")
    places = [tables.get("conventions"), *(tasks if isinstance(tasks, list) else ())]
    found = [
        (table, name)
        for table in places
        if isinstance(table, dict)
        for name, values in REMOVED.items()
        if name in table and table[name] in values
    ]
    for table, name in found:
        del table[name]
    return tuple(dict.fromkeys(name for _, name in found))


def _task(entry: TaskTable, file: TaskFile, base: CheckTask) -> CheckTask:
    """Return the task of a table. base: a task with the default values."""
    kind = KINDS[entry.kind]
    own: dict[str, Any] = {
        "name": entry.name or kind.name,
        "function": entry.function or kind.function,
        "part": entry.part or None,
        "text": entry.text or _text(entry, kind),
        "count": entry.cases,
        "size": entry.size,
        "seed": file.seed if entry.seed is None else entry.seed,
        "feedback": entry.feedback or file.feedback,
        "projection": entry.projection,
    }
    _check_name("function", own["function"])
    task = replace(
        base,
        points=entry.points,
        conventions=_conventions(entry, file.conventions, kind),
        **{name: value for name, value in own.items() if value is not None},
    )
    if task.kind in WITH_CAMERAS:
        return _with_cameras(task, entry.cameras)
    for name in ("cameras", "size"):
        if getattr(entry, name):
            raise LucidaError(name, f"{task.kind} has no cameras", "leave it out")
    return task


def _text(entry: TaskTable, kind: CheckKind) -> str | None:
    """Return a description if the built-in one would be wrong."""
    if entry.arguments is None and entry.returns is None:
        return None
    answer = kind.answer if entry.returns is None else ", ".join(entry.returns)
    return f"See the course's own text. Give {answer}."


def _conventions(entry: TaskTable, shared: ConventionsTable, kind: CheckKind) -> Conventions:
    said = {
        name: value
        for table in (shared, entry)
        for name in ConventionsTable.__struct_fields__
        if (value := getattr(table, name)) is not None
    }
    conventions = Conventions(
        arguments=_arguments(entry.arguments, kind),
        returns=_returns(entry.returns, kind),
        base=said.get("pixels_from", 0),
        rows=said.get("rows", "top"),
        space=said.get("space", "world"),
        unit=said.get("unit", False),
    )
    if "camera" in said:
        _check_words("camera", entry.camera or {}, CAMERA_WORDS)
        conventions = replace(conventions, camera=tuple(said["camera"].items()))
    return replace(conventions, axes=said["axes"].signs) if "axes" in said else conventions


def _arguments(given: list[str] | dict[str, str] | None, kind: CheckKind) -> Named:
    if given is None:
        return tuple((word, word) for word in kind.arguments)
    _check_words("arguments", given, kind.words)
    named = tuple(given.items() if isinstance(given, dict) else zip(given, given, strict=True))
    if kind.name == "viewing-ray" and {*PIXEL_WORDS, *PAIRS}.isdisjoint(word for _, word in named):
        raise LucidaError("arguments", "has no word for the pixel", 'give e.g. "i", "j" or "xy01"')
    return named


def _returns(given: list[str] | None, kind: CheckKind) -> tuple[str, ...]:
    if given is None:
        return kind.returns
    if not kind.returns:
        raise LucidaError("returns", f"{kind.name} gives {kind.answer}", "leave it out")
    _check_words("returns", given, kind.return_words)
    if kind.name not in ("viewing-ray", "basis") and set(given) != set(kind.returns):
        raise LucidaError("returns", "leaves something out", f"give {list(kind.returns)}")
    return tuple(given)


def _check_words(field: str, given: list[str] | dict[str, str], known: Iterable[str]) -> None:
    """Raise LucidaError if a word is unknown, or if the program's name for it is invalid."""
    if isinstance(given, dict):
        for name, word in given.items():
            _check_name(f"{field}.{name}", name)
            check_known(f"{field}.{name}", word, known)
    else:
        for number, word in enumerate(given):
            check_known(f"{field}[{number}]", word, known)


def _with_cameras(task: CheckTask, given: list[str] | None) -> CheckTask:
    """Return the task with the kinds of cameras that its words can describe."""
    possible = camera_kinds(task.conventions)
    for number, kind in enumerate(given or ()):
        check_known(f"cameras[{number}]", kind, CAMERA_KINDS)
        if kind not in possible:
            raise LucidaError(
                f"cameras[{number}]",
                f"{kind!r} cannot be told in the words of the arguments",
                f"give {', '.join(possible)}; or u, v, w and viewport for angles and targets",
            )
    words = task.conventions.words
    angles = sorted(word for word in words if word.startswith("fov"))
    if task.projection == "parallel" and angles and words.isdisjoint(SIZED):
        remedy = "give viewport_height, or perspective alone"
        raise LucidaError("projection", f"a parallel view has no {angles[0]}", remedy)
    cameras = given or [kind for kind in task.cameras if kind in possible]
    width, height = task.size or (1, 1)
    if task.count * width * height > MOST_CALLS:
        raise LucidaError("size", f"makes more than {MOST_CALLS} rays", "give smaller images")
    return replace(task, cameras=tuple(cameras))


def _check_name(field: str, name: str) -> None:
    if not NAME.fullmatch(name):
        raise LucidaError(field, f"{name[:40]!r} is no name", "give letters, digits and _")


def check_known(field: str, name: str, names: Iterable[str]) -> None:
    """Raise LucidaError if a name is not among the known ones."""
    if name not in names:
        raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))


BUILTIN = builtin_tasks("book")
