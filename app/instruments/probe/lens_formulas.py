r"""The path through a lens from a pixel's point to its direction, line by line, with its numbers.

Symbols: (a', b') the pixel's point on the image plane at distance 1, b downwards, and r' its
length; (a, b) the point without distortion; theta the angle to the axis, and (U, V) its parts; (X,
Y, Z) the direction, Z forwards. A prime marks distorted values.
"""

from __future__ import annotations

import numpy as np

from lucida.app.cameras.lens_choices import KINDS
from lucida.app.ui.explaining.notation import (
    Line,
    formula,
    number,
    results,
    scalar_slot,
    vector_slot,
)
from lucida.renderer.camera.lenses import Lens

from .reading import Reading


def _around(a: str, b: str, r: str, theta: str) -> str:
    """Return the direction at an angle theta to the axis, towards (a, b) of length r."""
    return (
        rf"\left(\sin\theta\,\frac{{{a}}}{{{r}}},\ \sin\theta\,\frac{{{b}}}{{{r}}},\ "
        rf"\cos\theta\right),\ \theta = {theta}"
    )


_FISHEYE = _around("U", "V", r"\theta", r"\sqrt{U^2 + V^2}")
_FOV = r"\arctan \frac{\tan(r' \omega)}{2 \tan(\omega / 2)}"
DIRECTIONS = {  # (X, Y, Z) by the lens's model
    "brown": "(a, b, 1)",
    "fisheye": _FISHEYE,
    "thin_prism_fisheye": _FISHEYE,
    "equidistant": _around("a'", "b'", "r'", "r'"),
    "stereographic": _around("a'", "b'", "r'", r"2 \arctan \frac{r'}{2}"),
    "equisolid": _around("a'", "b'", "r'", r"2 \arcsin \frac{r'}{2}"),
    "orthographic": _around("a'", "b'", "r'", r"\arcsin r'"),
    "fov": _around("a'", "b'", "r'", _FOV),
    "equirectangular": r"(\sin a' \cos b',\ \sin b',\ \cos a' \cos b')",
    "cylindrical": r"(\sin a',\ b',\ \cos a')",
}


def lens_lines(reading: Reading) -> list[Line]:
    """Return the lines from the pixel's point (u, v) to its direction, or to the reason that it has
    none.
    """
    camera, lens = reading.camera, reading.camera.lens
    assert lens is not None
    place = reading.x / camera.distance, -reading.y / camera.distance
    d = scalar_slot("d", camera.distance, factor=True)
    slots = {"x": scalar_slot("u", reading.x), "y": scalar_slot("v", reading.y, factor=True)}
    appears = formula(
        "distorted",
        "on the image plane at distance 1, downwards",
        "(a', b')",
        r"\left(\frac{<x>}{<d>},\ -\frac{<y>}{<d>}\right)",
        {**slots, "d": d},
        place,
    )
    lines = [appears, *_distortion(lens)]
    way = [float(part) for part in lens.direction(*place)]
    if not np.isfinite(way).all():
        none = r"\mathbf{d} = \mathrm{none}"
        return [*lines, Line("outside", "outside the lens", none, "")]
    latex = f"(X, Y, Z) = {DIRECTIONS[lens.model]}"
    ideal = Line("ideal", "the direction, Z forwards", latex, f"= {results(way)}", tuple(way))
    slots = {name: vector_slot(name, getattr(camera, name)) for name in ("u", "v", "w")}
    slots |= {
        name: scalar_slot(name, value, factor=True) for name, value in zip("XYZ", way, strict=True)
    }
    direction = formula(
        "direction",
        "direction, world",
        r"\mathbf{d}",
        r"<d>\,(<X>\,<u> - <Y>\,<v> - <Z>\,<w>)",
        {**slots, "d": d},
        reading.direction,
    )
    return [*lines, ideal, direction]


def _distortion(lens: Lens) -> list[Line]:
    """Return the line of the distortion: the model's formula, and its numbers."""
    given = {name: value for name, value in lens.coefficients.items() if value}
    if not given or lens.model == "fov":
        return []
    latex = KINDS[lens.model].latex.split(r",\quad ")[0]
    numbers = r",\ ".join(f"{name[:-1]}_{name[-1]} = {number(v)}" for name, v in given.items())
    return [Line("distortion", "distortion, undone by Newton's method", latex, numbers)]
