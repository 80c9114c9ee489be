"""The ways to rasterize a lens, which has no projection matrix. Quick to import."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from renderer.errors import LucidaError

Method = Literal["lookup", "resampled", "vertices"]
METHODS: tuple[Method, ...] = get_args(Method)
ENLARGEMENTS = (1, 2, 4)
MOST_SPLITTING = 4
SPHERE_SPLITTING = 2  # of an octahedron, beside that of the drawing


@dataclass(frozen=True)
class LensDrawing:
    """A way to rasterize the image of a camera with a lens.

    method: "lookup": each pixel looks up the primitive in a pinhole image, and is shaded from its
    own ray. "resampled": the finished pinhole image is warped. "vertices": each vertex is moved to
    where the lens shows it, and triangles stay straight. enlargement: texels of the looked-up image
    per pixel, along a side. splitting: each triangle becomes 4^splitting before its vertices are
    moved. Raises LucidaError.
    """

    method: Method = "lookup"
    enlargement: int = 2
    splitting: int = 0

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            problem, remedy = f"{self.method!r} is unknown", f"give one of {', '.join(METHODS)}"
            raise LucidaError("lens_drawing.method", problem, remedy)
        if self.enlargement not in ENLARGEMENTS:
            problem = f"{self.enlargement!r} is not 1, 2 or 4"
            raise LucidaError("lens_drawing.enlargement", problem, "give 1, 2 or 4")
        if self.splitting not in range(MOST_SPLITTING + 1):
            problem = f"{self.splitting!r} is not a whole number from 0 to {MOST_SPLITTING}"
            raise LucidaError("lens_drawing.splitting", problem, "give e.g. 2")

    def __str__(self) -> str:
        if self.method == "lookup":
            return f"looked up, {self.enlargement} x {self.enlargement} texels per pixel"
        if self.method == "resampled":
            return "resampled"
        return "moved vertices" + (f", split in {4**self.splitting}" if self.splitting else "")


def pieces_drawn(triangles: int, spheres: int, splitting: int) -> int:
    """Return how many triangles a scene is split into. A sphere is a split octahedron."""
    return 4**splitting * (triangles + 8 * 4**SPHERE_SPLITTING * spheres)
