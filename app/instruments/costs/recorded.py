"""The steps of the lecture's two loops, counted for images of a torus.

The rays used a binary tree of boxes.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

Unit = Literal["triangles", "pixels"]


class Cost(NamedTuple):
    """The cost of one image.

    Object order sets up each triangle, and tests the pixels of its bounding box (tested). Image
    order traces a ray through each pixel, which visits nodes of the tree (nodes, of all rays).
    """

    triangles: int
    pixels: int
    tested: int
    nodes: int


COSTS: dict[Unit, tuple[Cost, ...]] = {
    "triangles": (
        Cost(100, 76_800, 168_874, 522_661),
        Cost(624, 76_800, 187_571, 762_432),
        Cost(3_968, 76_800, 188_535, 932_716),
        Cost(25_122, 76_800, 187_676, 1_050_752),
        Cost(158_404, 76_800, 187_956, 1_171_755),
        Cost(1_000_000, 76_800, 188_167, 1_306_408),
    ),
    "pixels": (
        Cost(10_000, 1_200, 2_954, 15_395),
        Cost(10_000, 4_800, 11_700, 62_163),
        Cost(10_000, 19_200, 46_953, 246_662),
        Cost(10_000, 76_800, 187_625, 986_012),
        Cost(10_000, 307_200, 751_506, 3_950_083),
        Cost(10_000, 1_228_800, 3_005_177, 15_789_944),
    ),
}
GROWTH: dict[Unit, tuple[str, str]] = {  # for object order, and for image order
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
