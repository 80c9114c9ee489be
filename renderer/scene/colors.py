"""Colours as users write them, to linear light.

Knows nothing of materials.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np

from renderer.errors import LucidaError
from renderer.images.display import from_srgb
from renderer.scene.model import Color, color

_HEX = re.compile(r"#([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})")


def parse_color(name: str, value: str | Iterable[float]) -> Color:
    """[red, green, blue] in linear light as it is; "#rrggbb", which is sRGB, as linear light."""
    if not isinstance(value, str):
        return color(name, value)
    match = _HEX.fullmatch(value)
    if not match:
        raise LucidaError(
            name, f"{value[:40]!r} is not a colour", 'give "#rrggbb" or [red, green, blue]'
        )
    red, green, blue = from_srgb(np.array([int(part, 16) for part in match.groups()], np.uint8))
    return float(red), float(green), float(blue)
