"""Fields for the values of scene files: numbers, vectors and colours, each on a line of a panel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from imgui_bundle import imgui

from lucida.app.ui import rows, theme
from lucida.app.ui.fields import Scale, number_field
from lucida.renderer.editing.changing import Item, set_field, set_scene_field
from lucida.renderer.images.display import encode_srgb, from_srgb
from lucida.renderer.scene.model import BRIGHTEST, Color, Scene

AXES = ("x", "y", "z")
Edit = Callable[[Scene], Scene]


class Edits(list[Edit]):
    """The edits that a panel requests in one frame."""

    def set(self, items: Sequence[Item], field: str, value: Any) -> None:
        """Set a field of some items, unless the value is None: its line has not changed."""
        if value is not None:
            self.append(lambda scene: set_field(scene, items, field, value))

    def set_scene(self, field: str, value: Any) -> None:
        """Set a field of the scene, unless the value is None."""
        if value is not None:
            self.append(lambda scene: set_scene_field(scene, field, value))


DIGITS = 6  # of a colour component
NARROW_EM = 7.0  # narrower fields show a colour without its numbers


def number_line(
    label: str, value: float, scale: Scale, tooltip: str, fonts: theme.Fonts, reset: float
) -> float | None:
    """Draw a label and one number. Return the new number; None if it did not change."""
    width = rows.row(label, "", tooltip, fonts)
    changed, new = number_field(
        label, float(value), width, scale, theme.PLAIN, fonts.mono, tooltip, reset=reset
    )
    return new if changed else None


def whole_line(
    label: str, value: int, scale: Scale, tooltip: str, fonts: theme.Fonts, reset: int
) -> int | None:
    """Draw a label and one whole number. Return the new number; None if it did not change."""
    new = number_line(label, value, scale, tooltip, fonts, reset)
    return None if new is None or round(new) == value else round(new)


def vector_line(
    label: str,
    value: Sequence[float],
    scales: Sequence[Scale],
    tooltip: str,
    fonts: theme.Fonts,
    reset: Sequence[float],
    unit: str = "",
) -> list[float] | None:
    """Draw a label and three numbers."""
    thirds = rows.Thirds()
    rows.label(label, "", theme.TEXT, fonts, tooltip)
    found = [float(part) for part in value]
    changed = False
    for axis, letter in enumerate(AXES):
        thirds.go(axis)
        hit, found[axis] = number_field(
            f"{label}.{letter}",
            found[axis],
            thirds.field_px,
            scales[axis],
            theme.PLAIN,
            fonts.mono,
            f"{tooltip}: {letter}",
            reset=float(reset[axis]),
            unit=unit,
        )
        changed |= hit
    return found if changed else None


def color_line(label: str, value: Color, tooltip: str, fonts: theme.Fonts) -> list[float] | None:
    """Draw a label and a colour, picked as the screen shows it, with its linear values."""
    width = rows.row(label, "", tooltip, fonts)
    shown = encode_srgb(np.asarray(value, np.float32)).tolist()
    linear = ", ".join(f"{part:.3g}" for part in value)
    kinds = imgui.ColorEditFlags_
    flags = kinds.display_rgb | kinds.uint8 | kinds.input_rgb | kinds.picker_hue_wheel
    if width < NARROW_EM * imgui.get_font_size():  # three numbers have no room
        flags |= kinds.no_inputs
    imgui.set_next_item_width(width)
    imgui.push_font(fonts.mono, 0.0)
    imgui.push_style_var(imgui.StyleVar_.frame_border_size, 1.0)  # dark colours on a dark panel
    changed, picked = imgui.color_edit3(f"##{label}", shown, int(flags))
    imgui.pop_style_var()
    imgui.pop_font()
    rows.tip(f"{tooltip}\nlinear light: {linear}")
    if not changed:
        return None
    new = [float(f"{part:.{DIGITS}g}") for part in from_srgb(np.array(picked[:3])).tolist()]
    same = [round(255 * a) == round(255 * b) for a, b in zip(shown, picked[:3], strict=True)]
    return [
        float(old) if keeps else part for old, part, keeps in zip(value, new, same, strict=True)
    ]


def light_lines(value: Color, tooltip: str, fonts: theme.Fonts) -> list[float] | None:
    """Draw a light's colour: its hue at full strength, and its intensity."""
    strength = max(value)
    hue = tuple(part / strength for part in value) if strength > 0 else (1.0, 1.0, 1.0)
    picked = color_line("colour", hue, tooltip, fonts)  # type: ignore[arg-type]
    if picked is not None:
        top = max(picked)
        factor = (strength or 1.0) / top if top > 0 else 0.0
        return [float(f"{part * factor:.{DIGITS}g}") for part in picked]
    scale = Scale(0.0, 2.0, least=0.0, most=BRIGHTEST)
    new = number_line("intensity", strength, scale, "the largest of red, green, blue", fonts, 1.0)
    if new is None:
        return None
    new = min(max(new, 0.0), BRIGHTEST)
    return [float(f"{part * new:.{DIGITS}g}") for part in hue]
