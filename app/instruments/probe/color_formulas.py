"""The colour of a pixel, line by line: light, mirrors, exposure, sRGB, 8 bits.

These are the lines after the hit; shading.py computes the terms.

Symbols: k_d, k_s the diffuse and specular reflectance, I_a the ambient light, I_1 a light's colour,
l_1 the direction to it, h_1 halfway between it and the viewer, n the normal, s the shininess, L
the light that arrives at the pixel. Colours are (red, green, blue), linear until sRGB.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

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
from lucida.renderer.images.shared_numbers import (
    SRGB_GAMMA,
    SRGB_LINEAR,
    SRGB_SCALE,
    SRGB_SHIFT,
    SRGB_SLOPE,
)
from lucida.renderer.scene.model import Color

from .reading import Bounce, Reading
from .shading import Lamp, Shading

LIGHT = r"\mathbf{L}"


def color_lines(reading: Reading) -> list[Line]:
    """Return the lines from the material's reflectance to the picture's bytes."""
    if reading.shading is None:
        arrived = [
            _color_formula(
                "background",
                "nothing is hit: the background",
                LIGHT,
                r"\mathbf{L}_{\mathrm{background}}",
                {},
                reading.background,
            )
        ]
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
    lines = [
        _given("reflectance", "diffuse reflectance of the surface", "k_d", shading.albedo),
        _color_formula(
            "ambient",
            "ambient",
            r"\mathbf{L}_a",
            r"<k>\,<I>",
            {"k": _color("k_d", shading.albedo), "I": _color("I_a", shading.ambient_light)},
            shading.ambient,
        ),
    ]
    if any(shading.specular):
        lines.insert(1, _given("specular", "specular reflectance", "k_s", shading.specular))
    for lamp in shading.lamps:
        lines += _lamp_lines(shading, lamp)
    return lines


def _lamp_lines(shading: Shading, lamp: Lamp) -> list[Line]:
    k = lamp.number + 1
    kind = "point light" if lamp.is_point else "directional light"
    lines = [_to_light(lamp, k, kind)]
    if not lamp.is_lit:
        zero = "(0, 0, 0)"
        return [
            *lines,
            Line(
                f"shadow {k}",
                f"light {k} is shadowed: something is between, or the surface faces away",
                rf"\mathbf{{L}}_{{{k}}} = {zero}",
                "",
                (0.0, 0.0, 0.0),
            ),
        ]
    color = _color(f"I_{k}", lamp.color)
    lines.append(
        _color_formula(
            f"diffuse {k}",
            f"light {k}, diffuse" + (": it is behind the surface" if lamp.n_dot_l <= 0 else ""),
            rf"\mathbf{{L}}_{{d{k}}}",
            r"<k>\,<I>\,\max(0,\ <dot>)",
            {
                "k": _color("k_d", shading.albedo),
                "I": color,
                "dot": _dot(f"l_{k}", lamp.n_dot_l),
            },
            lamp.diffuse,
        )
    )
    if any(shading.specular):
        lines.append(_halfway(lamp, k))
        lines.append(
            _color_formula(
                f"specular {k}",
                f"light {k}, specular",
                rf"\mathbf{{L}}_{{s{k}}}",
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


def _to_light(lamp: Lamp, k: int, kind: str) -> Line:
    name = f"towards light {k}, a {kind}"
    right, q, x = bold(f"c_{k}"), bold(f"q_{k}"), r"\mathbf{x}"
    if lamp.is_point:
        right = rf"\frac{{{q} - {x}}}{{|{q} - {x}|}}"
    return formula(f"light {k}", name, bold(f"l_{k}"), right, {}, lamp.to_light)


def _halfway(lamp: Lamp, k: int) -> Line:
    light, view = bold(f"l_{k}"), r"\hat{\mathbf{d}}"
    return formula(
        f"halfway {k}",
        f"halfway between light {k} and the viewer",
        bold(f"h_{k}"),
        rf"\frac{{{light} - {view}}}{{|{light} - {view}|}}",
        {},
        lamp.half,
    )


def _dot(other: str, value: float) -> Slot:
    """Return the cosine between the normal and a unit vector."""
    return Slot(rf"\mathbf{{n}} \cdot {bold(other)}", latex_number(value))


def _bounce_line(reading: Reading, number_: int, bounce: Bounce) -> Line:
    if bounce.hit is None:
        seen = "the background"
    else:
        entry = next(m for m in reading.meetings if m.object == bounce.hit.object)
        seen = f"{entry.name}, t = {number(bounce.hit.t)}"
    return _color_formula(
        f"mirror {number_}",
        f"mirrored ray {number_} sees {seen}",
        rf"\mathbf{{L}}_{{m{number_}}}",
        r"<k>\,<L>",
        {
            # A later ray is weighted by the product of the reflectances on its way.
            "k": _color("k_s" if number_ == 1 else f"w_{number_}", bounce.weight),
            "L": Slot(rf"\mathbf{{L}}(\mathbf{{r}}_{{{number_}}})", _color_text(bounce.color)),
        },
        _added(bounce),
    )


def _added(bounce: Bounce) -> Color:
    """Return the lines for the light that a mirrored ray adds to the pixel."""
    r, g, b = (w * c for w, c in zip(bounce.weight, bounce.color, strict=True))
    return r, g, b


def _sum_line(reading: Reading, shading: Shading) -> Line:
    terms = [(r"\mathbf{L}_a", shading.ambient)]
    for lamp in shading.lamps:
        k = lamp.number + 1
        if lamp.is_lit:
            terms.append((rf"\mathbf{{L}}_{{d{k}}}", lamp.diffuse))
            if any(shading.specular):
                terms.append((rf"\mathbf{{L}}_{{s{k}}}", lamp.specular))
    for k, bounce in enumerate(reading.bounces, start=1):
        terms.append((rf"\mathbf{{L}}_{{m{k}}}", _added(bounce)))
    slots = {
        f"{index}": Slot(latex, _color_text(value)) for index, (latex, value) in enumerate(terms)
    }
    total = " + ".join(f"<{index}>" for index in slots)
    return _color_formula("sum", "the sum", LIGHT, total, slots, reading.color)


# The display.


def _display_lines(reading: Reading) -> list[Line]:
    lines = []
    if reading.exposure_ev:
        stops = scalar_slot(r"\mathrm{EV}", reading.exposure_ev)
        lines.append(
            _color_formula(
                "exposure",
                "exposure",
                r"\mathbf{L}'",
                r"2^{<e>}\,<L>",
                {"e": stops, "L": _color("L", reading.color)},
                reading.exposed,
            )
        )
    light = _color("L", reading.exposed)
    if reading.exposure_ev:
        light = Slot(r"\mathbf{L}'", light.latex_value)
    cut, latex = "", "<L>"
    if max(reading.exposed) > 1:
        cut, latex = "; values above 1 are cut off", r"\min(1,\ <L>)"
    right = rf"{SRGB_SCALE}\,{latex}^{{1/{SRGB_GAMMA}}} - {SRGB_SHIFT}"
    name = f"sRGB's curve (up to {SRGB_LINEAR}: {SRGB_SLOPE} L)"
    if reading.transfer == "linear":
        right, name = latex, "display value, linear"
    lines.append(
        _color_formula("display", name + cut, r"\mathbf{C}", right, {"L": light}, reading.display)
    )
    bytes_ = tuple(float(value) for value in reading.bytes)
    lines.append(
        formula(
            "bytes",
            "8 bits",
            r"\mathbf{B}",
            r"\lfloor 255\,<C> + 0.5 \rfloor",
            {"C": _color("C", reading.display)},
            bytes_,
        )
    )
    return lines


def _given(key: str, name: str, symbol: str, value: Color) -> Line:
    """Return the line of a quantity that is read from the scene."""
    slot = _color(symbol, value)
    return Line(key, name, slot.latex, f"= {slot.latex_value}", value)


def _color_formula(
    key: str,
    name: str,
    left: str,
    right: str,
    slots: Mapping[str, Slot],
    value: Color,
) -> Line:
    return formula(key, name, left, right, slots, value, _color_text(value))


def _color(symbol: str, value: Color) -> Slot:
    return Slot(bold(symbol), _color_text(value))


def _color_text(value: Iterable[float]) -> str:
    """Return a colour as text, always with four decimals."""
    return "(" + r",\ ".join(f"{part:.{DECIMALS}f}" for part in value) + ")"
