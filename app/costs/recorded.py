"""A recorded measurement, so that a class sees both curves at once: of 76,800 pixels."""

from __future__ import annotations

from app.costs.model import RENDERERS, Case, Sample
from app.costs.work import Work

MACHINE = "The times were recorded on 2 cores, with OpenGL in software."
PIXELS = 76_800

_COUNTED = (  # triangles as asked for, their number; pixels tested, nodes, tests
    (100, 100, 168874, 522661, 398811),
    (631, 624, 187571, 762432, 379719),
    (3981, 3968, 188535, 932716, 363860),
    (25119, 25122, 187676, 1050752, 341490),
    (158489, 158404, 187956, 1171755, 329002),
    (1000000, 1000000, 188167, 1306408, 322934),
)
_TIMES_MS = (  # of the raster and the ray image
    (4.627, 0.671),
    (5.361, 0.817),
    (6.464, 1.163),
    (12.387, 1.344),
    (39.242, 4.176),
    (180.499, 12.824),
)

WORK = tuple(
    Work(count, PIXELS, count, tested, PIXELS, nodes, tests)
    for _, count, tested, nodes, tests in _COUNTED
)
SAMPLES = tuple(
    Sample(Case(renderer, asked, PIXELS), count, PIXELS, time_ms / 1e3)
    for (asked, count, *_), times in zip(_COUNTED, _TIMES_MS, strict=True)
    for renderer, time_ms in zip(RENDERERS, times, strict=True)
)
