r"""The way through a lens from a pixel's point to its direction, line by line, with its numbers.

Symbols: (a', b') where the pixel is on the image plane at distance 1, b downwards; (a, b) where it
would be without distortion, r' its length; theta the angle to the axis, and (U, V) its parts; (X,
Y, Z) the direction, Z forwards. The prime is what is distorted.
"""

from __future__ import annotations

import numpy as np

from lucida.app.cameras.lens_choices import KINDS
from lucida.app.instruments.probe.reading import Reading
from lucida.app.ui.explaining.notation import (
    Line,
    formula,
    number,
    results,
    scalar_slot,
    vector_slot,
)
from lucida.renderer.camera.lenses import Lens


def _around(a: str, b: str, r: str, theta: str, theta_text: str) -> tuple[str, str]:
    """Return the direction at an angle theta to the axis, towards (a, b) of length r."""
    r_text = r.removeprefix("\\")
    return (
        rf"\left(\sin\theta\,\frac{{{a}}}{{{r}}},\ \sin\theta\,\frac{{{b}}}{{{r}}},\ "
        rf"\cos\theta\right),\ \theta = {theta}",
        f"(sin(theta) {a} / {r_text}, sin(theta) {b} / {r_text}, cos(theta)), theta = {theta_text}",
    )


_FISHEYE = _around("U", "V", r"\theta", r"\sqrt{U^2 + V^2}", "sqrt(U^2 + V^2)")
# (X, Y, Z) by the lens's model: as LaTeX and as text.
DIRECTIONS = {
    "brown": ("(a, b, 1)", "(a, b, 1)"),
    "fisheye": _FISHEYE,
    "thin_prism_fisheye": _FISHEYE,
    "equidistant": _around("a'", "b'", "r'", "r'", "r'"),
    "stereographic": _around("a'", "b'", "r'", r"2 \arctan \frac{r'}{2}", "2 atan(r' / 2)"),
    "equisolid": _around("a'", "b'", "r'", r"2 \arcsin \frac{r'}{2}", "2 asin(r' / 2)"),
    "orthographic": _around("a'", "b'", "r'", r"\arcsin r'", "asin(r')"),
    "fov": _around(
        "a'",
        "b'",
        "r'",
        r"\arctan \frac{\tan(r' \omega)}{2 \tan(\omega / 2)}",
        "atan(tan(r' omega) / (2 tan(omega / 2)))",
    ),
    "equirectangular": (
        r"(\sin a' \cos b',\ \sin b',\ \cos a' \cos b')",
        "(sin a' cos b', sin b', cos a' cos b')",
    ),
    "cylindrical": (r"(\sin a',\ b',\ \cos a')", "(sin a', b', cos a')"),
}


def lens_lines(reading: Reading) -> list[Line]:
    """Return the lines from the pixel's point (u, v) to its direction, or to why it has none."""
    camera, lens = reading.camera, reading.camera.lens
    assert lens is not None
    place = reading.x / camera.distance, -reading.y / camera.distance
    d = scalar_slot("d", camera.distance, factor=True)
    slots = {"x": scalar_slot("u", reading.x), "y": scalar_slot("v", reading.y, factor=True)}
    appears = formula(
        "distorted",
        "on the image plane at distance 1, downwards",
        ("(a', b')", "(a', b')"),
        (r"\left(\frac{<x>}{<d>},\ -\frac{<y>}{<d>}\right)", "(<x> / <d>, -<y> / <d>)"),
        {**slots, "d": d},
        place,
    )
    lines = [appears, *_distortion(lens)]
    way = [float(part) for part in lens.direction(*place)]
    if not np.isfinite(way).all():
        latex, text = r"\mathbf{d} = \mathrm{none}", "vec(d) = none"
        return [*lines, Line("outside", "outside of the lens", latex, "", text, "")]
    latex, text = DIRECTIONS[lens.model]
    values, values_text = results(tuple(way))
    ideal = Line(
        "ideal", "the direction, Z forwards",
        f"(X, Y, Z) = {latex}", f"= {values}", f"(X, Y, Z) = {text}", f"= {values_text}",
        tuple(way),
    )  # fmt: skip
    slots = {name: vector_slot(name, getattr(camera, name)) for name in ("u", "v", "w")}
    slots |= {
        name: scalar_slot(name, value, factor=True) for name, value in zip("XYZ", way, strict=True)
    }
    direction = formula(
        "direction",
        "direction, world",
        (r"\mathbf{d}", "vec(d)"),
        (
            r"<d>\,(<X>\,<u> - <Y>\,<v> - <Z>\,<w>)",
            "<d> (<X> <u> - <Y> <v> - <Z> <w>)",
        ),
        {**slots, "d": d},
        reading.direction,
    )
    return [*lines, ideal, direction]


def _distortion(lens: Lens) -> list[Line]:
    """Return the line of what Newton's method undoes: the model's formula, and its numbers."""
    given = {name: value for name, value in lens.coefficients.items() if value}
    if not given or lens.model == "fov":
        return []
    kind = KINDS[lens.model]
    latex, text = kind.latex.split(r",\quad ")[0], kind.text.split(", ")[0]
    in_latex = r",\ ".join(f"{name[:-1]}_{name[-1]} = {number(v)}" for name, v in given.items())
    in_text = ", ".join(f"{name} = {number(value)}" for name, value in given.items())
    name = "distortion, undone by Newton's method"
    return [Line("distortion", name, latex, in_latex, text, in_text)]
