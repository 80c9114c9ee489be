r"""The way through a lens from a pixel's point to its direction, line by line, with its numbers.

Symbols: (a', b') where the pixel is on the image plane at distance 1, b downwards; (a, b) where it
would be without distortion, the ideal point; r, r' their lengths; theta the angle to the axis, and
(U, V) its parts; (X, Y, Z) the direction, Z forwards. The prime is what is distorted.
"""

from __future__ import annotations

import numpy as np

from lucida.app.cameras.lens_choices import KINDS
from lucida.app.instruments.probe.reading import Reading
from lucida.app.ui.explaining.notation import (
    Line,
    Slot,
    formula,
    number,
    results,
    scalar_slot,
    vector_slot,
)
from lucida.renderer.camera.lenses import Lens

# The angle of an ideal fisheye's radius r': as LaTeX and as text.
ANGLES = {
    "equidistant": ("r'", "r'"),
    "stereographic": (r"2 \arctan \frac{r'}{2}", "2 atan(r' / 2)"),
    "equisolid": (r"2 \arcsin \frac{r'}{2}", "2 asin(r' / 2)"),
    "orthographic": (r"\arcsin r'", "asin(r')"),
    "fov": (
        r"\arctan \frac{\tan(r' \omega)}{2 \tan(\omega / 2)}",
        "atan(tan(r' omega) / (2 tan(omega / 2)))",
    ),
}
PANORAMAS = {
    "equirectangular": (
        r"(\sin a' \cos b',\ \sin b',\ \cos a' \cos b')",
        "(sin a' cos b', sin b', cos a' cos b')",
    ),
    "cylindrical": (r"(\sin a',\ b',\ \cos a')", "(sin a', b', cos a')"),
}
THETA = r"\theta", "theta"


def lens_lines(reading: Reading) -> list[Line]:
    """Return the lines from the pixel's point (u, v) to its direction, or to why it has none."""
    lens = reading.camera.lens
    assert lens is not None
    distance = reading.camera.distance
    place = reading.x / distance, -reading.y / distance
    slots = {
        "x": scalar_slot("u", reading.x),
        "y": scalar_slot("v", reading.y, factor=True),
        "d": scalar_slot("d", distance, factor=True),
    }
    appears = formula(
        "distorted",
        "on the image plane at distance 1, downwards",
        ("(a', b')", "(a', b')"),
        (r"\left(\frac{<x>}{<d>},\ -\frac{<y>}{<d>}\right)", "(<x> / <d>, -<y> / <d>)"),
        slots,
        place,
    )
    left, right, _, _ = reading.camera.viewport
    px = distance * reading.size[0] / (right - left)
    lines = [appears, *_steps(lens, *place, px)]
    way = [float(part) for part in lens.direction(*place)]
    if not np.isfinite(way).all():
        text = r"\mathbf{d} = \mathrm{none}", "vec(d) = none"
        return [*lines, Line("outside", "outside of the lens", text[0], "", text[1], "")]
    return [*lines, *_direction(lens, reading, place, way)]


def _steps(lens: Lens, a: float, b: float, px: float) -> list[Line]:
    """Return the distortion, and Newton's steps that undo it for (a', b'). px: pixels per unit."""
    given = {name: value for name, value in lens.coefficients.items() if value}
    if not given or lens.model == "fov":
        return []
    kind = KINDS[lens.model]
    values = [(f"{name[:-1]}_{name[-1]}", name, number(value)) for name, value in given.items()]
    in_latex = r",\ ".join(f"{letter} = {value}" for letter, _, value in values)
    in_text = ", ".join(f"{name} = {value}" for _, name, value in values)
    (latex, *_), (text, *_) = kind.latex.split(r",\quad "), kind.text.split(", ")
    lines = [Line("distortion", "distortion", latex, in_latex, text, in_text)]
    u, v = ("a", "b") if lens.model == "brown" else ("U", "V")
    for count, (x, y, error) in enumerate(lens.inverse_steps(a, b)):
        symbol = f"({u}_{count}, {v}_{count})"
        if count == 0 and (x, y) == (a, b):  # it begins at the distorted point
            symbol += " = (a', b')"
        name = f"Newton's method, step {count}" if count else "Newton's method begins"
        step = float(x), float(y)
        key, off = f"step {count}", f"{px * error:.2g} pixels off"
        lines.append(_result(key, f"{name}: {off}", (symbol, symbol), ("", ""), step))
    return lines


