"""What is written of a scene, and what could not be carried over.

Knows nothing of any target.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from renderer.camera import Camera, Size
from renderer.errors import one_line
from renderer.scene.model import Scene


@dataclass(frozen=True)
class ExportSubject:
    """camera: as it is for an image of `size`, (width, height). stem: the file's name without its
    ending, which the files beside it begin with."""

    scene: Scene
    camera: Camera
    size: Size
    stem: str


@dataclass(frozen=True)
class Exported:
    """main: the file itself. beside: what makes each file beside it, by the path from its folder.
    left_out: one line for each thing that is not as it was."""

    main: bytes
    beside: dict[str, Callable[[], bytes]] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()


class LeftOut:
    """The list while it is made; each line once."""

    def __init__(self) -> None:
        self._lines: dict[str, None] = {}

    def add(self, what: str, why: str) -> None:
        """`what: why`."""
        self._lines[one_line(f"{what}: {why}")] = None

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(self._lines)

    @property
    def told(self) -> list[str]:
        """The lines as a file's comment has them."""
        return ["Not as it is there:", *(f"  {line}" for line in self.lines)] if self._lines else []


def called(kind: str, number: int, name: str) -> str:
    """An object's or a light's name in the list: its own, or its number."""
    return repr(name) if name else f"{kind} {number}"
