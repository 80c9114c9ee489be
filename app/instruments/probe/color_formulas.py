"""The colour of a pixel, line by line: light, mirrors, exposure, sRGB, 8 bits.

These are the lines after the hit; shading.py computes the terms.

Symbols: k_d, k_s the diffuse and specular reflectance, I_a the ambient light, I_1 a light's colour,
l_1 the direction to it, h_1 halfway between it and the viewer, n the normal, s the shininess, L
the light that arrives at the pixel. Colours are (red, green, blue), linear until sRGB.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from lucida.app.instruments.probe.reading import Bounce, Reading
from lucida.app.ui.explaining.notation import (
    DECIMALS,
    Line,
    Slot,
    bold,
    formula,
    latex_number,
    number,
    scalar_slot,
)
from lucida.app.ui.explaining.shading import Lamp, Shading
from lucida.renderer.images.shared_numbers import (
    SRGB_GAMMA,
    SRGB_LINEAR,
    SRGB_SCALE,
    SRGB_SHIFT,
    SRGB_SLOPE,
)
from lucida.renderer.scene.model import Color

LIGHT = r"\mathbf{L}"


def color_lines(reading: Reading) -> list[Line]:
    """Return the lines from the material's reflectance to the picture's bytes."""
    if reading.shading is None:
        name, right = "nothing is hit: the background", r"\mathbf{L}_{\mathrm{background}}"
        arrived = [_color_formula("background", name, LIGHT, right, {}, reading.background)]
    else:
        arrived = _shading_lines(reading.shading)
        arrived += [
            _bounce_line(reading, number, bounce)
            for number, bounce in enumerate(reading.bounces, start=1)
        ]
        arrived.append(_sum_line(reading, reading.shading))
    return arrived + _display_lines(reading)


# Light.


def _shading_lines(shading: Shading) -> list[Line]:
    k, light = _color("k_d", shading.albedo), _color("I_a", shading.ambient_light)
    lines = [_given("reflectance", "diffuse reflectance of the surface", k, shading.albedo)]
    if any(shading.specular):
        k_s = _color("k_s", shading.specular)
        lines.append(_given("specular", "specular reflectance", k_s, shading.specular))
    left, slots = rf"{LIGHT}_a", {"k": k, "I": light}
    lines.append(_color_formula("ambient", "ambient", left, r"<k>\,<I>", slots, shading.ambient))
    for lamp in shading.lamps:
        lines += _lamp_lines(shading, lamp)
    return lines


def _lamp_lines(shading: Shading, lamp: Lamp) -> list[Line]:
    k = lamp.number + 1
    lines = [_to_light(lamp, k)]
    if not lamp.is_lit:
        name = f"light {k} is shadowed: something is between, or the surface faces away"
        zero = rf"{LIGHT}_{{{k}}} = (0, 0, 0)"
        return [*lines, Line(f"shadow {k}", name, zero, "", (0.0, 0.0, 0.0))]
    color = _color(f"I_{k}", lamp.color)
    lines.append(
        _color_formula(
            f"diffuse {k}",
            f"light {k}, diffuse" + (": it is behind the surface" if lamp.n_dot_l <= 0 else ""),
            rf"{LIGHT}_{{d{k}}}",
            r"<k>\,<I>\,\max(0,\ <dot>)",
            {"k": _color("k_d", shading.albedo), "I": color, "dot": _dot(f"l_{k}", lamp.n_dot_l)},
            lamp.diffuse,
        )
    )
    if any(shading.specular):
        light, view = bold(f"l_{k}"), r"\hat{\mathbf{d}}"
        right = rf"\frac{{{light} - {view}}}{{|{light} - {view}|}}"
        name = f"halfway between light {k} and the viewer"
        lines.append(formula(f"halfway {k}", name, bold(f"h_{k}"), right, {}, lamp.half))
        lines.append(
            _color_formula(
                f"specular {k}",
                f"light {k}, specular",
                rf"{LIGHT}_{{s{k}}}",
                r"<k>\,<I>\,\max(0,\ <dot>)^{<s>}",
                {
                    "k": _color("k_s", shading.specular),
                    "I": color,
                    "s": scalar_slot("s", shading.shininess),
                    "dot": _dot(f"h_{k}", lamp.n_dot_h),
                },
                lamp.specular,
            )
        )
    return lines


def _to_light(lamp: Lamp, k: int) -> Line:
    kind = "point light" if lamp.is_point else "directional light"
    q, x = bold(f"q_{k}"), r"\mathbf{x}"
    right = rf"\frac{{{q} - {x}}}{{|{q} - {x}|}}" if lamp.is_point else bold(f"c_{k}")
    name = f"towards light {k}, a {kind}"
    return formula(f"light {k}", name, bold(f"l_{k}"), right, {}, lamp.to_light)


def _dot(other: str, value: float) -> Slot:
    """Return the cosine between the normal and a unit vector."""
    return Slot(rf"\mathbf{{n}} \cdot {bold(other)}", latex_number(value))


def _bounce_line(reading: Reading, number_: int, bounce: Bounce) -> Line:
    if bounce.hit is None:
        seen = "the background"
    else:
        entry = next(m for m in reading.meetings if m.object == bounce.hit.object)
        seen = f"{entry.name}, t = {number(bounce.hit.t)}"
    # Of a later ray, the product of the reflectances on its way.
    weight = _color("k_s" if number_ == 1 else f"w_{number_}", bounce.weight)
    arriving = Slot(rf"{LIGHT}(\mathbf{{r}}_{{{number_}}})", _color_text(bounce.color))
    return _color_formula(
        f"mirror {number_}",
        f"mirrored ray {number_} sees {seen}",
        rf"{LIGHT}_{{m{number_}}}",
        r"<k>\,<L>",
        {"k": weight, "L": arriving},
        _added(bounce),
    )


def _added(bounce: Bounce) -> Color:
    """Return what a mirrored ray adds to the pixel."""
    r, g, b = (w * c for w, c in zip(bounce.weight, bounce.color, strict=True))
    return r, g, b


def _sum_line(reading: Reading, shading: Shading) -> Line:
    terms = {"a": shading.ambient}
    for lamp in shading.lamps:
        if lamp.is_lit:
            terms[f"{{d{lamp.number + 1}}}"] = lamp.diffuse
            if any(shading.specular):
                terms[f"{{s{lamp.number + 1}}}"] = lamp.specular
    for k, bounce in enumerate(reading.bounces, start=1):
        terms[f"{{m{k}}}"] = _added(bounce)
    slots = {
        str(place): Slot(f"{LIGHT}_{index}", _color_text(value))
        for place, (index, value) in enumerate(terms.items())
    }
    total = " + ".join(f"<{place}>" for place in slots)
    return _color_formula("sum", "the sum", LIGHT, total, slots, reading.color)


# The display.


def _display_lines(reading: Reading) -> list[Line]:
    lines, prime = [], "'" if reading.exposure_ev else ""
    if reading.exposure_ev:
        slots = {
            "e": scalar_slot(r"\mathrm{EV}", reading.exposure_ev),
            "L": _color("L", reading.color),
        }
        right = r"2^{<e>}\,<L>"
        left, exposed = LIGHT + prime, reading.exposed
        lines.append(_color_formula("exposure", "exposure", left, right, slots, exposed))
    light = Slot(LIGHT + prime, _color_text(reading.exposed))
    cut, shown = "", "<L>"
    if max(reading.exposed) > 1:
        cut, shown = "; what is above 1 is cut off", r"\min(1,\ <L>)"
    right = rf"{SRGB_SCALE}\,{shown}^{{1/{SRGB_GAMMA}}} - {SRGB_SHIFT}"
    name = f"sRGB's curve (up to {SRGB_LINEAR}: {SRGB_SLOPE} L)"
    if reading.transfer == "linear":
        right, name = shown, "display value, linear"
    color = r"\mathbf{C}"
    lines.append(_color_formula("display", name + cut, color, right, {"L": light}, reading.display))
    right, slots = r"\lfloor 255\,<C> + 0.5 \rfloor", {"C": _color("C", reading.display)}
    values = tuple(float(value) for value in reading.bytes)
    return [*lines, formula("bytes", "8 bits", r"\mathbf{B}", right, slots, values)]


def _given(key: str, name: str, slot: Slot, value: Color) -> Line:
    """Return the line of a quantity that is read from the scene."""
    return Line(key, name, slot.symbol, f"= {slot.value}", value)


def _color_formula(
    key: str, name: str, left: str, right: str, slots: Mapping[str, Slot], value: Color
) -> Line:
    return formula(key, name, left, right, slots, value, _color_text(value))


def _color(symbol: str, value: Color) -> Slot:
    return Slot(bold(symbol), _color_text(value))


def _color_text(value: Iterable[float]) -> str:
    """Return a colour, always with four decimals."""
    return "(" + r",\ ".join(f"{part:.{DECIMALS}f}" for part in value) + ")"
