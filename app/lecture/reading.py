"""Read a lecture from a file. Every mistake is reported with its file, line and field."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from lucida.app.checking.task_file import check_known
from lucida.app.state.options import Options
from lucida.app.state.removed import without_removed, without_removed_views
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files.load import BUILTIN_SCENES, load_scene
from lucida.renderer.files.outside import check_inside, kept_inside
from lucida.renderer.files.places import Places, located
from lucida.renderer.files.reading import decode_text, read_file, suggestion
from lucida.renderer.files.scene_file import scene_from_tables
from lucida.renderer.files.tables import parse_toml, to_struct
from lucida.renderer.files.views import load_view, view_from_table
from lucida.renderer.scene.limits import TOML_BYTES, TRIANGLES
from lucida.renderer.scene.model import Mesh, Scene, View
from lucida.renderer.system.errors import LucidaError, not_together, under
from lucida.renderer.system.file_dependencies import noting

from . import text as texts
from .inheriting import inherited
from .model import Lecture, Step, Written
from .old_format import REMEDY, fields_of, kind_of, old_builds
from .reading_exercises import exercise_of, pixel_of
from .schema import DEFAULT_VIEWS, VIEWS, BuildTable, LectureFile, OldStepTable, StepTable
from .step_options import files_named, options_from_table, with_files
from .written import formulas_written, texts_of

_FOLDER = Path(__file__).parent / "lectures"
BUILTIN = _FOLDER / "images-rays-cameras.toml"
BUILTINS = {  # by their titles
    "Images, rays and cameras": BUILTIN,
    "Cameras beyond the formula": _FOLDER / "cameras-beyond-the-formula.toml",
}
STEPS = 1000
BUILDS = 20  # of a step
MOVE_S = 60
PIECES = 20_000  # formulas and runs of words in one style; a slide has about ten
TITLE_LETTERS = 300
Blocks = tuple[texts.Block, ...]
Table = TypeVar("Table", StepTable, BuildTable)
_STEPS_LINE = re.compile(r"^[ \t]*(\[\[[ \t]*steps[ \t]*\]\]|steps[ \t]*=)", re.MULTILINE)


def is_lecture(path: str | Path) -> bool:
    """Return True if a file is meant as a lecture: a .toml that has steps, but no objects.

    A broken lecture is recognised by a line that begins a step. An unreadable file is not a
    lecture.
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
        if error.field == "lucida":  # an error of the version, so the text is TOML
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
    """A reader of one file, which reads each of its scenes once."""

    def __init__(self, folder: Path, source: str, places: Places) -> None:
        self._folder, self._source, self._places = folder, source, places
        self._scenes: dict[str, Scene] = {}
        self._triangles = 0  # of all scenes
        self._indexing = Indexing.LECTURE
        self._notes: list[str] = []
        self._old = ""  # the line about the first field of an older format
        self._at = ""  # the field of the step that is being read

    def lecture(self, tables: dict[str, Any]) -> Lecture:
        if "notation" in tables:
            self._note("notation", without_removed({"notation": tables.pop("notation")})[1])
        file: LectureFile = to_struct(tables, LectureFile)
        _check_title("title", file.title, "the lecture's title")
        if not 1 <= len(file.steps) <= STEPS:
            raise LucidaError("steps", f"holds {len(file.steps)} steps", f"give 1 to {STEPS}")
        if len(file.scenes) > STEPS:
            raise LucidaError("scenes", f"holds {len(file.scenes)}", f"give at most {STEPS}")
        self._indexing = Indexing(file.pixels_from)
        check_inside(self._named(file))
        for name, scene in file.scenes.items():
            with under(f"scenes.{name}"):
                self._keep(name, self._own_scene(scene, name))
        builds: list[Step] = []
        written: list[Written] = []
        part, pieces = "", 0
        for number, table in enumerate(file.steps):
            field = f"steps[{number}]"
            entry: StepTable = to_struct(table, kind_of(table), field)
            part = entry.part or part
            for path, text in texts_of(table, field):
                with under(path):
                    blocks = texts.parse(text)
                pieces += texts.pieces(blocks)
                written += formulas_written(text, blocks, path, self._places, self._source)
            if pieces > PIECES:
                raise LucidaError(
                    field,
                    f"brings the lecture to more than {PIECES} formulas and runs of words",
                    "divide it into several lectures",
                )
            self._at = field
            with under(field):
                builds += self._builds(entry, part, number)
        if self._old:
            self._notes.insert(0, self._old)
        return Lecture(
            file.title,
            file.author,
            tuple(builds),
            self._source,
            tuple(written),
            notes=tuple(self._notes),
        )

    def _named(self, file: LectureFile) -> Iterator[Path]:
        """Yield the models, scenes and views that the lecture names itself."""
        entries = [entry for table in file.scenes.values() for entry in _objects_of(table)]
        names = [entry.get("file") for entry in entries if isinstance(entry, dict)]
        builds = [build for step in file.steps for build in _builds_of(step)]
        for table in (*file.steps, *builds):
            if isinstance(table, dict):
                scene = table.get("scene")
                inside = scene in file.scenes or scene in BUILTIN_SCENES
                names += [None if inside else scene, table.get("camera")]
                names += files_named(table.get("options"))
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

    def _builds(self, table: StepTable, part: str, number: int) -> list[Step]:
        """Return all builds of a step. The step's own fields are the first build."""
        _check_title("title", table.title, "the step's title")
        if table.part:
            _check_title("part", table.part, "the part's title")
        if len(table.builds) >= BUILDS:
            raise LucidaError("builds", f"holds {len(table.builds)}", f"give fewer than {BUILDS}")
        notes = texts.parse(table.notes)
        given = self._present(table)
        first = self._build(given)
        first = replace(first, number=number, part=part, notes=notes)
        builds = [
            replace(first, blocks=blocks, before=before)
            for before, blocks in self._old_builds(table, first.blocks)
        ]
        for place, entry in enumerate(table.builds):
            self._at = f"steps[{number}].builds[{place}]"
            build: BuildTable = to_struct(entry, BuildTable, f"builds[{place}]")
            with under(f"builds[{place}]"):
                _check_build(build)
                given = inherited(given, self._present(build), builds[-1].view)
                at = self._build(given)
            before = () if build.instead else builds[-1].blocks
            builds.append(
                replace(
                    at,
                    number=number,
                    part=part,
                    notes=notes,
                    before=before,
                    move_s=build.move_s,
                    loop=build.loop,
                )
            )
        last = builds[-1]
        if table.exercise is not None:
            with under("exercise"):
                task = exercise_of(table.exercise, last.scene, last.view, self._indexing)
            builds[-1] = replace(last, exercise=task)
        return [replace(one, build=build) for build, one in enumerate(builds)]

    def _old_builds(self, table: StepTable, blocks: Blocks) -> list[tuple[Blocks, Blocks]]:
        """Return (the blocks that stay, the text) of each build of a step in any format."""
        if not isinstance(table, OldStepTable) or table.builds or not (old := fields_of(table)):
            return [((), blocks)]
        if not self._old:
            field = f"{self._at}.{old[0]}"
            self._old = f"{self._source}:{self._places.line(field)}: {field}: {REMEDY}"
        return old_builds(table, blocks)

    def _build(self, table: StepTable) -> Step:
        """Return a step at a build from its table. The caller adds the other fields."""
        scene = self._scene(table.scene or BUILTIN_SCENES[0])
        view = scene.view if table.camera is None else self._view(table.camera)
        with under("options"):
            changes = self._changes(table.options)
        resolution = changes.get("images", {}).get("resolution")
        pixel = table.pixel
        return Step(
            number=0,
            build=0,
            title=table.title,
            part="",
            text=table.text,
            blocks=texts.parse(table.text),
            before=(),
            notes=(),
            scene=scene,
            view=view,
            views=_views(table.views),
            full=table.full,
            changes=changes,
            options=Options().with_changes(changes),
            pixel=None if pixel is None else pixel_of(pixel, resolution, self._indexing),
            exercise=None,
            move_s=0.0,
            loop=False,
            line=self._places.line(self._at),
        )

    def _present(self, table: Table) -> Table:
        """Return a table without removed options and views."""
        options, lines = without_removed(table.options)
        self._note("options", lines)
        views = table.views
        if views is not None:
            views, lines = without_removed_views(views)
            self._note("views", lines)
        return msgspec.structs.replace(
            table, options=options, views=views if views or table.views is None else DEFAULT_VIEWS
        )

    def _note(self, field: str, lines: list[str]) -> None:
        """Keep lines about a field of the present step, or of the lecture, with their place in the
        file.
        """
        field = f"{self._at}.{field}" if self._at else field
        where = f"{self._source}:{self._places.line(field)}: {field}"
        self._notes += [f"{where}: {line}" for line in lines]

    def _changes(self, tables: dict[str, Any]) -> dict[str, Any]:
        """Return a step's changes of the options. All steps count pixels in the same way."""
        changes = with_files(options_from_table(tables), self._folder)
        one_based = self._indexing is Indexing.LECTURE
        if one_based != Options().one_based:
            changes = {"one_based": one_based} | changes
        if changes.get("one_based", one_based) != one_based:
            raise LucidaError(
                "one_based",
                f"differs from pixels_from = {self._indexing.value}",
                "leave it out; pixels_from, next to the title, applies to the whole lecture",
            )
        return changes

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


