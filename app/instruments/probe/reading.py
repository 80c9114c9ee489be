"""The probe's reading of a pixel: plain values, computed once and shown in many ways."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.model import Color

from .shading import Shading, SurfaceHit

# The relation of a crossing to the pixel.
SEEN = "seen"  # the nearest on the ray: the winner
HIDDEN = "hidden"  # farther than the winner
BEHIND = "behind"  # t <= 0: not on the ray
NEAR, FAR = "before near", "beyond far"  # cut off by the camera's clip planes

OUTSIDE = "Outside the lens: no direction appears at this pixel."


class Crossing(NamedTuple):
    """A point where the ray's line crosses an object. standing: one of the above."""

    t: float
    primitive: int
    b1: float
    b2: float
    standing: str


@dataclass(frozen=True)
class Meeting:
    """An object of the scene and the crossings of the ray's line with it, sorted by t.

    crossings is empty if the line misses the object.
    """

    object: int
    name: str
    kind: str
    crossings: tuple[Crossing, ...]

    @property
    def nearest(self) -> Crossing | None:
        """The object's nearest crossing on the ray, or else the one closest to being on it."""
        for wanted in ((SEEN, HIDDEN), (FAR,)):
            for crossing in self.crossings:
                if crossing.standing in wanted:
                    return crossing
        return self.crossings[-1] if self.crossings else None

    @property
    def is_on_ray(self) -> bool:
        return self.nearest is not None and self.nearest.standing in (SEEN, HIDDEN)


@dataclass(frozen=True)
class Bounce:
    """One mirrored ray.

    weight: the part of its light that arrives at the pixel, per channel.
    hit, shading: None if it escapes.
    color: its light, unweighted.
    """

    weight: Color
    origin: Vector
    direction: Vector
    hit: SurfaceHit | None
    shading: Shading | None
    color: Color


@dataclass(frozen=True, eq=False)
class Reading:
    """Everything that the probe knows about a pixel.

    x, y: the lecture's u and v, in units of the basis vectors.
    origin, direction: the viewing ray, world space; a direction of NaN outside the lens.
    t_range: the valid range of t.
    meetings: sorted, see Probe.at.
    hit, shading: None for the background.
    color: linear light; exposed, display: after the exposure and after the curve, 0..1; bytes:
    0..255.
    corners: those of the visible triangle, else ().
    sphere: the visible sphere's centre and radius.
    """

    pixel: tuple[int, int]
    size: Size
    camera: Camera
    x: float
    y: float
    origin: Vector
    direction: Vector
    t_range: tuple[float, float]
    meetings: tuple[Meeting, ...]
    hit: SurfaceHit | None
    shading: Shading | None
    bounces: tuple[Bounce, ...]
    background: Color
    color: Color
    exposure_ev: float
    exposed: Color
    transfer: str
    display: Color
    bytes: tuple[int, int, int]
    corners: tuple[Vector, ...]
    sphere: tuple[Vector, float] | None

    @property
    def is_outside(self) -> bool:
        """True if the pixel is outside the lens."""
        return math.isnan(self.direction[0])
