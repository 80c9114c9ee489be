"""The likelihood of a reading: what its camera sees of the scene, and where it is. Pure.

A camera that somebody has placed sees its scene, from outside and not from afar, is above the
ground, and has the horizon level. Each of these counts as many points as WEIGHTS says, in full or
in part; a camera that sees nothing gets none for its place. The reading with the most points comes
first. The pictures decide; this only sets the order in which to look at them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.detective.readings import OTHER, Convention, MatrixReading, Up, order_name
from renderer.camera import Floats, Size

WEIGHTS = {"sees": 4.0, "aims": 2.0, "upright": 2.0, "level": 2.0, "above": 1.0, "usual": 0.5}
MOST_POINTS = 2048  # of the scene's points to project
AXIS: dict[Up, int] = {"y": 1, "z": 2}
USUAL_AXES = ("OpenGL", "OpenCV", "")
LEVEL = 0.35  # sine of the largest tilt of an upright horizon


@dataclass(frozen=True, eq=False)
class SceneSeen:
    """The scene to be seen. points: (n, 3) of it. up: the number of its up axis."""

    points: Floats
    up: Up

    @property
    def middle(self) -> Floats:
        middle: Floats = (self.points.min(axis=0) + self.points.max(axis=0)) / 2
        return middle

    @property
    def radius(self) -> float:
        return float(np.linalg.norm(np.ptp(self.points, axis=0))) / 2


@dataclass(frozen=True, eq=False)
class Ranked:
    """A ranked reading. sees: the visible part of the scene, 0 to 1. parts: of each weight,
    0 to 1.
    """

    reading: MatrixReading
    sees: float
    parts: dict[str, float]
    told: str

    @property
    def score(self) -> float:
        return sum(WEIGHTS[name] * part for name, part in self.parts.items())


def sample(points: Floats) -> Floats:
    """Return at most MOST_POINTS of them, from all parts of the scene."""
    step = -(-len(points) // MOST_POINTS) or 1
    return points[::step]


def ranked(found: Sequence[MatrixReading], subject: SceneSeen, size: Size) -> list[Ranked]:
    """Return the readings, best first. size: of their pictures."""
    every = [_ranked(reading, subject, size) for reading in found]
    return sorted(every, key=lambda one: -one.score)


def _ranked(reading: MatrixReading, subject: SceneSeen, size: Size) -> Ranked:
    camera = reading.view.for_size(reading.size or size)
    eye, axis = np.asarray(camera.eye), AXIS[subject.up]
    u, v, w = (np.asarray(one) / np.linalg.norm(one) for one in (camera.u, camera.v, camera.w))
    tilt, upward = float(u[axis]), float(v[axis])
    sees, aims, above, place = 0.0, 0.0, 0.0, ""
    if len(subject.points):
        width, height = reading.size or size
        at = camera.project(subject.points, (width, height))
        inside = at.parameter > 0
        inside &= (at.column >= -0.5) & (at.column <= width - 0.5)
        inside &= (at.row >= -0.5) & (at.row <= height - 0.5)
        sees = float(inside.mean())
        way = subject.middle - eye
        distance = float(np.linalg.norm(way))
        aims = max(0.0, float(-w @ way) / max(distance, 1e-12))
        low = subject.points[:, axis].min()
        above = float(eye[axis] >= low - 0.05 * subject.radius)
        place = _place(distance, subject.radius, bool(above))
    convention = reading.convention
    is_usual = convention.axes in USUAL_AXES and not convention.turned
    stands = float(sees > 0 or not len(subject.points))
    parts = {
        "sees": sees,
        "aims": aims**4,
        "upright": stands * float(upward > 0) * min(1.0, 0.5 + abs(upward)),
        "level": stands * (1.0 - min(1.0, abs(tilt) / 0.5)),
        "above": stands * above,
        "usual": float(is_usual),
    }
    told = f"sees {_seen(sees)}, {_stands(tilt, upward)}{place}" if len(subject.points) else ""
    return Ranked(reading, sees, parts, told)


def _seen(part: float) -> str:
    if part >= 0.995:
        return "all of the scene"
    if part <= 0.005:
        return "nothing of the scene"
    return f"{100 * part:.0f} % of the scene"


def _stands(tilt: float, upward: float) -> str:
    if abs(tilt) > LEVEL:
        return "tilted" if upward > 0.5 else "on its side" if upward > -0.5 else "upside down"
    return "upright" if upward > 0 else "upside down"


def _place(distance: float, radius: float, is_above: bool) -> str:
    if distance > 30 * max(radius, 1e-12):
        return ", from far away"
    return "" if is_above else ", from below"


# In words.


def title(convention: Convention, up: Up, is_mixed: bool) -> str:
    """Return a few words that distinguish readings of one matrix. is_mixed: some are by rows,
    others by columns.
    """
    words: list[str] = [convention.way, convention.axes]
    words += [order_name(convention.columns)] * is_mixed
    words += [f"{OTHER[up]} up"] * convention.turned + ["y down"] * convention.flipped
    return ", ".join(word for word in words if word)


def name(convention: Convention, up: Up) -> str:
    """Return the complete name of a reading."""
    words: list[str] = [convention.way, order_name(convention.columns)]
    if convention.axes:
        words.append(f"{convention.axes} axes")
    elif convention.way == "clip from world":
        words.append("y down in the image" if convention.flipped else "y up in the image")
    if convention.turned:
        words.append(f"in a world with {OTHER[up]} up")
    return ", ".join(words)


def sentence(one: Ranked, up: Up) -> str:
    """Return a sentence on the reading: what it is, the same camera by other names, and what it
    sees.
    """
    told = name(one.reading.convention, up)
    if one.reading.also:
        told += "; the same camera: " + "; ".join(name(also, up) for also in one.reading.also)
    return f"{told}: {one.told}" if one.told else told
