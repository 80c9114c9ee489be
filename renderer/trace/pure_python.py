"""The tracer's own functions for one ray, run by Python itself, without compilation.

They compute the shading model and the intersections of renderer/trace for a single pixel, line by
line, in float64. The tracer's decorators keep the Python versions of its kernels' functions. Its
modules, and with them the compiler, are loaded on first use of a function.
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
    """Load everything now, on this thread, which takes a fraction of a second."""
    for name in _HOME:
        __getattr__(name)
