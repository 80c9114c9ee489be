"""The pixel probe: everything that happens along the viewing ray of one pixel, as numbers.

formulas.py writes it down; shading.py explains the colour. Pixels are (row, column), 0-based; sizes
are (width, height); all arithmetic is float64, as in the tracer's reference.
"""

from __future__ import annotations

import math

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector, three
from lucida.renderer.camera.image_plane import Size, has_pixel
from lucida.renderer.images.display import encode_srgb
from lucida.renderer.images.frame import check_size
from lucida.renderer.scene.flat import FlatScene, flatten
from lucida.renderer.scene.model import Color, Scene, Sphere
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import pure_python as scalar

from .crossings import NOTHING, Crossings, Index
from .reading import BEHIND, FAR, HIDDEN, NEAR, SEEN, Bounce, Crossing, Meeting, Reading
from .shading import LitTest, Shading, SurfaceHit, hit_at, shade


class Probe:
    """A scene prepared for probing. Create one per scene (off the window's thread if it is large).

    flat: the scene's arrays, if they exist already.
    """

    def __init__(self, scene: Scene, flat: FlatScene | None = None) -> None:
        self.scene = scene
        self.flat = flatten(scene) if flat is None else flat
        self.index = Index(self.flat)
        scalar.load()

    def at(
        self,
        pixel: tuple[int, int],
        camera: Camera,
        size: Size,
        exposure_ev: float = 0.0,
        transfer: str = "srgb",
        shadows: bool = False,
        mirror_depth: int = 0,
    ) -> Reading:
        """Return the reading of one pixel of an image that `camera` draws.

        Meetings are sorted: objects on the ray by t, then objects elsewhere on the line, then
        objects that the line misses, by number.

        transfer: "srgb" or "linear", the conversion from light to display values.
        shadows, mirror_depth: as for the tracer.

        Raises LucidaError if the image has no such pixel.
        """
        check_pixel(pixel, size)
        x, y = camera.image_point(*pixel, size)
        ray = camera.ray(*pixel, size)
        found = NOTHING
        if np.isfinite(ray.direction).all():
            found = self.index.crossings(ray.origin, ray.direction)
        t_range = camera.t_range
        winner = winner_of(found, t_range)
        meetings = self._meetings(found, t_range, winner)
        background = three(self.flat.background)
        hit = shading = None
        bounces: tuple[Bounce, ...] = ()
        color = background
        if winner >= 0:
            hit = hit_at(self.flat, ray.origin, ray.direction, _at(found, winner))
            is_lit = self._lit_test() if shadows else None
            shading = shade(self.flat, hit, is_lit)
            bounces = self._bounces(hit, shading, mirror_depth, is_lit)
            total = np.array(shading.color)
            for bounce in bounces:
                total += np.array(bounce.weight) * bounce.color
            color = three(total)
        exposed = np.array(color) * 2.0**exposure_ev
        display = three(np.clip(exposed, 0, 1) if transfer == "linear" else encode_srgb(exposed))
        return Reading(
            pixel=pixel,
            size=size,
            camera=camera,
            x=float(x),
            y=float(y),
            origin=three(ray.origin),
            direction=three(ray.direction),
            t_range=t_range,
            meetings=meetings,
            hit=hit,
            shading=shading,
            bounces=bounces,
            background=background,
            color=color,
            exposure_ev=exposure_ev,
            exposed=three(exposed),
            transfer=transfer,
            display=display,
            bytes=_bytes(display),
            corners=self._corners(hit),
            sphere=self._sphere(hit),
        )

    def _meetings(
        self, found: Crossings, t_range: tuple[float, float], winner: int
    ) -> tuple[Meeting, ...]:
        by_object: dict[int, list[Crossing]] = {}
        for number in range(len(found.t)):
            crossing = Crossing(*_at(found, number), _standing(found.t[number], t_range))
            if number == winner:
                crossing = crossing._replace(standing=SEEN)
            by_object.setdefault(int(found.object[number]), []).append(crossing)
        meetings = [
            Meeting(
                number,
                entry.name or f"object {number}",
                "sphere" if isinstance(entry.shape, Sphere) else "mesh",
                tuple(by_object.get(number, ())),
            )
            for number, entry in self.scene.visible
        ]
        return tuple(sorted(meetings, key=_place))

    def _corners(self, hit: SurfaceHit | None) -> tuple[Vector, ...]:
        if hit is None or hit.primitive >= len(self.flat.faces):
            return ()
        return tuple(three(self.index.vertices[k]) for k in self.flat.faces[hit.primitive])

    def _sphere(self, hit: SurfaceHit | None) -> tuple[Vector, float] | None:
        if hit is None or hit.primitive < len(self.flat.faces):
            return None
        row = self.flat.spheres[hit.primitive - len(self.flat.faces)]
        return three(row), float(row[3])

    # Shadows and mirrors, as in renderer/trace/tiles/effects.py.

    def _away(self) -> float:
        """Return the distance from a surface at which its rays start, in world units."""
        from lucida.renderer.trace.tiles.effects import effects_of  # slow: compiler

        effects = effects_of(True, 0, self.flat.bounds)
        assert effects is not None
        return float(effects.away)

    def _lit_test(self) -> LitTest:
        away = self._away()

        def is_lit(hit: SurfaceHit, to_light: Vector, reach: float) -> bool:
            geometric, way = np.array(hit.geometric), np.array(to_light)
            if geometric @ way <= 0:
                return False
            origin = hit.point + away * geometric
            limit = reach - away * float(geometric @ way)
            return not self.index.closest(origin, way, 0.0, limit) < math.inf

        return is_lit

    def _bounces(
        self, hit: SurfaceHit, shading: Shading, depth: int, is_lit: LitTest | None
    ) -> tuple[Bounce, ...]:
        bounces: list[Bounce] = []
        away = self._away()
        weight = np.array(shading.specular)
        for _ in range(depth):
            if not weight.max() > 0:
                break
            arriving, geometric = np.array(hit.direction), np.array(hit.geometric)
            way = arriving - 2 * (arriving @ hit.normal) * np.array(hit.normal)
            if way @ geometric <= 0:  # a smooth normal may send a ray into the surface
                way = arriving - 2 * (arriving @ geometric) * geometric
            origin = hit.point + away * geometric
            found = self.index.crossings(origin, way)
            first = winner_of(found, (0.0, math.inf))
            start = three(weight), three(origin), three(way)
            if first < 0:
                bounces.append(Bounce(*start, None, None, three(self.flat.background)))
                break
            hit = hit_at(self.flat, origin, way, _at(found, first))
            shading = shade(self.flat, hit, is_lit)
            bounces.append(Bounce(*start, hit, shading, shading.color))
            weight = weight * shading.specular
        return tuple(bounces)


