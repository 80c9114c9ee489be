"""The tracer's own functions for one ray, run by Python itself: no compilation, any numbers.

For questions about a single pixel: they compute the shading model and the intersections of
renderer/trace, line by line, in float64. The tracer's decorators leave the functions of its kernels
to Python as well. Its modules, and with them its compiler, are loaded on first use of a function.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

_HOME = {
    "hit_sphere": "intersect",
    "normals_at": "shade",
    "albedo_at": "shade",
    "specular_at": "shade",
    "passes": "shade",
    "color_at": "shade",
    "light_at": "shade",
    "reflected_at": "shade",
    "object_of": "shade",
    "point_on": "shade",
    "plus": "vectors",
    "minus": "vectors",
    "times": "vectors",
    "each_times": "vectors",
    "dot": "vectors",
    "length": "vectors",
    "normalized": "vectors",
}


def __getattr__(name: str) -> Callable[..., Any]:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = import_module(f"lucida.renderer.trace.reference.{_HOME[name]}")
    function: Callable[..., Any] = getattr(module, name)
    globals()[name] = function  # later lookups bypass this function
    return function


def load() -> None:
    """Load everything now, in this thread: it takes a fraction of a second."""
    for name in _HOME:
        __getattr__(name)
