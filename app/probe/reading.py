"""The probe's reading of a pixel: plain values, computed once and shown in many ways."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from app.explaining.shading import Shading, SurfaceHit
from renderer.camera import Camera, Size, Vector
from renderer.scene.model import Color

# How a crossing stands to the pixel.
SEEN = "seen"  # the nearest within the ray: the winner
HIDDEN = "hidden"  # farther than the winner
BEHIND = "behind"  # t <= 0: not on the ray
NEAR, FAR = "before near", "beyond far"  # cut off by the camera's clip planes


class Crossing(NamedTuple):
    """One of the places where the ray's line meets an object; standing: one of the above."""

    t: float
    primitive: int
    b1: float
    b2: float
    standing: str


@dataclass(frozen=True)
class Meeting:
    """An object of the scene and the crossings of the ray's line with it, sorted by t.

    crossings is empty where the line passes the object by.
    """

    object: int
    name: str
    kind: str
    crossings: tuple[Crossing, ...]

    @property
    def nearest(self) -> Crossing | None:
        """The object's nearest crossing on the ray, else the one nearest to being on it."""
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
    """One mirrored ray. weight: what of its light arrives at the pixel, per channel.

    hit, shading: None where it leaves the scene. color: the light that it brings, unweighted.
    """

    weight: Color
    origin: Vector
    direction: Vector
    hit: SurfaceHit | None
    shading: Shading | None
    color: Color


@dataclass(frozen=True, eq=False)
class Reading:
    """All that the probe knows of a pixel.

    x, y: the lecture's u and v, in units of the basis vectors. origin, direction: the viewing ray,
    world space. t_range: which t count. meetings: sorted, see Probe.at. hit, shading: None for the
    background. color: linear light; exposed, display: after the exposure and after the curve,
    0..1; bytes: 0..255. corners: the seen triangle's, else (). sphere: the seen sphere's centre
    and radius.
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
