"""The lens in a copied program: from a pixel's point to the direction of its ray."""

from __future__ import annotations

from lucida.app.instruments.probe.reading import Reading
from lucida.renderer.camera.lenses import Lens

_RADIAL = {"brown": ("k1", "k2", "k3", "r8"), "fisheye": ("k1", "k2", "k3", "k4")}
_ANGLES = {
    "stereographic": "2 * np.arctan(r1 / 2)",
    "equisolid": "2 * np.arcsin(r1 / 2)",
    "orthographic": "np.arcsin(r1)",
}
_PANORAMAS = {
    "equirectangular": ("np.sin(ax) * np.cos(ay)", "np.sin(ay)", "np.cos(ax) * np.cos(ay)"),
    "cylindrical": ("np.sin(ax)", "ay", "np.cos(ax)"),
}


def lens_program(reading: Reading) -> list[str]:
    """Return the lines from x and y to the direction, in code's words.

    Newton's steps are written out. If there are other than radial terms, its result is a number.
    """
    lens = reading.camera.lens
    assert lens is not None
    place = reading.x / reading.camera.distance, -reading.y / reading.camera.distance
    lines = ["ax, ay = x / distance, -y / distance  # on the plane at distance 1, downwards"]
    if lens.model in _PANORAMAS:
        return [*lines, _direction(*_PANORAMAS[lens.model])]
    known = _RADIAL.get(lens.model, ())
    others = {name for name, value in lens.coefficients.items() if value} - set(known)
    if lens.model in ("brown", "thin_prism_fisheye") and others:
        return [*lines, *_as_number(lens, place)]
    if place == (0.0, 0.0):
        return [*lines, _direction("0.0", "0.0", "1.0")]
    lines.append("r1 = np.sqrt(ax * ax + ay * ay)")
    if lens.model == "fov":
        omega = lens.coefficient("omega")
        lines.append(f"r = np.arctan(np.tan(r1 * {omega!r}) / (2 * np.tan({omega!r} / 2)))")
    else:
        lines.append(f"r = {_ANGLES.get(lens.model, 'r1')}")
    terms = [(2 * n, lens.coefficient(name)) for n, name in enumerate(known, start=1)]
    terms = [(power, value) for power, value in terms if value]
    if terms:
        steps = lens.inverse_steps(*place)
        if len(steps) and tuple(steps[0, :2]) != place:  # Newton needs to begin elsewhere
            lines[-1] = f"r = r1 * {float(steps[0, 0] / place[0] if place[0] else 1.0)!r}"
        factor = "1" + "".join(f" + {value!r} * r**{power}" for power, value in terms)
        slope = "1" + "".join(f" + {(power + 1) * value!r} * r**{power}" for power, value in terms)
        lines[-1] += "  # Newton's method undoes the distortion"
        step = f"r = r - (r * ({factor}) - r1) / ({slope})"
        lines += [step] * max(len(steps), 1)
    if lens.model == "brown":
        return [*lines, _direction("ax * r / r1", "ay * r / r1", "1.0")]
    lines[-1] += "  # the angle to the axis" if "#" not in lines[-1] else ""
    return [
        *lines,
        _direction("np.sin(r) * ax / r1", "np.sin(r) * ay / r1", "np.cos(r)"),
    ]


def _as_number(lens: Lens, place: tuple[float, float]) -> list[str]:
    x, y, z = (float(part) for part in lens.direction(*place))
    return [
        "# The lens's distortion, undone by Newton's method:",
        _direction(repr(x), repr(y), repr(z)),
    ]


def _direction(x: str, y: str, z: str) -> str:
    return f"direction = distance * ({x}) * u - distance * ({y}) * v - distance * ({z}) * w"
