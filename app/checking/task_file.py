"""The built-in tasks, and those of a lecturer's task file.

builtin.toml has one task for each part of the lecture. A lecturer's task begins as the built-in one
of its kind. Every mistake is reported with its file, line and field.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import msgspec

from lucida.app.checking.cases import camera_kinds, check_size, check_views
from lucida.app.checking.conventions import (
    CAMERA_WORDS,
    FOCAL_WORDS,
    PAIRS,
    PIXEL_WORDS,
    VISION_AXES,
    Conventions,
    Named,
)
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds.kind import CheckKind
from lucida.app.checking.task_schema import PROJECTIONS, ConventionsTable, TaskFile, TaskTable
from lucida.app.checking.tasks import CAMERA_KINDS, WITH_CAMERAS, CheckTask, Limits
from lucida.app.ui.explaining.symbols import Notation, spoken
from lucida.renderer.files.places import Places, located
from lucida.renderer.files.reading import decode_text, read_file, suggestion
from lucida.renderer.files.tables import parse_toml, to_struct
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError, under
from lucida.renderer.system.file_dependencies import noting

TASKS = 100
# Fields of older files, and their values that may be ignored because they still hold. With others,
# it would be another task.
REMOVED: dict[str, tuple[Any, ...]] = {
    "vectorised": (True, False),
    "vectors": ("column",),
    "origin": ("exact",),
    "pixel_origin": (),
    "at_threshold": (1,),
}
# Words that give the size of a parallel view.
SIZED = {"left", "right", "viewport", "viewport_width", "viewport_height", "horizontal"}
SIZED |= {"pixel00", "top_left", "bottom_left"}
NAME = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True)
class TaskSet:
    """The tasks of a file, and its limits. removed: fields of older versions, which are ignored."""

    title: str
    tasks: tuple[CheckTask, ...]
    limits: Limits
    notation: Notation = "book"
    removed: tuple[str, ...] = ()


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
    with noting():  # keeps this file out of suggestions for a missing view
        return _read(Path(path), source)


def _read(path: Path, source: str) -> TaskSet:
    text = decode_text(read_file(path, TOML_BYTES), source)
    try:
        tables = parse_toml(text)
    except LucidaError as error:
        if error.field == "lucida":
            raise located(error, Places(text), source) from None
        raise error.at_its_line(source) from None
    try:
        removed = _without_removed(tables)
        return replace(_tasks(to_struct(tables, TaskFile), path.parent), removed=removed)
    except LucidaError as error:
        if error.source:  # the error is in a view's file
            raise
        raise located(error, Places(text), source) from None


def _tasks(file: TaskFile, folder: Path) -> TaskSet:
    if not 1 <= len(file.tasks) <= TASKS:
        raise LucidaError("tasks", f"holds {len(file.tasks)} tasks", f"give 1 to {TASKS}")
    _check_words("conventions.camera", file.conventions.camera or {}, CAMERA_WORDS)
    tasks: list[CheckTask] = []
    for number, table in enumerate(file.tasks):
        field = f"tasks[{number}]"
        entry: TaskTable = to_struct(table, TaskTable, field)
        with under(field):
            check_known("kind", entry.kind, KINDS)
            base = next(t for t in builtin_tasks(file.notation) if t.kind == entry.kind)
            task = _task(entry, file, base, folder)
            if any(task.name == other.name for other in tasks):
                remedy = "give each task a name of its own"
                raise LucidaError("name", f"{task.name!r} is there already", remedy)
            tasks.append(task)
    limits = Limits()
    limits = Limits(file.seconds or limits.seconds, file.memory_mb or limits.memory_mb)
    return TaskSet(file.title, tuple(tasks), limits, file.notation)


def _without_removed(tables: dict[str, Any]) -> tuple[str, ...]:
    """Delete the fields that may be ignored. Return their names."""
    names = []
    tasks = tables.get("tasks")
    places = {f"tasks[{k}]": table for k, table in enumerate(tasks if type(tasks) is list else ())}
    for place, table in {"conventions": tables.get("conventions"), **places}.items():
        for name in REMOVED if isinstance(table, dict) else ():
            if name not in table:
                continue
            value = table.pop(name)
            if value not in REMOVED[name]:
                problem = f"{value!r} is of an older version, and made another task"
                raise LucidaError(f"{place}.{name}", problem, "CHANGELOG.md says what remains")
            names.append(name)
    return tuple(dict.fromkeys(names))


def _task(entry: TaskTable, file: TaskFile, base: CheckTask, folder: Path = Path()) -> CheckTask:
    """Return the task of a table. base: its values for what the table leaves out."""
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
        "weights": entry.weights,
        "stride": entry.stride,
        "projections": entry.projection and PROJECTIONS[entry.projection],
    }
    _check_name("function", own["function"])
    task = replace(
        base,
        points=entry.points,
        conventions=_conventions(entry, file.conventions, kind),
        views=tuple(_views(entry.views, folder)),
        column_major=entry.order == "column-major",
        **{name: value for name, value in own.items() if value is not None},
    )
    if task.kind in WITH_CAMERAS:
        return _with_cameras(task, entry.cameras)
    for name in ("cameras", "views", "size"):
        if getattr(entry, name):
            raise LucidaError(name, f"{task.kind} has no cameras", "leave it out")
    return task


def _text(entry: TaskTable, kind: CheckKind) -> str | None:
    """Return a description where the built-in one would be wrong."""
    others = (entry.arguments, entry.returns, entry.stride, entry.order, entry.weights)
    if all(other is None for other in others):
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
    is_vision = conventions.vision and kind.name in WITH_CAMERAS
    axes = said["axes"].signs if "axes" in said else VISION_AXES if is_vision else (1, 1, 1)
    if is_vision and (axes != VISION_AXES or conventions.rows == "bottom"):
        field = "rows" if axes == VISION_AXES else "axes"
        problem = "differs from K, R and t: x right, y down from the top, z forward"
        raise LucidaError(field, problem, "leave it out")
    return replace(conventions, axes=axes)


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
    """Raise LucidaError if a word is unknown, or if the program's name for one is no name."""
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
    angles = sorted(word for word in words if word.startswith("fov") or word in FOCAL_WORDS)
    if "parallel" in task.projections and angles and words.isdisjoint(SIZED):
        remedy = "give viewport_height, or perspective alone"
        raise LucidaError("projection", f"a parallel view has no {angles[0]}", remedy)
    cameras = given or [kind for kind in task.cameras if kind in possible]
    task = replace(task, cameras=tuple(cameras))
    if not task.count and not task.views:
        raise LucidaError("cases", "is 0, and there are no views", "give one of them")
    check_size(task, "size")
    check_views(task)
    return task


