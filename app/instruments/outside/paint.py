"""A projected diagram as layers of the rasterizer's overlay, in the theme's colours.

This module defines the colour of each role.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cache, lru_cache, partial
from itertools import groupby

import numpy as np
from imgui_bundle import ImVec4

from lucida.app.ui import palettes, theme
from lucida.app.ui.contrast import LEGIBLE, Rgb
from lucida.renderer.camera.checks import Vector
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.raster.lines import (
    BARE,
    CORNER,
    DASHED,
    ON_PLANE,
    ROUND_END,
    ROUND_START,
    SEGMENT,
    Layer,
)

from .diagram import Role, Segments
from .figure import Color
from .projected import Primitive, Shape, Strokes, Text

DARK_GROUND = 0.35  # the lightest channel of a scene's dark background
RIM: Rgb = (0.19, 0.19, 0.19)  # the rim of a label over white; other rims are darker
PALEST = 0.45  # paler lines have no casing, which would dominate them

FIXED: dict[Role, ImVec4] = {
    "plane": theme.rgb("#f2f5f8"),
    "volume": theme.rgb("#b9cbe0"),
    "grid": theme.rgb("#ffffff"),
    "eye": theme.rgb("#f4f1ea"),
    "text": theme.rgb("#eef1f4"),
    "extra": theme.rgb("#cc79a7"),  # the reddish purple of Okabe and Ito's palette
    "other": theme.rgb("#c9b6ff"),
    "pose": theme.rgb("#dccba6"),
}

# Colours on a light ground without a picture behind.
DARKER: dict[Role, ImVec4] = {
    "plane": theme.rgb("#2f3943"),
    "volume": theme.rgb("#45607c"),
    "grid": theme.rgb("#5d6873"),
    "eye": theme.rgb("#c9c1b2"),
    "mark": theme.rgb("#8c7a00"),
    "text": theme.rgb("#16191c"),
    "other": theme.rgb("#6a3fd1"),
    "pose": theme.rgb("#74602f"),
}

Rgba = tuple[float, float, float, float]


def role_color(role: Role, ground: Rgb | None = None) -> ImVec4:
    """Return the colour of a role in the current theme. ground: the colour under it; None
    for a panel.
    """
    if role in theme.BASIS or role == "other":
        basis = theme.BASIS
        if theme.used().theme == "light" and ground is not None and max(ground) < DARK_GROUND:
            basis = palettes.PRESENTED_DARK.BASIS  # the light theme's are dark
        color = FIXED[role] if role == "other" else basis[role]
        return color if ground is None else theme.seen_on(color, ground)
    if role == "ray":
        return theme.RAY
    return theme.MARK if role == "mark" else FIXED[role]


def label_color(role: Role) -> ImVec4:
    """Return the colour of a role's labels, which have dark rims."""
    return theme.seen_on(role_color(role, RIM), RIM, LEGIBLE)


def figure_color(role: Role, tint: float, ground: Rgb) -> Color:
    """Return the colour of a role in a figure on a ground, with a tint (1: white, -1: black)."""
    darker = DARKER if min(ground) > 0.5 else {}
    color = darker.get(role, role_color(role, ground))
    return _tinted(theme.seen_on(color, ground, LEGIBLE), tint)


@lru_cache(maxsize=1)
def ground_of(background: Vector, exposure_ev: float) -> Rgb:
    """Return the displayed colour of a scene's background, given in linear light.

    The drawing must contrast with it, not with the theme's own ground.
    """
    red, green, blue = to_srgb8(np.array(background, np.float32), exposure_ev).tolist()
    return red / 255, green / 255, blue / 255


def layers(primitives: Iterable[Primitive], ground: Rgb) -> list[Layer]:
    """Return the layers for Overlay.draw(), the lowest first, without texts."""
    parts = sorted((one for one in primitives if not isinstance(one, Text)), key=_layer)
    color = cache(partial(_color, ground=ground))
    strokes = [part for part in parts if isinstance(part, Strokes)]
    shapes = [part for part in parts if isinstance(part, Shape)]
    segments, corners = _segments(strokes, color), _corners(shapes, color)
    out, first, last = [], [0, 0], [0, 0]
    for _, group in groupby(parts, _layer):
        for part in group:
            if isinstance(part, Strokes):
                last[1] += len(part.points)
            else:
                last[0] += 3 * (len(part.points) - 2)
        out.append((corners[first[0] : last[0]], segments[first[1] : last[1]]))
        first = [*last]
    return out


def _layer(part: Strokes | Shape) -> int:
    return part.layer


def line_color(item: Segments, ground: Rgb) -> Rgba:
    """Return the display colour of an item's lines, with their opacity."""
    return _color(item.role, item.opacity, 0.0, ground)


def _segments(parts: Sequence[Strokes], color: Callable[[Role, float, float], Rgba]) -> np.ndarray:
    """Return the lines of all parts. They are made together: most parts have few."""
    counts = [len(part.points) for part in parts]
    rows = np.zeros(sum(counts), SEGMENT)
    if not len(rows):
        return rows
    points = np.concatenate([part.points for part in parts])
    rows["start"], rows["end"] = points[:, 0], points[:, 1]
    rows["depth"] = np.concatenate([part.depth for part in parts])
    rows["before"] = np.concatenate([part.before for part in parts])
    fixed = [
        (*color(part.role, part.opacity, part.tint), part.width_px, part.hidden,
         # Round ends of pale lines would show where they meet.
         (ROUND_START | ROUND_END if part.opacity == 1 else 0) | (ON_PLANE * part.on_plane)
         | (DASHED * part.dashed) | BARE * (part.opacity < PALEST))
        for part in parts
    ]  # fmt: skip
    values = np.repeat(np.array(fixed), counts, axis=0)
    rows["color"] = values[:, :4]
    rows["width"], rows["hidden"], rows["flags"] = values[:, 4:].T
    return rows


def _corners(parts: Sequence[Shape], color: Callable[[Role, float, float], Rgba]) -> np.ndarray:
    """Return the corners of all parts' triangles, which have their first corners in common."""
    counts = [len(part.points) for part in parts]
    ends = np.cumsum(counts)
    rows = np.zeros(3 * (sum(counts) - 2 * len(parts)), CORNER)
    if not len(rows):
        return rows
    first = np.repeat(ends - counts, counts)
    second = np.arange(len(first))
    second = second[(second > first) & (second + 1 < np.repeat(ends, counts))]
    fan = np.stack([first[second], second, second + 1], axis=1).ravel()
    rows["corner"] = np.concatenate([part.points for part in parts])[fan]
    rows["depth"] = np.concatenate([part.depth for part in parts])[fan]
    fixed = [
        (*color(part.role, part.opacity, part.tint), part.hidden, ON_PLANE * part.on_plane)
        for part in parts
    ]
    values = np.repeat(np.array(fixed), counts, axis=0)[fan]
    rows["color"] = values[:, :4]
    rows["hidden"], rows["flags"] = values[:, 4:].T
    return rows


def _color(role: Role, opacity: float, tint: float, ground: Rgb) -> Rgba:
    color = role_color(role, ground)
    return *_tinted(color, tint), color.w * opacity


def _tinted(color: ImVec4, tint: float) -> Color:
    end = 1.0 if tint > 0 else 0.0
    red, green, blue = (part + abs(tint) * (end - part) for part in (color.x, color.y, color.z))
    return red, green, blue
