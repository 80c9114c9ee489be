"""The tracer's own functions for one ray, run by Python itself: no compilation, any numbers.

Owns how a compiled function becomes a plain one. For whoever asks about a single pixel: what is
computed is the shading model and the intersections of renderer/trace, line by line, in float64.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from renderer.trace import intersect, shade, vectors


@cache
def _plain(compiled: Any) -> Callable[..., Any]:
    """The Python function behind a compiled one, calling only such functions itself."""
    source = compiled.py_func
    names = {
        name: _plain(value) if hasattr(value, "py_func") else value
        for name in source.__code__.co_names
        if (value := source.__globals__.get(name)) is not None
    }
    names["__builtins__"] = source.__globals__["__builtins__"]
    return FunctionType(source.__code__, names, source.__name__, source.__defaults__)


sheared_ray = _plain(intersect.sheared_ray)
hit_triangle = _plain(intersect.hit_triangle)
hit_sphere = _plain(intersect.hit_sphere)
normals_at = _plain(shade.normals_at)
albedo_at = _plain(shade.albedo_at)
color_at = _plain(shade.color_at)
object_of = _plain(shade.object_of)
point_on = _plain(shade.point_on)
plus = _plain(vectors.plus)
minus = _plain(vectors.minus)
times = _plain(vectors.times)
each_times = _plain(vectors.each_times)
dot = _plain(vectors.dot)
length = _plain(vectors.length)
normalized = _plain(vectors.normalized)
