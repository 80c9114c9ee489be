"""A pixel's reading for the clipboard: as LaTeX, or as a program in Python."""

from __future__ import annotations

from collections.abc import Iterable

from lucida.app.instruments.probe.color_formulas import color_lines
from lucida.app.instruments.probe.formulas import hit_lines, pixel_text, ray_lines
from lucida.app.instruments.probe.reading import OUTSIDE, SEEN, Reading
from lucida.app.ui.explaining.notation import Line
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.images.shared_numbers import (
    SRGB_GAMMA,
    SRGB_LINEAR,
    SRGB_SCALE,
    SRGB_SHIFT,
    SRGB_SLOPE,
)


def section_lines(
    reading: Reading, indexing: Indexing = Indexing.LECTURE
) -> tuple[list[Line], list[Line], list[Line]]:
    """Return a reading's lines for the ray, the hit and the colour."""
    color = [] if reading.is_outside else color_lines(reading)
    return ray_lines(reading, indexing), hit_lines(reading), color


def all_lines(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> list[Line]:
    """Return every line of a reading, from the pixel's index to its bytes."""
    return [line for part in section_lines(reading, indexing) for line in part]


def as_latex(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> str:
    """Return the lines as an `align*` of amsmath."""
    rows = []
    for line in all_lines(reading, indexing):
        left, equal, right = line.latex.partition(" = ")
        rows.append(rf"{left} &= {right} \\" if equal else rf"& {line.latex} \\")
        if line.latex_numbers:
            sign, space, rest = line.latex_numbers.partition(" ")
            rows.append(
                rf"&= {rest} \\" if sign == "=" and space else rf"& {line.latex_numbers} \\"
            )
    rows[-1] = rows[-1].removesuffix(r" \\")
    body = [rf"% Pixel in {pixel_text(reading, indexing)}", r"\begin{align*}"]
    return "\n".join([*body, *(f"  {row}" for row in rows), r"\end{align*}"]) + "\n"


def as_python(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> str:
    """Return a program that uses only NumPy, that computes the ray, the hit and the
    colour of the pixel.

    It leaves them in its variables origin, direction, t, point, normal, color and rgb; for a pixel
    of the background, only origin, direction, color and rgb.
    """
    camera = reading.camera
    i, j = indexing.numbers(reading.pixel)
    like = "as in the lecture" if indexing is Indexing.LECTURE else "as arrays are"
    parallel = camera.is_parallel
    lines = [
        f"# The viewing ray and the colour of the pixel in {pixel_text(reading, indexing)}.",
        "import numpy as np",
        "",
        f"i, j = {i}, {j}  # row and column, counted {indexing.told}, {like}",
        f"width, height = {reading.size[0]}, {reading.size[1]}",
        *(f"{name} = {_array(getattr(camera, name))}" for name in ("eye", "u", "v", "w")),
        f"distance = {camera.distance!r}  # of the viewport along -w",
        f"left, right, bottom, top = {camera.viewport!r}",
        "",
        f"x = left + (right - left) * (j {indexing.offset}) / width",
        f"y = top - (top - bottom) * (i {indexing.offset}) / height",
    ]
    if reading.is_outside:
        return "\n".join([*lines, f"# {OUTSIDE}", "print(x, y)"]) + "\n"
    if camera.lens is not None:
        told = "where the lens sees the pixel, found by Newton's method"
        lines += ["origin = eye", f"direction = {_array(reading.direction)}  # {told}"]
    else:
        lines += [
            f"origin = {'eye + x * u + y * v' if parallel else 'eye'}",
            f"direction = {'-w' if parallel else 'x * u + y * v - distance * w'}",
        ]
    lines += [
        "",
        *(_hit_program(reading) if reading.hit is not None else _background_program(reading)),
        "",
        *_display_program(reading),
        "print(origin, direction, color, rgb)",
    ]
    return "\n".join(lines) + "\n"


def _background_program(reading: Reading) -> list[str]:
    return ["# The ray hits nothing.", f"color = {_array(reading.background)}"]


def _hit_program(reading: Reading) -> list[str]:
    assert reading.hit is not None
    assert reading.shading is not None
    lines = [f"# The nearest hit: {reading.meetings[0].name}."]
    if reading.sphere is not None:
        center, radius = reading.sphere
        lines += [
            f"center, radius = {_array(center)}, {radius!r}",
            "f = origin - center",
            "a, b, c = direction @ direction, f @ direction, f @ f - radius**2",
            f"t = (-b {_root_sign(reading)} np.sqrt(b * b - a * c)) / a",
            "point = origin + t * direction",
            "normal = (point - center) / radius",
        ]
    else:
        lines += [
            *(
                f"{name} = {_array(corner)}"
                for name, corner in zip("abc", reading.corners, strict=True)
            ),
            "normal = np.cross(b - a, c - a)",
            "normal /= np.linalg.norm(normal)",
            "t = normal @ (a - origin) / (normal @ direction)",
            "point = origin + t * direction",
        ]
    lines.append("normal *= -np.sign(normal @ direction)  # towards the viewer")
    if reading.hit.has_own_normal:
        why = "interpolated between the corners'" if reading.hit.corner_normals else "bent, to it"
        lines.append(f"normal = {_array(reading.hit.normal)}  # {why}")
    return [*lines, "", *_light_program(reading)]


def _root_sign(reading: Reading) -> str:
    """Return the sign of the root of the sphere's equation that is the hit."""
    seen = reading.meetings[0]
    at = next(k for k, crossing in enumerate(seen.crossings) if crossing.standing == SEEN)
    return "-" if at == 0 else "+"


def _light_program(reading: Reading) -> list[str]:
    """Return the light's terms as a program that runs without Lucida. Tests run it and compare its
    colour.
    """
    shading = reading.shading
    assert shading is not None
    lines = [
        "# Blinn and Phong's light; colours are linear.",
        f"albedo, specular = {_array(shading.albedo)}, {_array(shading.specular)}",
        f"shininess = {shading.shininess!r}",
        "to_viewer = -direction / np.linalg.norm(direction)",
        f"color = {_array(shading.ambient_light)} * albedo",
    ]
    for lamp in shading.lamps:
        name = f"light {lamp.number + 1}"
        if not lamp.is_lit:
            lines.append(f"# {name} is shadowed")
            continue
        to_light = f"{_array(lamp.place)} - point" if lamp.is_point else _array(lamp.place)
        lines += [
            f"l = {to_light}  # {name}",
            *(["l /= np.linalg.norm(l)"] if lamp.is_point else []),
            "h = l + to_viewer",
            "h /= max(np.linalg.norm(h), 1e-300)",
            "diffuse = max(0.0, normal @ l) * albedo",
            "highlight = max(0.0, normal @ h) ** shininess * specular",
            f"color += {_array(lamp.color)} * (diffuse + highlight)",
        ]
    for k, bounce in enumerate(reading.bounces, start=1):
        lines.append(
            f"color += {_array(bounce.weight)} * {_array(bounce.color)}  # mirrored ray {k}"
        )
    return lines


def _display_program(reading: Reading) -> list[str]:
    lines = ["# The display: exposure, curve, 8 bits."]
    lines.append(f"exposed = np.clip(2.0**{reading.exposure_ev!r} * color, 0, 1)")
    if reading.transfer == "linear":
        lines.append("shown = exposed")
    else:
        lines.append(
            f"shown = np.where(exposed <= {SRGB_LINEAR}, {SRGB_SLOPE} * exposed,"
            f" {SRGB_SCALE} * exposed ** (1 / {SRGB_GAMMA}) - {SRGB_SHIFT})"
        )
    return [*lines, "rgb = np.floor(255 * shown + 0.5).astype(int)"]


def _array(values: Iterable[float]) -> str:
    """Return numbers that read back exactly."""
    return "np.array([" + ", ".join(repr(float(value)) for value in values) + "])"
