"""Recorded costs of images of a torus: the steps of both loops, and the times of both renderers.

The steps were counted, in the lecture's two loops with a binary tree of boxes for the rays. The
times are the least of many, on 2 cores, with OpenGL in software.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

Unit = Literal["triangles", "pixels"]


class Cost(NamedTuple):
    """The cost of one image.

    Object order sets up each triangle, and tests the pixels of its bounding box (tested). Image
    order traces a ray through each pixel, which visits nodes of the tree (nodes, of all rays).
    raster_ms, ray_ms: the renderers' times, milliseconds.
    """

    triangles: int
    pixels: int
    tested: int
    nodes: int
    raster_ms: float
    ray_ms: float


COSTS: dict[Unit, tuple[Cost, ...]] = {
    "triangles": (
        Cost(100, 76_800, 168_874, 522_661, 4.627, 0.671),
        Cost(624, 76_800, 187_571, 762_432, 5.361, 0.817),
        Cost(3_968, 76_800, 188_535, 932_716, 6.464, 1.163),
        Cost(25_122, 76_800, 187_676, 1_050_752, 12.387, 1.344),
        Cost(158_404, 76_800, 187_956, 1_171_755, 39.242, 4.176),
        Cost(1_000_000, 76_800, 188_167, 1_306_408, 180.499, 12.824),
    ),
    "pixels": (
        Cost(10_000, 1_200, 2_954, 15_395, 2.081, 0.445),
        Cost(10_000, 4_800, 11_700, 62_163, 2.835, 0.552),
        Cost(10_000, 19_200, 46_953, 246_662, 4.904, 0.704),
        Cost(10_000, 76_800, 187_625, 986_012, 12.123, 1.419),
        Cost(10_000, 307_200, 751_506, 3_950_083, 60.838, 3.365),
        Cost(10_000, 1_228_800, 3_005_177, 15_789_944, 344.320, 18.773),
    ),
}
GROWTH: dict[Unit, tuple[str, str]] = {  # object order's, image order's
    "triangles": (
        "Object order: triangles set up ~ triangles; pixels tested: the same.",
        "Image order: rays: the same; nodes visited ~ log triangles"
        " (+0.7 for each ray, with twice the triangles).",
    ),
    "pixels": (
        "Object order: triangles set up: the same; pixels tested ~ pixels.",
        "Image order: rays ~ pixels; nodes visited ~ pixels.",
    ),
}
EXPLAINED = (
    "The times were recorded on 2 cores, with OpenGL in software. The steps were counted in the"
    " lecture's two loops, with a tree of boxes for the rays: they are the same on every machine."
    " Where times are flat, they are what every image costs."
)