def _check_name(field: str, name: str) -> None:
    if not NAME.fullmatch(name):
        raise LucidaError(field, f"{name[:40]!r} is no name", "give letters, digits and _")


def _views(views: list[dict[str, Any] | str], folder: Path) -> Iterator[View]:
    from lucida.renderer.files.load import BUILTIN_SCENES, load_scene
    from lucida.renderer.files.views import load_view

    for number, view in enumerate(views):
        if isinstance(view, dict):
            with under(f"views[{number}]"):
                yield camera_view(view)
        elif view in BUILTIN_SCENES:
            yield load_scene(view).view
        else:
            try:
                yield load_view(folder / view)
            except LucidaError as error:
                raise error.of_file_in(f"views[{number}]") from None


def camera_view(table: dict[str, Any]) -> View:
    """Return the view of a camera's table. Errors name its fields without "camera."."""
    from lucida.renderer.files.views import view_from_table

    try:
        return view_from_table(table)
    except LucidaError as error:
        field = error.field.removeprefix("camera").lstrip(".")
        raise LucidaError(field, error.problem, error.remedy) from None


def check_known(field: str, name: str, names: Iterable[str]) -> None:
    """Raise LucidaError if a name is not among the known ones."""
    if name not in names:
        raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))


BUILTIN = builtin_tasks("book")