def _builds_of(table: Any) -> list[Any]:
    """Return the tables of a step's builds, which have not been checked yet."""
    entries = table.get("builds") if isinstance(table, dict) else None
    return entries if isinstance(entries, list) else []


def _check_build(build: BuildTable) -> None:
    if build.text and build.instead:
        raise not_together(
            "instead", "text", "text is added below the text so far; instead replaces it"
        )
    if not 0 <= build.move_s <= MOVE_S:
        raise LucidaError("move_s", f"{build.move_s:g} is out of range", f"give 0 to {MOVE_S}")
    if build.loop and not build.move_s:
        raise LucidaError("loop", "has no movement to repeat", "give move_s above 0")


def _objects_of(table: Any) -> list[Any]:
    """Return the objects in the table of a scene, which has not been checked yet."""
    entries = table.get("objects") if isinstance(table, dict) else None
    return entries if isinstance(entries, list) else []


def _check_title(field: str, title: str, what: str) -> None:
    if not title.strip():
        raise LucidaError(field, "is empty", f"give {what}")
    if len(title) > TITLE_LETTERS:
        raise LucidaError(field, f"is {len(title)} characters long", f"stay within {TITLE_LETTERS}")


def _views(names: list[str]) -> tuple[str, ...]:
    for number, name in enumerate(names):
        check_known(f"views[{number}]", name, VIEWS)
    if len(set(names)) < len(names):
        raise LucidaError("views", "names one twice", "name each view once")
    if len(names) not in (1, 2):
        raise LucidaError(
            "views", f"names {len(names)}", "give one or two: a class looks at one thing at a time"
        )
    return tuple(names)
