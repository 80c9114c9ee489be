"""Read a lecture from a file. Every mistake is reported with its file, line and field."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.checking.task_file import check_known
from app.lecture import text as texts
from app.lecture.model import Lecture, Step, Written
from app.lecture.notation import explained
from app.lecture.reading_exercises import exercise_of, pixel_of
from app.lecture.schema import (
    HIGHLIGHTS,
    PANEL,
    VIEWS,
    LectureFile,
    StepTable,
)
from app.lecture.step_options import files_named, options_from_table, with_files
from app.lecture.written import formulas_written, pieces_written
from app.state.all_options import AllOptions
from app.state.options import Notation
from app.state.removed import without_removed, without_removed_views
from renderer.errors import LucidaError, under
from renderer.pixels import Indexing
from renderer.scene.files import scene_from_tables
from renderer.scene.limits import TOML_BYTES, TRIANGLES
from renderer.scene.load import BUILTIN_SCENES, load_scene
from renderer.scene.model import Mesh, Scene, View
from renderer.scene.noting import noting
from renderer.scene.outside import check_inside, kept_inside
from renderer.scene.places import Places, located
from renderer.scene.reading import decode_text, read_file, suggestion
from renderer.scene.tables import parse_toml, to_struct
from renderer.scene.views import load_view, view_from_table

BUILTIN = Path(__file__).parents[1] / "lectures" / "images-rays-cameras.toml"
STEPS = 1000
PIECES = 20_000  # of a lecture's texts: formulas, and runs of words in one style; a slide has ten
TITLE_LETTERS = 300
_STEPS_LINE = re.compile(r"^[ \t]*(\[\[[ \t]*steps[ \t]*\]\]|steps[ \t]*=)", re.MULTILINE)


def is_lecture(path: str | Path) -> bool:
    """Return True if a file is meant as a lecture: a .toml that has steps, and no objects of its
    own.

    A broken one is recognised by a line that begins a step. An unreadable file is none.
    """
    if Path(path).suffix.lower() != ".toml":
        return False
    try:
        text = decode_text(read_file(Path(path), TOML_BYTES), str(path))
    except LucidaError:
        return False
    try:
        keys = set(parse_toml(text))
    except LucidaError:
        return _STEPS_LINE.search(text) is not None
    return "objects" not in keys and not keys.isdisjoint(("steps", "scenes"))


def load_lecture(path: str | Path, agreed: frozenset[Path] | None = frozenset()) -> Lecture:
    """Return the lecture in a file. Raises LucidaError: `file:line: field: problem; remedy`.

    agreed: files outside its folder that it may read; None for any. OutsideError names the others.
    """
    with kept_inside(Path(path), agreed) as fence, noting() as noted:
        lecture = _load(path)
    return replace(lecture, outside=tuple(fence.outside), files=noted)


def _load(path: str | Path) -> Lecture:
    data = read_file(Path(path), TOML_BYTES)
    try:
        text = decode_text(data, str(path))
    except LucidaError as error:
        raise error.at_its_line(str(path)) from None
    return lecture_from_toml(text, Path(path).parent, str(path))


def lecture_from_toml(text: str, folder: Path, source: str) -> Lecture:
    """Return the lecture in a text.

    folder: the paths of its scenes and views are relative to it.
    source: the file's name, for errors.
    """
    try:
        tables = parse_toml(text)
    except LucidaError as error:
        if error.field == "lucida":  # the version: then the text is TOML
            raise located(error, Places(text), source) from None
        raise error.at_its_line(source) from None
    places = Places(text)
    try:
        return _LectureReader(folder, source, places).lecture(tables)
    except texts.TextError as error:
        where = f"{source}:{places.line(error.field) + error.line}"
        raise LucidaError(error.field, error.problem, error.remedy, where) from None
    except LucidaError as error:
        raise located(error, places, source) from None


class _LectureReader:
    """Reads one file. Each of its scenes is read once."""

    def __init__(self, folder: Path, source: str, places: Places) -> None:
        self._folder, self._source, self._places = folder, source, places
        self._scenes: dict[str, Scene] = {}
        self._triangles = 0  # of all of them
        self._indexing = Indexing.LECTURE
        self._notation: Notation | None = None
        self._notes: list[str] = []
        self._at = ""  # the field of the step that is being read

    def lecture(self, tables: dict[str, Any]) -> Lecture:
        file: LectureFile = to_struct(tables, LectureFile)
        _check_title("title", file.title, "the lecture's title")
        if not 1 <= len(file.steps) <= STEPS:
            raise LucidaError("steps", f"holds {len(file.steps)} steps", f"give 1 to {STEPS}")
        if len(file.scenes) > STEPS:
            raise LucidaError("scenes", f"holds {len(file.scenes)}", f"give at most {STEPS}")
        self._indexing, self._notation = Indexing(file.pixels_from), file.notation
        check_inside(self._named(file))
        for name, scene in file.scenes.items():
            with under(f"scenes.{name}"):
                self._keep(name, self._own_scene(scene, name))
        steps: list[Step] = []
        written: list[Written] = []
        part, pieces = "", 0
        for number, table in enumerate(file.steps):
            field = f"steps[{number}]"
            entry: StepTable = to_struct(table, StepTable, field)
            part = entry.part or part
            self._at = field
            with under(field):
                steps.append(self._step(entry, part, self._places.line(field)))
            pieces += pieces_written(table)
            if pieces > PIECES:
                raise LucidaError(
                    field,
                    f"brings the lecture to more than {PIECES} formulas and runs of words",
                    "divide it into several lectures",
                )
            written += formulas_written(table, field, self._places, self._source)
        texts_of = explained(step.blocks for step in steps)
        steps = [
            step if step.blocks is blocks else replace(step, blocks=blocks)
            for step, blocks in zip(steps, texts_of, strict=True)
        ]
        return Lecture(
            file.title,
            file.author,
            tuple(steps),
            self._source,
            tuple(written),
            notes=tuple(self._notes),
        )

    def _named(self, file: LectureFile) -> Iterator[Path]:
        """Yield the files that the lecture names itself: models, scenes, views."""
        entries = [entry for table in file.scenes.values() for entry in _objects_of(table)]
        names = [entry.get("file") for entry in entries if isinstance(entry, dict)]
        for step in file.steps:
            if isinstance(step, dict):
                scene = step.get("scene")
                inside = scene in file.scenes or scene in BUILTIN_SCENES
                names += [None if inside else scene, step.get("camera")]
                names += files_named(step.get("options"))
                links = step.get("links")
                for table in links.values() if isinstance(links, dict) else ():
                    names += files_named(table)
        return (self._folder / name for name in names if isinstance(name, str))

    def _keep(self, name: str, scene: Scene) -> None:
        """Keep a scene. Raise LucidaError if all scenes together have too many triangles."""
        meshes = (entry.shape for entry in scene.objects if isinstance(entry.shape, Mesh))
        self._triangles += sum(len(mesh.faces) for mesh in meshes)
        if self._triangles > TRIANGLES:
            problem = f"brings the lecture's scenes to more than {TRIANGLES} triangles"
            raise LucidaError("", problem, "divide it into several lectures")
        self._scenes[name] = scene

    def _own_scene(self, table: Any, name: str) -> Scene:
        if name in BUILTIN_SCENES:
            raise LucidaError("", "is the name of a built-in scene", "give it another")
        if not isinstance(table, dict):
            raise LucidaError("", "is not a table", f"write it as [scenes.{name}]")
        return scene_from_tables(table, self._folder, name)

    def _step(self, table: StepTable, part: str, line: int) -> Step:
        _check_title("title", table.title, "the step's title")
        if table.part:
            _check_title("part", table.part, "the part's title")
        with under("text"):
            blocks = texts.parse(table.text)
        with under("notes"):
            notes = texts.parse(table.notes)
        if table.answer:
            blocks = texts.with_answer(blocks, table.answer)
        if table.reveal:
            blocks = texts.with_covered_items(blocks)
        scene = self._scene(table.scene or BUILTIN_SCENES[0])
        view = scene.view if table.camera is None else self._view(table.camera)
        with under("options"):
            options = self._options(table.options, "options")
        with under("links"):
            links = self._links(table.links, texts.links(blocks))
        resolution = options.get("images", {}).get("resolution")
        exercise = None
        if table.exercise is not None:
            with under("exercise"):
                exercise = exercise_of(table.exercise, scene, view, self._indexing)
        return Step(
            table.title,
            part,
            table.text,
            blocks,
            notes,
            scene,
            view,
            _views(self._present_views(table.views)),
            table.low,
            options,
            links,
            None if table.pixel is None else pixel_of(table.pixel, resolution, self._indexing),
            _highlight(table.highlight),
            exercise,
            line,
        )

    def _present_views(self, names: list[str]) -> list[str]:
        """Return the views that have not left; the default ones if all of them have."""
        kept, lines = without_removed_views(names)
        self._note("views", lines)
        return kept or StepTable(title="").views

    def _note(self, field: str, lines: list[str]) -> None:
        """Keep lines about a field of the present step, with their place in the file."""
        field = f"{self._at}.{field}"
        where = f"{self._source}:{self._places.line(field)}: {field}"
        self._notes += [f"{where}: {line}" for line in lines]

    def _options(self, tables: dict[str, Any], field: str) -> dict[str, Any]:
        """Return the step's options. Pixels are counted in the same way in all steps."""
        present, lines = without_removed(tables)
        self._note(field, lines)
        options = with_files(options_from_table(present), self._folder)
        one_based = self._indexing is Indexing.LECTURE
        if self._notation is not None:
            options = {"notation": self._notation} | options
        if one_based != AllOptions().one_based:
            options = {"one_based": one_based} | options
        if options.get("one_based", one_based) != one_based:
            raise LucidaError(
                "one_based",
                f"differs from pixels_from = {self._indexing.value}",
                "leave it out; pixels_from, beside the title, holds for the whole lecture",
            )
        return options

    def _links(self, tables: dict[str, Any], named: tuple[str, ...]) -> dict[str, Any]:
        """Return the links. named: those in the text."""
        for name in named:
            if name not in tables:
                raise LucidaError(
                    name, "is missing", f"give options, e.g. links.{name}.shadows = true"
                )
        links = {}
        for name, table in tables.items():
            with under(name):
                links[name] = self._options(table, f"links.{name}")
        return links

    def _scene(self, name: str) -> Scene:
        if name not in self._scenes:
            known = name in BUILTIN_SCENES
            if not known and not Path(name).suffix:
                names = (*self._scenes, *BUILTIN_SCENES)
                names = tuple(dict.fromkeys(names))
                raise LucidaError("scene", f"{name!r} is unknown", suggestion(name, names))
            try:
                scene = load_scene(name if known else self._folder / name)
            except LucidaError as error:
                raise error.of_file_in("scene") from None
            with under("scene"):
                self._keep(name, scene)
        return self._scenes[name]

    def _view(self, camera: dict[str, Any] | str) -> View:
        if not isinstance(camera, str):
            return view_from_table(camera)
        try:
            return load_view(self._folder / camera)
        except LucidaError as error:
            raise error.of_file_in("camera") from None


