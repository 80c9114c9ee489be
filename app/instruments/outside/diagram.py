"""The parts of a drawing over the outside view, in world space: lines, faces, marks, labels.

Parts have names and roles; painting and SVG choose a colour by the role. Pure: the module knows no
outside camera, no pixels and no colours. camera_diagram.py draws a camera with these parts.

Widths and radii are in units of a line's width, which is about a pixel at 100 %.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.checks import Floats

Role = Literal[
    "u", "v", "w", "ray", "mark", "plane", "volume", "grid", "eye", "text", "extra", "other",
    "pose",
]  # fmt: skip

PALE = 0.42  # the opacity of hidden dashes


@dataclass(frozen=True, eq=False)
class Segments:
    """Line segments (n, 2, 3).

    layer: higher layers cover lower ones. on_plane: True for a part of the image plane, which then
    does not hide it. dashed: True to dash the segments even if nothing hides them.
    """

    name: str
    role: Role
    segments: Floats
    width: float = 1.5
    opacity: float = 1.0
    hidden: float = PALE
    on_plane: bool = False
    dashed: bool = False
    layer: int = 1


@dataclass(frozen=True, eq=False)
class Face:
    """A filled convex polygon, corners (n, 3)."""

    name: str
    role: Role
    corners: Floats
    opacity: float
    hidden: float = 0.5
    on_plane: bool = False
    layer: int = 0


@dataclass(frozen=True, eq=False)
class Arrow:
    """An arrow from start to end, (3,) each. Its head has a constant size on the screen."""

    name: str
    role: Role
    start: Floats
    end: Floats
    width: float = 3.2
    head: float = 15.0
    dashed: bool = False
    layer: int = 3


@dataclass(frozen=True, eq=False)
class Dot:
    """A round mark."""

    name: str
    role: Role
    point: Floats
    radius: float = 4.5
    on_plane: bool = False
    layer: int = 4
    hidden: float = 0.45


@dataclass(frozen=True, eq=False)
class Eye:
    """The eye: a ball that looks along `gaze`."""

    name: str
    point: Floats
    gaze: Floats
    radius: float = 10.0
    layer: int = 4


@dataclass(frozen=True, eq=False)
class Label:
    """Text next to a point.

    away: a point that the text keeps away from; None to centre it above. strong: True for a letter
    of the formulas. least: the smallest distance of point and `away` on the screen at which the
    text is shown, in units of a line. fixed: True if the text stays on its side of the point, even
    if it covers something there. line: the segment (2, 3) that the text names; the text may be
    anywhere along it. lit: True if a formula highlights its term.
    """

    name: str
    role: Role
    text: str
    point: Floats
    away: Floats | None = None
    strong: bool = False
    least: float = 0.0
    fixed: bool = False
    line: Floats | None = None
    lit: bool = False


Item = Segments | Face | Arrow | Dot | Eye | Label


@dataclass(frozen=True)
class RayEnd:
    """A viewing ray and its end. t: inf if nothing is hit, None if it is not known yet."""

    pixel: Pixel
    t: float | None

    @property
    def is_hit(self) -> bool:
        return self.t is not None and math.isfinite(self.t)

    def t_or(self, end: float) -> float:
        return self.t if self.t is not None and self.is_hit else end


def runs(text: str, strong: bool) -> list[tuple[str, bool]]:
    """Split a label into pieces of one weight, each with True if it is bold. In a formula the
    vectors are bold; otherwise a strong label is bold throughout.
    """
    pieces = re.split(r"vec\((\w+)\)", text)
    whole = strong and len(pieces) == 1
    return [(piece, whole or bool(n % 2)) for n, piece in enumerate(pieces) if piece]


def shares(grown: float, parts: int) -> list[float]:
    """Return the drawn share, 0 to 1, of each part of a drawing that grows part by part."""
    return [min(max(grown - part, 0.0), 1.0) for part in range(parts)]


def named_dot(
    name: str, role: Role, text: str, point: Floats, away: Floats | None, radius: float = 6.0,
    **more: Any,
) -> list[Item]:  # fmt: skip
    """Return a mark, and its name on the side away from `away`. more: fields of the mark."""
    label = Label(name, role, text, point, away=away, strong=True)
    return [Dot(name, role, point, radius, **more), label]


def named_arrow(
    name: str, role: Role, text: str, start: Floats, end: Floats, **more: Any
) -> list[Item]:
    """Return an arrow with its name beyond the tip. more: further fields of the arrow."""
    label = Label(name, role, text, end, away=start, strong=True, least=8.0)
    return [Arrow(name, role, start, end, **more), label]


def term(
    name: str, role: Role, text: str, start: Floats, end: Floats, aside: Floats, lit: bool = False
) -> list[Item]:
    """Return a term of a formula: a thick arrow with a text along it, on the side `aside`."""
    middle, line = (start + end) / 2, np.array([start, end])
    label = Label(name, role, text, middle, middle - aside, strong=True, line=line, lit=lit)
    return [Arrow(name, role, start, end, 4.2, layer=4), label]


def line(
    name: str, role: Role, start: ArrayLike, end: ArrayLike, width: float = 1.5, **look: Any
) -> Segments:
    """Return one segment between two points, (3,) each. look: further fields."""
    return Segments(name, role, np.array([[start, end]]), width, **look)


def polyline(points: Floats, closed: bool = False) -> Floats:
    """Return segments (n, 2, k) through points (m, k)."""
    ends = np.concatenate([points[1:], points[:1]]) if closed else points[1:]
    return np.stack([points[: len(ends)], ends], axis=1)
