"""A lecture: its steps, its parts, its outline, its formulas.

Owns the structures that reading.py makes of a file. Knows nothing of files or windows.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from app.lecture.exercises import AskedExercise
from app.lecture.hiding import HideExercise
from app.lecture.text import Block
from renderer.scene.model import Scene, View
from renderer.scene.noting import Noted

Exercise = AskedExercise | HideExercise


@dataclass(frozen=True, eq=False)
class Step:
    """One step. part: the part of the lecture that it belongs to. views: names of the views to
    show, the main one first. options: changes of options.Options from its defaults, by part.
    pixel: the marked one, (row, column), 0-based. highlight: names of controls to point out.
    line: where it begins in the file."""

    title: str
    part: str
    text: str
    blocks: tuple[Block, ...]
    scene: Scene
    view: View
    views: tuple[str, ...]
    options: dict[str, Any]
    pixel: tuple[int, int] | None
    highlight: tuple[str, ...]
    exercise: Exercise | None
    line: int


@dataclass(frozen=True, eq=False)
class Written:
    """A formula as it is written. field, source, line: where in which file it begins."""

    latex: str
    field: str
    source: str
    line: int


@dataclass(frozen=True, eq=False)
class Lecture:
    """source: the file it comes from. formulas: all of them, in the file's order. outside: files
    outside of its folder that it names, which the user has agreed to. files: all that it was read
    from, as they were then."""

    title: str
    author: str
    steps: tuple[Step, ...]
    source: str
    formulas: tuple[Written, ...] = ()
    outside: tuple[Path, ...] = ()
    files: Noted = field(default_factory=dict)

    def outline(self) -> list[tuple[str, list[int]]]:
        """The parts in their order, each with the numbers of its steps, from 0."""
        parts: list[tuple[str, list[int]]] = []
        for number, step in enumerate(self.steps):
            if not parts or parts[-1][0] != step.part:
                parts.append((step.part, []))
            parts[-1][1].append(number)
        return parts

    def nearest(self, title: str, number: int) -> int:
        """Return the number of the nearest step of that title; if there is none, the same number.

        In a newer version of a lecture, this is the step to continue at.
        """
        same = [k for k, step in enumerate(self.steps) if step.title == title]
        if same:
            return min(same, key=lambda k: abs(k - number))
        return min(max(number, 0), len(self.steps) - 1)
