"""The input and the result of a scene's export, and the list of what could not be carried over."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from renderer.camera import Camera, Size
from renderer.errors import one_line
from renderer.scene.model import Scene


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
