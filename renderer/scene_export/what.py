"""The input and the result of a scene's export: the files next to it, and the list of what could
not be carried over.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from functools import partial

from renderer.camera import Camera, Size
from renderer.errors import one_line
from renderer.scene.model import Scene

LONGEST = 40  # characters of an object's name in a file's name


@dataclass(frozen=True)
class ExportSubject:
    """A scene to be exported.

    camera: fitted to an image of `size`, (width, height). stem: the file's name without its ending;
    the names of the files next to it begin with it.
    """

    scene: Scene
    camera: Camera
    size: Size
    stem: str


@dataclass(frozen=True)
class Exported:
    """An exported scene.

    main: the file itself. beside: functions that make the files next to it, by their paths relative
    to its folder. left_out: one line for each thing that differs.
    """

    main: bytes
    beside: dict[str, Callable[[], bytes]] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()


class LeftOut:
    """A list of what could not be carried over, without duplicates."""

    def __init__(self) -> None:
        self._lines: dict[str, None] = {}

    def add(self, what: str, why: str) -> None:
        """Add the line `what: why`."""
        self._lines[one_line(f"{what}: {why}")] = None

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(self._lines)

    @property
    def told(self) -> list[str]:
        """The lines for a comment in the file."""
        return ["Not as it is there:", *(f"  {line}" for line in self.lines)] if self._lines else []


def called(kind: str, number: int, name: str) -> str:
    """Return an object's or a light's name for the list: its own, or its number."""
    return repr(name) if name else f"{kind} {number}"


class FilesBeside:
    """Names and contents of the files next to a scene's: one for each different mesh, picture or
    lobe, however often it is used. stem: of the scene's file name.
    """

    def __init__(self, stem: str) -> None:
        self._stem = stem
        self._names: dict[tuple[Hashable, ...], str] = {}
        self.contents: dict[str, Callable[[], bytes]] = {}

    def file(
        self, kind: str, ending: str, name: str, make: Callable[..., bytes], *inputs: Hashable
    ) -> str:
        """Return the path, relative to the scene's folder, of the file that holds make(*inputs).

        kind: the suffix of its folder's name. name: of the first object that uses it. The inputs
        are the key: the same file is made only once.
        """
        key = (make, *inputs)
        if key not in self._names:
            plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", name).strip("-.")[:LONGEST]
            number = sum(known[0] == make for known in self._names)
            file = f"{self._stem}_{kind}/{number}{f'-{plain}' if plain else ''}.{ending}"
            self._names[key] = file
            self.contents[file] = partial(make, *inputs)
        return self._names[key]
