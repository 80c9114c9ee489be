"""A lecture: its steps, its outline, its formulas. reading.py makes it from a file."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from app.lecture.exercises import AskedExercise
from app.lecture.hiding import HideExercise
from app.lecture.text import Block, stages
from renderer.scene.model import Scene, View
from renderer.scene.noting import Noted

Exercise = AskedExercise | HideExercise


@dataclass(frozen=True, eq=False)
class Step:
    """A step of a lecture.

    part: the part of the lecture that it belongs to.
    views: the names of the views to show, the main one first.
    low: the second is a small one, below the text.
    options: changes of the default options, by part.
    links: changes that a link in the text makes, by its name.
    pixel: the marked one, (row, column), 0-based.
    highlight: the names of controls to point out.
    line: where the step begins in the file.
    """

    title: str
    part: str
    text: str
    blocks: tuple[Block, ...]  # with the answer to its question
    notes: tuple[Block, ...]  # for the lecturer
    scene: Scene
    view: View
    views: tuple[str, ...]
    low: bool
    options: dict[str, Any]
    links: dict[str, dict[str, Any]]
    pixel: tuple[int, int] | None
    highlight: tuple[str, ...]
    exercise: Exercise | None
    line: int

    @property
    def stages(self) -> int:
        """The number of times that Page Down uncovers something before it goes on."""
        return stages(self.blocks)


@dataclass(frozen=True, eq=False)
class Written:
    """A formula in a file. field, source, line: where it begins."""

    latex: str
    field: str
    source: str
    line: int


@dataclass(frozen=True, eq=False)
class Lecture:
    """A lecture.

    source: its file.
    formulas: all of them, in the file's order.
    outside: files outside its folder that the user has agreed to.
    files: all files that it was read from, with their stamps.
    notes: a line for each option or view in the file that has left.
    """

    title: str
    author: str
    steps: tuple[Step, ...]
    source: str
    formulas: tuple[Written, ...] = ()
    outside: tuple[Path, ...] = ()
    files: Noted = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def outline(self) -> list[tuple[str, list[int]]]:
        """Return the parts in order, each with the numbers of its steps, from 0."""
        parts: list[tuple[str, list[int]]] = []
        for number, step in enumerate(self.steps):
            if not parts or parts[-1][0] != step.part:
                parts.append((step.part, []))
            parts[-1][1].append(number)
        return parts

    def explaining(self, step: Step) -> str:
        """Return the title of the step before an exercise that explains it."""
        before = self.steps[: self.steps.index(step)]
        return next((one.title for one in reversed(before) if one.exercise is None), step.title)

    def nearest(self, title: str, number: int) -> int:
        """Return the number of the nearest step of that title; if there is none, the same number.

        In a newer version of a lecture, this is the step to continue at.
        """
        same = [k for k, step in enumerate(self.steps) if step.title == title]
        if same:
            return min(same, key=lambda k: abs(k - number))
        return min(max(number, 0), len(self.steps) - 1)