def _direction(
    lens: Lens, reading: Reading, place: tuple[float, float], way: list[float]
) -> list[Line]:
    """Return the lines from the ideal plane to the direction, in the camera and in the world."""
    brown = lens.model == "brown"
    lines: list[Line] = []
    if brown:
        ideal = (way[0], way[1])
        lines.append(_result("ideal", "the ideal point", ("(a, b)", "(a, b)"), ("", ""), ideal))
    else:
        lines += _angle(lens, place, way)
    symbols = ("d a", "-d b", "-d") if brown else ("d X", "-d Y", "-d Z")
    own = np.array([way[0], -way[1], -way[2]]) * reading.camera.distance
    in_camera = r"({},\ {},\ {})".format(*symbols), "({}, {}, {})".format(*symbols)
    left = r"\mathbf{d}_{uvw}", "vec(d)_uvw"
    lines.append(formula("camera direction", "direction, camera", left, in_camera, {}, own))
    slots: dict[str, Slot] = {
        **{name: vector_slot(name, getattr(reading.camera, name)) for name in ("u", "v", "w")},
        "d": scalar_slot("d", reading.camera.distance, factor=True),
        "a": scalar_slot("a" if brown else "X", way[0], factor=True),
        "b": scalar_slot("b" if brown else "Y", way[1], factor=True),
        "c": scalar_slot("Z", way[2], factor=True),
    }
    back = ("<w>", "<w>") if brown else (r"<c>\,<w>", "<c> <w>")
    right = (
        rf"<d>\,(<a>\,<u> - <b>\,<v> - {back[0]})",
        f"<d> (<a> <u> - <b> <v> - {back[1]})",
    )
    d = r"\mathbf{d}", "vec(d)"
    lines.append(formula("direction", "direction, world", d, right, slots, reading.direction))
    return lines


def _angle(lens: Lens, place: tuple[float, float], way: list[float]) -> list[Line]:
    """Return the lines for the angle to the axis, if there is one, and for (X, Y, Z)."""
    xyz = ("(X, Y, Z)", "(X, Y, Z)")
    name = "the direction, of length 1"
    if lens.model in PANORAMAS:
        name = name if lens.model == "equirectangular" else "the direction, to the cylinder"
        return [_result("ideal", name, xyz, PANORAMAS[lens.model], way)]
    angle = float(np.arctan2(np.hypot(way[0], way[1]), way[2]))
    radius = float(np.hypot(*place))
    lines = []
    shares = (r"\frac{a'}{r'}", "a' / r'"), (r"\frac{b'}{r'}", "b' / r'")
    if lens.model in ANGLES:
        length = (r"\sqrt{a'^2 + b'^2}", "sqrt(a'^2 + b'^2)")
        lines += [
            _result("radius", "from the middle", ("r'", "r'"), length, (radius,)),
            _result("angle", "angle to the axis", THETA, ANGLES[lens.model], (angle,)),
        ]
    else:
        u, v = ("U", "V") if any(lens.coefficients.values()) else ("a'", "b'")
        shares = (
            (rf"\frac{{{u}}}{{\theta}}", f"{u} / theta"),
            (rf"\frac{{{v}}}{{\theta}}", f"{v} / theta"),
        )
        length = (rf"\sqrt{{{u}^2 + {v}^2}}", f"sqrt({u}^2 + {v}^2)")
        lines.append(_result("angle", "angle to the axis", THETA, length, (angle,)))
    (x, x_text), (y, y_text) = shares
    right = (
        rf"\left(\sin\theta\,{x},\ \sin\theta\,{y},\ \cos\theta\right)",
        f"(sin(theta) {x_text}, sin(theta) {y_text}, cos(theta))",
    )
    return [*lines, _result("ideal", name, xyz, right, way)]


def _result(
    key: str, name: str, left: tuple[str, str], right: tuple[str, str], value: object
) -> Line:
    """Return a line that shows only its result in numbers."""
    values = tuple(float(part) for part in np.atleast_1d(np.asarray(value, float)))
    latex, text = results(values)
    if not right[0]:
        return Line(key, name, f"{left[0]} = {latex}", "", f"{left[1]} = {text}", "", values)
    return Line(
        key, name, f"{left[0]} = {right[0]}", f"= {latex}", f"{left[1]} = {right[1]}", f"= {text}",
        values,
    )  # fmt: skip
