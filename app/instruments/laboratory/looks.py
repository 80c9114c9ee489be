"""The colours of the laboratory's sheets in a theme."""

from __future__ import annotations

from imgui_bundle import ImVec4

from lucida.app.instruments.outside.figure import Color
from lucida.app.ui import palettes, theme

from .sheet import Look


def look_of(palette: palettes.Palette) -> Look:
    """Return the colours of a sheet in a theme."""
    ground = _rgb(palette.PANEL)
    plain = (palette.TEXT, palette.DIM, palette.LINE, palette.FRAME_ACTIVE)
    marks = (palette.MARK, palette.RAY, *(palette.BASIS[name] for name in "uvw"))
    return Look(ground, *map(_rgb, plain), *(_rgb(theme.seen_on(one, ground)) for one in marks))


def _rgb(color: ImVec4) -> Color:
    return color.x, color.y, color.z
