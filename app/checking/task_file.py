"""Reading a lecturer's task file. Every mistake is reported with its file, line and field."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lucida.app.checking.builtin import builtin_tasks
from lucida.app.checking.calls import Limits
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
from lucida.app.checking.kinds.basis import PARTS
from lucida.app.checking.kinds.kind import CheckKind
from lucida.app.checking.task_schema import AxesTable, ConventionsTable, TaskFile, TaskTable
from lucida.app.checking.tasks import CAMERA_KINDS, SEED, WITH_CAMERAS, CheckTask
from lucida.app.state.options.shared import Notation
from lucida.renderer.files.places import Places, located
from lucida.renderer.files.reading import decode_text, read_file, suggestion
from lucida.renderer.files.tables import parse_toml, to_struct
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError, under
from lucida.renderer.system.file_dependencies import noting

TASKS = 100
REMOVED = ("vectorised",)  # fields of older files; a function is called for each pixel
VISION = "K, R and t: x right, y down, z forward"
NAME = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True)
class TaskSet:
    """The tasks of a file, and its limits."""

    title: str
    tasks: tuple[CheckTask, ...]
    limits: Limits
    notation: Notation = "book"


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
        return _tasks(to_struct(tables, TaskFile), path.parent)
    except LucidaError as error:
        if error.source:  # the error is in a view's file
            raise
        raise located(error, Places(text), source) from None


def _tasks(file: TaskFile, folder: Path) -> TaskSet:
    if not 1 <= len(file.tasks) <= TASKS:
        raise LucidaError("tasks", f"holds {len(file.tasks)} tasks", f"give 1 to {TASKS}")
    limits = Limits()
    limits = Limits(file.seconds or limits.seconds, file.memory_mb or limits.memory_mb)
    shared = Conventions()
    if file.conventions.camera is not None:
        camera = tuple(_camera("conventions.camera", file.conventions.camera))
        shared = replace(shared, camera=camera)
    tasks: list[CheckTask] = []
    for number, table in enumerate(file.tasks):
        field = f"tasks[{number}]"
        kept = {name: value for name, value in table.items() if name not in REMOVED}
        entry: TaskTable = to_struct(kept, TaskTable, field)
        with under(field):
            task = _task(entry, file, shared, folder)
            if any(task.name == other.name for other in tasks):
                remedy = "give each task a name of its own"
                raise LucidaError("name", f"{task.name!r} is there already", remedy)
            tasks.append(task)
    return TaskSet(file.title, tuple(tasks), limits, file.notation)


def _task(entry: TaskTable, file: TaskFile, shared: Conventions, folder: Path) -> CheckTask:
    if entry.kind not in KINDS:
        raise LucidaError("kind", f"{entry.kind!r} is unknown", suggestion(entry.kind, KINDS))
    kind = KINDS[entry.kind]
    base = next(task for task in builtin_tasks(file.notation) if task.kind == kind.name)
    conventions = _conventions(entry, file.conventions, kind, shared.camera)
    projections = base.projections
    if entry.projection is not None:
        projections = (
            ("perspective", "parallel") if entry.projection == "both" else (entry.projection,)
        )
    _check_rigid_parallel(conventions, projections)
    seed = next(s for s in (entry.seed, file.seed, SEED) if s is not None)
    function = entry.function or kind.function
    _check_name("function", function)
    task = replace(
        base,
        name=entry.name or entry.kind,
        function=function,
        part=entry.part or base.part,
        text=entry.text or _text(entry, kind, base),
        points=entry.points,
        conventions=conventions,
        cameras=_cameras(entry, conventions, base),
        projections=projections,
        count=base.count if entry.cases is None else entry.cases,
        views=tuple(_views(entry.views, folder)),
        size=entry.size,
        seed=seed,
        feedback=entry.feedback or file.feedback,
        weights=base.weights if entry.weights is None else entry.weights,
        inclusive=entry.at_threshold != 0,
        column_major=entry.order == "column-major",
        stride=base.stride if entry.stride is None else entry.stride,
    )
    _check(task)
    return task


def _text(entry: TaskTable, kind: CheckKind, base: CheckTask) -> str:
    """Return the description. The built-in one only applies to the built-in conventions."""
    others = (entry.arguments, entry.returns, entry.stride, entry.order, entry.weights)
    if all(other is None for other in (*others, entry.at_threshold)):
        return base.text
    answer = kind.answer if entry.returns is None else ", ".join(entry.returns)
    return f"See the course's own text. Give {answer}."


def _conventions(
    entry: TaskTable, shared: ConventionsTable, kind: CheckKind, camera: Named
) -> Conventions:
    def said(name: str, default: Any) -> Any:
        values = (getattr(entry, name), getattr(shared, name))
        return next((value for value in values if value is not None), default)

    axes = said("axes", AxesTable())
    signs = (
        1 if axes.x == "right" else -1,
        1 if axes.y == "up" else -1,
        1 if axes.z == "back" else -1,
    )
    if entry.camera is not None:
        camera = tuple(_camera("camera", entry.camera))
    conventions = Conventions(
        _arguments(entry, kind),
        camera,
        _returns(entry, kind),
        said("pixels_from", 0),
        said("rows", "top"),
        signs,
        said("vectors", "column") == "row",
        said("space", "world"),
        bool(said("unit", False)),
        said("origin", "exact") == "on-ray",
        said("pixel_origin", ""),
    )
    if not conventions.vision or kind.name not in WITH_CAMERAS:
        return conventions
    if said("axes", None) is None:
        conventions = replace(conventions, axes=VISION_AXES)
    if conventions.axes != VISION_AXES:
        raise LucidaError("axes", f"are not those of {VISION}", "leave them out")
    if conventions.rows == "bottom":
        raise LucidaError("rows", f"begin at the top for {VISION}", "leave it out")
    return conventions


def _arguments(entry: TaskTable, kind: CheckKind) -> Named:
    given = entry.arguments
    if given is None:
        return tuple((word, word) for word in kind.arguments)
    if isinstance(given, dict):
        named = list(given.items())
        for name, word in named:
            check_known(f"arguments.{name}", word, kind.words)
            _check_name(f"arguments.{name}", name)
    else:
        named = [(word, word) for word in given]
        for number, word in enumerate(given):
            check_known(f"arguments[{number}]", word, kind.words)
    if not named:
        raise LucidaError("arguments", "is empty", f"give e.g. {list(kind.arguments)}")
    words = [word for _, word in named]
    if len(set(words)) < len(words):
        raise LucidaError("arguments", "names a word twice", "give each once")
    if kind.name == "viewing-ray" and not {*PIXEL_WORDS, *PAIRS} & set(words):
        raise LucidaError("arguments", "has no word for the pixel", 'give e.g. "i", "j" or "xy01"')
    return tuple(named)


def _camera(field: str, fields: dict[str, str]) -> Iterator[tuple[str, str]]:
    for name, word in fields.items():
        _check_name(f"{field}.{name}", name)
        check_known(f"{field}.{name}", word, CAMERA_WORDS)
        yield name, word


def _returns(entry: TaskTable, kind: CheckKind) -> tuple[str, ...]:
    if entry.returns is None:
        return kind.returns
    if not kind.returns:
        raise LucidaError("returns", f"{kind.name} gives {kind.answer}", "leave it out")
    for number, word in enumerate(entry.returns):
        check_known(f"returns[{number}]", word, kind.return_words)
    same = [PARTS[word][0] if kind.name == "basis" else word for word in entry.returns]
    if not same or len(set(same)) < len(same):
        raise LucidaError(
            "returns", "names nothing, or one thing twice", f"give e.g. {list(kind.returns)}"
        )
    if kind.name == "closest-hit" and len(same) < 2:
        raise LucidaError("returns", "names one thing", 'give "object" and "t"')
    return tuple(entry.returns)


def _cameras(entry: TaskTable, conventions: Conventions, base: CheckTask) -> tuple[str, ...]:
    possible = camera_kinds(conventions)
    if entry.kind not in WITH_CAMERAS:
        if entry.cameras is not None:
            raise LucidaError("cameras", f"{entry.kind} has no cameras", "leave it out")
        return base.cameras
    if entry.cameras is None:
        return tuple(kind for kind in base.cameras if kind in possible)
    for number, kind in enumerate(entry.cameras):
        check_known(f"cameras[{number}]", kind, CAMERA_KINDS)
        if kind not in possible:
            raise LucidaError(
                f"cameras[{number}]",
                f"{kind!r} cannot be told in the words of the arguments",
                f"give {', '.join(possible)}; or u, v, w and viewport for angles and targets",
            )
    if not entry.cameras:
        raise LucidaError("cameras", "is empty", "name one, or set cases = 0 and give views")
    return tuple(entry.cameras)


def _check_rigid_parallel(conventions: Conventions, projections: Iterable[str]) -> None:
    """Raise LucidaError if parallel cameras are described by angles or focal lengths."""
    angles = sorted(
        word for word in conventions.words if word.startswith("fov") or word in FOCAL_WORDS
    )
    sized = {"left", "right", "viewport", "viewport_width", "viewport_height", "horizontal"}
    sized |= {"pixel00", "top_left", "bottom_left"}
    if "parallel" in projections and angles and not sized & conventions.words:
        raise LucidaError(
            "projection",
            f"a parallel view has no {angles[0]}",
            "give viewport_height, or perspective alone",
        )


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


def _check(task: CheckTask) -> None:
    """Check conditions that involve several fields."""
    if task.kind in WITH_CAMERAS:
        if not task.count and not task.views:
            raise LucidaError("cases", "is 0, and there are no views", "give one of them")
        check_size(task, "size")
        check_views(task)
    elif task.views or task.size:
        which = "views" if task.views else "size"
        raise LucidaError(which, f"{task.kind} has no cameras", "leave it out")


def check_known(field: str, name: str, names: Iterable[str]) -> None:
    """Raise LucidaError if a name is not among the known ones."""
    if name not in names:
        raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))
