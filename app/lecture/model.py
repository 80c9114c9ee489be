"""A lecture: its steps, its outline and its formulas. reading.py makes it from a file."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from lucida.app.state.options import Options
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.file_dependencies import Noted

from .exercises import AskedExercise
from .hiding import HideExercise
from .text import Block

Exercise = AskedExercise | HideExercise


@dataclass(frozen=True, eq=False)
class Step:
    """A step of a lecture, at one of its builds.

    number, build: from 0.
    part: the part of the lecture that it belongs to.
    before: the part of the text that the previous build already shows.
    views: the names of the views to show, the main one first.
    full: the picture fills the window, and the text lies over it.
    changes: of the default options, by part, as in the file.
    options: the default options with these changes.
    pixel: the marked one, (row, column), 0-based.
    exercise: of the step's last build; otherwise None.
    move_s: the duration of the movement from the previous build; 0 for a cut.
    loop: the movement repeats until the next key.
    line: its first line in the file.
    """

    number: int
    build: int
    title: str
    part: str
    text: str
    blocks: tuple[Block, ...]
    before: tuple[Block, ...]
    notes: tuple[Block, ...]  # for the lecturer
    scene: Scene
    view: View
    views: tuple[str, ...]
    full: bool
    changes: dict[str, Any]
    options: Options
    pixel: tuple[int, int] | None
    exercise: Exercise | None
    move_s: float
    loop: bool
    line: int


@dataclass(frozen=True, eq=False)
class Written:
    """A formula in a file. field, source, line: its place."""

    latex: str
    field: str
    source: str
    line: int


@dataclass(frozen=True, eq=False)
class Lecture:
    """A lecture.

    builds: of all steps, in order.
    source: its file.
    formulas: all of them, in the file's order.
    outside: files outside its folder that the user has agreed to.
    files: all files that it was read from, with their stamps.
    notes: a line for each removed option or view in the file.
    """

    title: str
    author: str
    builds: tuple[Step, ...]
    source: str
    formulas: tuple[Written, ...] = ()
    outside: tuple[Path, ...] = ()
    files: Noted = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def summary(self) -> tuple[str, ...]:
        """Return the notes in at most one line, because many would cover the slide."""
        if len(self.notes) < 2:
            return self.notes
        others = f"{len(self.notes) - 1} more: lucida lecture {Path(self.source).name} --check"
        return (f"{self.notes[0]} (and {others})",)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The steps, each at its first build."""
        return tuple(one for one in self.builds if one.build == 0)

    def place(self, number: int, build: int = 0) -> int:
        """Return the place of a step's build among all builds; the nearest one if it no longer
        exists.
        """
        wanted = min(max(number, 0), self.builds[-1].number), build
        later = (place for place, one in enumerate(self.builds) if (one.number, one.build) > wanted)
        return max(0, next(later, len(self.builds)) - 1)

    def count(self, number: int) -> int:
        """Return the number of builds that a step has."""
        return sum(one.number == number for one in self.builds)

    def outline(self) -> list[tuple[str, list[int]]]:
        """Return the parts in order, each with the numbers of its steps, from 0."""
        parts: list[tuple[str, list[int]]] = []
        for step in self.steps:
            if not parts or parts[-1][0] != step.part:
                parts.append((step.part, []))
            parts[-1][1].append(step.number)
        return parts

    def explaining(self, step: Step) -> str:
        """Return the title of the earlier step that explains an exercise."""
        asking = {one.number for one in self.builds if one.exercise is not None}
        before = self.steps[: step.number]
        return next((one.title for one in reversed(before) if one.number not in asking), step.title)

    def number_of(self, title: str) -> int | None:
        """Return the number of the first step with a title; None if there is none."""
        return next((step.number for step in self.steps if step.title == title), None)

    def nearest(self, title: str, number: int) -> int:
        """Return the number of the nearest step with that title, or else the same number.

        This is the step at which to continue in a newer version of a lecture.
        """
        same = [k for k, step in enumerate(self.steps) if step.title == title]
        if same:
            return min(same, key=lambda k: abs(k - number))
        return min(max(number, 0), len(self.steps) - 1)
