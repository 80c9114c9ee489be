"""Checks of a camera's numbers, with one-line error messages."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.system.errors import LucidaError

Vector = tuple[float, float, float]
Floats = NDArray[np.float64]

PROJECTIONS = ("perspective", "parallel")
SINGULAR = 1e-9  # unit vectors that span less volume have no usable inverse
SMALLEST, LARGEST = 1e-12, 1e12  # lengths and coordinates that float32 can still square


def volume(u: ArrayLike, v: ArrayLike, w: ArrayLike) -> float:
    """Return the volume that three vectors span: the determinant, negative if left-handed.

    The triple product is used because LAPACK's determinant warns of a division by zero for denormal
    numbers.
    """
    across, up, back = (np.asarray(vector, float).tolist() for vector in (u, v, w))
    return dot(cross(across, up), back)


# Plain Python, because it is faster than NumPy for 3-vectors, and each new camera is checked.


def three(values: ArrayLike) -> Vector:
    """Return the first three of some numbers as floats."""
    x, y, z = np.asarray(values, float)[:3].tolist()
    return x, y, z


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def number(name: str, value: object) -> float:
    """Return a finite Python or NumPy number as a float. Text is rejected, even "1".

    Raises LucidaError naming `name`.
    """
    try:
        if isinstance(value, str | bytes | bool | np.bool_):
            raise TypeError
        number = float(value)  # type: ignore[arg-type]
    except OverflowError:  # an int with hundreds of digits
        raise LucidaError(name, f"{value} is too large", f"stay within {LARGEST:g}") from None
    except (TypeError, ValueError):
        raise LucidaError(name, f"{value!r} is not a number", "give a finite number") from None
    if not math.isfinite(number):
        raise LucidaError(name, f"{number} is not finite", "give a finite number")
    if abs(number) > LARGEST:
        raise LucidaError(name, f"{number:g} is too large", f"stay within {LARGEST:g}")
    return number


def numbers(name: str, value: object, count: int) -> tuple[float, ...]:
    if type(value) is tuple and len(value) == count:  # a file may hold 100,000 cameras
        for item in value:
            if type(item) is not float or not -LARGEST <= item <= LARGEST:
                break
        else:
            return value
    items: tuple[object, ...]
    try:
        items = tuple(value)  # type: ignore[arg-type]
    except TypeError:
        items = ()
    if isinstance(value, str) or len(items) != count:
        raise LucidaError(name, f"{value!r} is not {count} numbers", f"give {count} numbers")
    return tuple(number(name, item) for item in items)


def positive(name: str, value: object, example: object) -> float:
    """Return a number that is at least SMALLEST. example: for the remedy."""
    found = number(name, value)
    if not found >= SMALLEST:
        limit = "0" if found <= 0 else f"{SMALLEST:g}"
        raise LucidaError(name, f"{found:g} is not above {limit}", f"give e.g. {example}")
    return found


def listed(vector: Iterable[float]) -> str:
    return "(" + ", ".join(f"{x:g}" for x in vector) + ")"


def arrays_text(named: Any) -> str:
    """Return a short repr of a named tuple of arrays: numbers, vectors, and others' shapes."""

    def part(value: Any) -> str:
        array = np.asarray(value)
        if array.ndim == 0:
            return f"{array[()]:g}"
        return listed(array) if array.shape == (3,) else f"<array {array.shape}>"

    parts = (f"{name}={part(getattr(named, name))}" for name in named._fields)
    return f"{type(named).__name__}({', '.join(parts)})"


def check_projection(projection: object) -> None:
    if projection not in PROJECTIONS:
        remedy = "give 'perspective' or 'parallel'"
        raise LucidaError("projection", f"{projection!r} is unknown", remedy)


def check_basis(u: Vector, v: Vector, w: Vector) -> None:
    # Fast path: most bases are far from singular.
    a, b, c = math.hypot(*u), math.hypot(*v), math.hypot(*w)
    if min(a, b, c) >= SMALLEST and abs(dot(cross(u, v), w)) > 2 * SINGULAR * a * b * c:
        return
    vectors = {"u": u, "v": v, "w": w}
    lengths = {name: math.hypot(*vector) for name, vector in vectors.items()}
    for name, vector in vectors.items():
        if not lengths[name] >= SMALLEST:
            others = " and ".join(other for other in vectors if other != name)
            raise LucidaError(
                name,
                f"{listed(vector)} is not independent of {others}",
                f"give {name} a part outside their plane",
            )
    unit = {name: [x / lengths[name] for x in vector] for name, vector in vectors.items()}
    if abs(volume(*unit.values())) > SINGULAR:
        return
    for first, second in (("u", "v"), ("u", "w"), ("v", "w")):
        if math.hypot(*cross(unit[first], unit[second])) <= math.sqrt(SINGULAR):
            raise LucidaError(
                second,
                f"{listed(vectors[second])} is parallel to {first} = {listed(vectors[first])}",
                f"turn {second} away from {first}",
            )
    raise LucidaError(
        "w",
        f"{listed(w)} lies in the plane of u = {listed(u)} and v = {listed(v)}",
        "give w a part outside their plane",
    )


def check_viewport(viewport: tuple[float, float, float, float]) -> None:
    left, right, bottom, top = viewport
    smallest = 1e-9 * max(SMALLEST, *map(abs, viewport))
    for low, high, names in ((left, right, "left < right"), (bottom, top, "bottom < top")):
        if not high - low > smallest:
            raise LucidaError(
                "viewport",
                f"{listed(viewport)} is empty",
                f"give left, right, bottom, top, {names}",
            )


def check_clip(near: float | None, far: float | None) -> None:
    if near is not None:
        positive("near", near, "0.1, or leave it out")
    if far is not None and not far > (near or 0.0):
        limit = "0" if near is None else f"near = {near:g}"
        raise LucidaError("far", f"{far:g} is not above {limit}", "give a larger far")


def checked_aspect(size: Iterable[float]) -> float:
    """Return the width over the height of a size. Raises LucidaError for an invalid one."""
    try:
        width, height = (positive("size", side, 720) for side in size)
    except (TypeError, ValueError):  # LucidaError is a ValueError
        problem = f"{size!r} is not a width and a height"
        raise LucidaError("size", problem, "give e.g. (1280, 720)") from None
    return width / height