def check_pixel(pixel: tuple[int, int], size: Size) -> None:
    """Raise LucidaError if an image of (width, height) has no pixel (row, column)."""
    width, height = check_size(size)
    if not has_pixel((width, height), pixel):
        problem = f"row {pixel[0]}, column {pixel[1]} is outside {width}x{height}"
        raise LucidaError("pixel", problem, "give 0 to height - 1 and 0 to width - 1")


def winner_of(found: Crossings, t_range: tuple[float, float]) -> int:
    """Return the number of the first crossing in range, or -1."""
    inside = (found.t > t_range[0]) & (found.t < t_range[1])
    return int(np.argmax(inside)) if inside.any() else -1


def _standing(t: float, t_range: tuple[float, float]) -> str:
    if t <= 0:
        return BEHIND
    if t <= t_range[0]:
        return NEAR
    return FAR if t >= t_range[1] else HIDDEN


def _place(meeting: Meeting) -> tuple[int, float, int]:
    """The key that sorts meetings."""
    nearest = meeting.nearest
    if nearest is None:
        return 2, 0.0, meeting.object
    return (0 if meeting.is_on_ray else 1), nearest.t, meeting.object


def _at(found: Crossings, number: int) -> tuple[float, int, float, float]:
    return (
        float(found.t[number]),
        int(found.primitive[number]),
        float(found.b1[number]),
        float(found.b2[number]),
    )


def _bytes(display: Color) -> tuple[int, int, int]:
    """Round in float32, as the display transform does."""
    r, g, b = (int(np.float32(255) * np.float32(part) + np.float32(0.5)) for part in display)
    return r, g, b
