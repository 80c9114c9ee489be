"""The contrast of two colours, and the colour that has enough of it (WCAG 2.1)."""

from __future__ import annotations

import functools

import numpy as np

from lucida.renderer.images.display import LUMINANCE, from_srgb

Rgb = tuple[float, float, float]  # sRGB, 0..1
LEGIBLE = 4.5  # the least contrast of text with its background (1.4.3)
SEEN = 3.0  # and of graphics (1.4.11)


@functools.lru_cache(maxsize=256)
def legible_on(color: Rgb, behind: Rgb, least: float = LEGIBLE) -> Rgb:
    """Return the colour, mixed with black or white as far as the contrast needs."""
    end = 0.0 if _luminance(behind) > 0.18 else 1.0
    for step in range(21):
        red, green, blue = (c + step / 20 * (end - c) for c in color)
        mixed = red, green, blue
        if contrast(mixed, behind) >= least:
            return mixed
    return (end, end, end)


def contrast(one: Rgb, other: Rgb) -> float:
    """Return the contrast ratio of two sRGB colours, 1 to 21 (WCAG 2.1)."""
    dark, bright = sorted((_luminance(one), _luminance(other)))
    return (bright + 0.05) / (dark + 0.05)


def _luminance(color: Rgb) -> float:
    return float(from_srgb(np.rint(255 * np.array(color)).astype(np.uint8)) @ LUMINANCE)