def _objects_of(table: Any) -> list[Any]:
    """Return the objects in the table of a scene, which has not been checked yet."""
    entries = table.get("objects") if isinstance(table, dict) else None
    return entries if isinstance(entries, list) else []


def _check_title(field: str, title: str, what: str) -> None:
    if not title.strip():
        raise LucidaError(field, "is empty", f"give {what}")
    if len(title) > TITLE_LETTERS:
        raise LucidaError(field, f"is {len(title)} characters long", f"stay within {TITLE_LETTERS}")


def _highlight(names: list[str]) -> tuple[str, ...]:
    """Return each name once, because all are searched in each frame."""
    for number, name in enumerate(names):
        check_known(f"highlight[{number}]", name, HIGHLIGHTS)
    return tuple(dict.fromkeys(names))


def _views(names: list[str]) -> tuple[str, ...]:
    for number, name in enumerate(names):
        check_known(f"views[{number}]", name, (*VIEWS, PANEL))
    if len(set(names)) < len(names):
        raise LucidaError("views", "names one twice", "name each view once")
    pictures = [name for name in names if name != PANEL]
    if not 1 <= len(pictures) <= 2:
        raise LucidaError(
            "views",
            f"names {len(pictures)} besides {PANEL!r}",
            "give one or two: a class looks at one thing at a time",
        )
    return tuple(names)
