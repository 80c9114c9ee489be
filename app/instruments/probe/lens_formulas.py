r"""The way through a lens from a pixel's point to its direction, line by line, with its numbers.

Symbols: (a', b') where the pixel is on the image plane at distance 1, b downwards; (a, b) where it
would be without distortion, the ideal point; r, r' and theta, theta' lengths and angles of these;
(X, Y, Z) the direction, Z forwards. The prime is what is distorted.
"""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.probe.reading import Reading
from lucida.app.ui.explaining.notation import (
    Line,
    Slot,
    formula,
    latex_number,
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
    found = lens.inverse_steps(a, b)
    if not any(lens.coefficients.values()) or lens.model == "fov":
        return []
    lines = _distortion(lens)
    radial = not any(lens.coefficient(name) for name in _TANGENTIAL)
    symbol = _plane(lens, radial)
    for count, (x, y, error) in enumerate(found):
        values = (float(np.hypot(x, y)),) if radial else (float(x), float(y))
        shown = results(values)
        latex, text = (part.replace("?", str(count)) for part in symbol)
        if count == 0 and (x, y) == (a, b):  # it begins at the distorted point
            start = _start(lens, radial)
            latex, text = f"{latex} = {start[0]}", f"{text} = {start[1]}"
        off = f"{px * error:.2g} pixels"
        name = f"Newton's method, step {count}" if count else "Newton's method begins"
        lines.append(
            Line(
                f"step {count}",
                f"{name}: {off} off",
                rf"{latex} = {shown[0]}",
                "",
                f"{text} = {shown[1]}",
                "",
                values,
            )
        )
    return lines


_TANGENTIAL = ("p1", "p2", "s1", "s2", "s3", "s4", "sx1", "sy1")


def _plane(lens: Lens, radial: bool) -> tuple[str, str]:
    """Return the symbol of a step's result, with ? for its number."""
    if lens.model == "brown":
        return ("r_?", "r_?") if radial else ("(a_?, b_?)", "(a_?, b_?)")
    return (r"\theta_?", "theta_?") if radial else ("(U_?, V_?)", "(U_?, V_?)")


def _start(lens: Lens, radial: bool) -> tuple[str, str]:
    if not radial:
        return "(a', b')", "(a', b')"
    return ("r'", "r'") if lens.model == "brown" else (r"\theta'", "theta'")


def _distortion(lens: Lens) -> list[Line]:
    """Return what the lens does to a radius or a point, without terms that are 0."""
    brown = lens.model == "brown"
    radial = not any(lens.coefficient(name) for name in _TANGENTIAL)
    r, r_text = ("r", "r") if brown else THETA
    if not radial and not brown:
        r = r_text = "R"
    names = ("k1", "k2", "k3", "r8" if brown else "k4")
    above = _polynomial(lens, names, r, r_text)
    below = _polynomial(lens, ("k4", "k5", "k6"), r, r_text) if brown else None
    factor, factor_text = f"({above[0]})", f"({above[1]})"
    if below is not None and below[0] != "1":
        factor = rf"\frac{{{above[0]}}}{{{below[0]}}}"
        factor_text = f"({above[1]}) / ({below[1]})"
    name = f"distortion, {r_text}^2 = {'a^2 + b^2' if brown else 'U^2 + V^2'}"
    if radial:
        name = f"distortion, {r_text}' = |(a', b')|"
        latex, text = rf"{r}' = {r}\,{factor}", f"{r_text}' = {r_text} {factor_text}"
        return [Line("distortion", name, latex, "", text, "")]
    a, b = ("a", "b") if brown else ("U", "V")
    lines = []
    for axis, p, q, s in (
        (a, "p1", "p2", ("s1", "s2") if brown else ("sx1",)),
        (b, "p2", "p1", ("s3", "s4") if brown else ("sy1",)),
    ):
        parts = [(rf"{axis}\,{factor}", f"{axis} {factor_text}")]
        if value := lens.coefficient(p):
            parts.append(_term(2 * value, f"{a} {b}", f"{a} {b}"))
        if value := lens.coefficient(q):
            parts.append(_term(value, f"({r}^2 + 2 {axis}^2)", f"({r_text}^2 + 2 {axis}^2)"))
        for power, name_ in zip(("2", "4"), s, strict=False):
            if value := lens.coefficient(name_):
                parts.append(_term(value, f"{r}^{power}", f"{r_text}^{power}"))
        prime = "a'" if axis == a else "b'"
        latex, text = (" ".join(part) for part in zip(*parts, strict=True))
        lines.append(
            Line(f"distortion {axis}", name, f"{prime} = {latex}", "", f"{prime} = {text}", "")
        )
    return lines


def _polynomial(lens: Lens, names: tuple[str, ...], r: str, text: str) -> tuple[str, str]:
    """Return 1 + k1 r^2 + ... as LaTeX and as text."""
    parts = [("1", "1")]
    for power, name in zip((2, 4, 6, 8), names, strict=False):
        if value := lens.coefficient(name):
            parts.append(_term(value, f"{r}^{power}", f"{text}^{power}"))
    latex, plain = (" ".join(part) for part in zip(*parts, strict=True))
    return latex, plain


def _term(value: float, latex: str, text: str) -> tuple[str, str]:
    sign = "+" if value > 0 else "-"
    return rf"{sign} {latex_number(abs(value))}\,{latex}", f"{sign} {number(abs(value))} {text}"


def _direction(
    lens: Lens, reading: Reading, place: tuple[float, float], way: list[float]
) -> list[Line]:
    """Return the lines from the ideal plane to the direction, in the camera and in the world."""
    brown = lens.model == "brown"
    lines: list[Line] = []
    if brown:
        ideal = (way[0], way[1])
        radial = not any(lens.coefficient(name) for name in _TANGENTIAL)
        right = (r"\frac{r}{r'}\,(a', b')", "(r / r') (a', b')") if radial else ("", "")
        lines.append(_result("ideal", "the ideal point", ("(a, b)", "(a, b)"), right, ideal))
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
    elif any(lens.coefficient(name) for name in _TANGENTIAL):
        shares = (r"\frac{U}{\theta}", "U / theta"), (r"\frac{V}{\theta}", "V / theta")
        length = (r"\sqrt{U^2 + V^2}", "sqrt(U^2 + V^2)")
        lines.append(_result("angle", "angle to the axis", THETA, length, (angle,)))
    else:
        shares = (r"\frac{a'}{\theta'}", "a' / theta'"), (r"\frac{b'}{\theta'}", "b' / theta'")
        if not any(lens.coefficients.values()):
            length = (r"\sqrt{a'^2 + b'^2}", "sqrt(a'^2 + b'^2)")
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
