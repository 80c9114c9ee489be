"""A projected diagram as the rasterizer's overlay takes it, in the theme's colours.

Owns which colour a role has. Knows nothing of cameras.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from imgui_bundle import ImVec4

from app.outside.diagram import Role, Segments
from app.outside.projected import Primitive, Shape, Strokes
from app.outside.vector import Color, Paint
from app.widgets import theme
from renderer.camera import Vector
from renderer.images.display import to_srgb8
from renderer.raster.lines import (
    BARE,
    CORNER,
    DASHED,
    ON_PLANE,
    ROUND_END,
    ROUND_START,
    SEGMENT,
    Layer,
)

PALEST = 0.45  # a line that is paler has no casing, which would be all one sees of it

FIXED: dict[Role, ImVec4] = {
    "plane": theme.rgb("#f2f5f8"),
    "volume": theme.rgb("#b9cbe0"),
    "grid": theme.rgb("#ffffff"),
    "eye": theme.rgb("#f4f1ea"),
    "text": theme.rgb("#eef1f4"),
    "extra": theme.rgb("#cc79a7"),  # the reddish purple of Okabe and Ito's palette
    "other": theme.rgb("#a98bff"),
    "pose": theme.rgb("#dccba6"),
}

# On a light ground without a picture behind.
DARKER: dict[Role, ImVec4] = {
    "plane": theme.rgb("#2f3943"),
    "volume": theme.rgb("#45607c"),
    "grid": theme.rgb("#5d6873"),
    "mark": theme.rgb("#8c7a00"),
    "text": theme.rgb("#16191c"),
    "other": theme.rgb("#6a3fd1"),
    "pose": theme.rgb("#74602f"),
}

Rgba = tuple[float, float, float, float]

# Of lines' edges. Dark in every theme: what is behind is the scene's picture, not the theme's
# ground, and the lines themselves are pale.
CASING: Rgba = (0.03, 0.035, 0.04, 0.6)


def role_color(role: Role, ground: theme.Rgb | None = None) -> ImVec4:
    """Return the colour of a role in the current theme. ground: the colour under it; None: a
    panel.
    """
    if role in theme.BASIS or role == "other":
        color = FIXED[role] if role == "other" else theme.BASIS[role]
        return color if ground is None else theme.seen_on(color, ground)
    if role == "ray":
        return theme.RAY
    return theme.MARK if role == "mark" else FIXED[role]


def vector_paint() -> Paint:
    """Return the colours of a vector drawing on the theme's own ground."""
    ground = theme.BACKGROUND
    behind = (ground.x, ground.y, ground.z)
    darker = DARKER if ground.x > 0.5 else {}

    def color(role: Role, tint: float) -> Color:
        found = darker.get(role, role_color(role, behind))
        end = 1.0 if tint > 0 else 0.0
        red, green, blue = (part + abs(tint) * (end - part) for part in (found.x, found.y, found.z))
        return red, green, blue

    plain = theme.PLAIN
    return Paint(color, (plain.x, plain.y, plain.z), behind)


def ground_of(background: Vector, exposure_ev: float) -> theme.Rgb:
    """Return the displayed colour of a scene's background, given in linear light.

    The drawing must contrast with it, not with the theme's own ground.
    """
    red, green, blue = to_srgb8(np.array(background, np.float32), exposure_ev).tolist()
    return red / 255, green / 255, blue / 255


def layers(primitives: Iterable[Primitive], ground: theme.Rgb) -> list[Layer]:
    """Return the input of Overlay.draw() by layer, the lowest first, without texts."""
    shapes: dict[int, list[np.ndarray]] = {}
    strokes: dict[int, list[np.ndarray]] = {}
    for part in primitives:
        if isinstance(part, Strokes):
            strokes.setdefault(part.layer, []).append(_segments(part, ground))
        elif isinstance(part, Shape):
            shapes.setdefault(part.layer, []).append(_corners(part, ground))
    return [
        (
            np.concatenate(shapes.get(layer, [np.empty(0, CORNER)])),
            np.concatenate(strokes.get(layer, [np.empty(0, SEGMENT)])),
        )
        for layer in sorted(shapes.keys() | strokes.keys())
    ]


def line_color(item: Segments, ground: theme.Rgb) -> Rgba:
    """Return the display colour of an item's lines, with their opacity."""
    return _color(item.role, item.opacity, 0.0, ground)


def _segments(part: Strokes, ground: theme.Rgb) -> np.ndarray:
    rows = np.zeros(len(part.points), SEGMENT)
    rows["start"], rows["end"] = part.points[:, 0], part.points[:, 1]
    rows["depth"], rows["before"] = part.depth, part.before
    rows["color"] = _color(part.role, part.opacity, part.tint, ground)
    rows["width"], rows["hidden"] = part.width_px, part.hidden
    # Round ends of pale lines would show where they meet.
    ends = ROUND_START | ROUND_END if part.opacity == 1 else 0
    bare = BARE * (part.opacity < PALEST)
    rows["flags"] = ends | (ON_PLANE * part.on_plane) | (DASHED * part.dashed) | bare
    return rows


def _corners(part: Shape, ground: theme.Rgb) -> np.ndarray:
    count = len(part.points) - 2
    fan = np.stack([np.zeros(count, int), np.arange(count) + 1, np.arange(count) + 2], axis=1)
    rows = np.zeros(3 * count, CORNER)
    rows["corner"] = part.points[fan.ravel()]
    rows["depth"] = part.depth[fan.ravel()]
    rows["color"] = _color(part.role, part.opacity, part.tint, ground)
    rows["hidden"], rows["flags"] = part.hidden, ON_PLANE * part.on_plane
    return rows


def _color(role: Role, opacity: float, tint: float, ground: theme.Rgb) -> Rgba:
    color = role_color(role, ground)
    end = 1.0 if tint > 0 else 0.0
    red, green, blue = (part + abs(tint) * (end - part) for part in (color.x, color.y, color.z))
    return red, green, blue, color.w * opacity
