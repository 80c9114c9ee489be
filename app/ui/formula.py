"""Formulas, typeset and wrapped to the window's width; plain text if they cannot be typeset.

This module caches the pictures of formulas, and finds places to break long ones. MicroTeX needs the
locale en_US.UTF-8; without it the formulas are plain text.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import imgui_bundle
from imgui_bundle import ImVec2, ImVec4, imgui, imgui_microtex

from . import theme
from .contrast import LEGIBLE, Rgb
from .explaining.breaking import breakable
from .explaining.plain import plain_math
from .theme import framebuffer_scale

ROW_GAP = 0.35  # between the rows of one formula, as a fraction of its type size
MOST_EXTENTS = 500
_extents: dict[tuple[str, float, float], ImVec2] = {}  # the last size of each formula


@dataclass(frozen=True, eq=False)
class Setting:
    """A typeset formula. width, ascent, descent: in ImGui's pixels. text: used in place of a
    picture.
    """

    width: float
    ascent: float
    descent: float
    picture: imgui_microtex.FormulaTexture | None = None
    text: str = ""

    def draw(self, x: float, baseline: float, color: ImVec4) -> None:
        """Draw the formula. color: for plain text; a picture has its own."""
        draw = imgui.get_window_draw_list()
        if self.picture is None:
            draw.add_text((x, baseline - self.ascent), theme.u32(color), self.text)
            return
        scale = framebuffer_scale()
        corner = ImVec2(round(x * scale), round((baseline - self.ascent) * scale)) / scale
        far = corner + ImVec2(self.width, self.ascent + self.descent)
        texture = imgui.ImTextureRef(self.picture.texture_id())
        draw.add_image(texture, corner, far, (0, 0), (1, 1), theme.u32(ImVec4(1, 1, 1, 1)))


@functools.cache
def available() -> bool:
    """Return True if formulas can be typeset here."""
    folder = Path(imgui_bundle.__file__).parent / "assets" / "fonts" / "latex"
    try:
        imgui_microtex.init(
            str(folder / "latinmodern-math.clm1"), str(folder / "latinmodern-math.otf")
        )
    except RuntimeError:
        return False
    return True


def release() -> None:
    """Release the pictures. Needs a current context."""
    if available():
        imgui_microtex.release()


def inline_math(latex: str, size_px: float, color: ImVec4, display: bool = False) -> Setting:
    """Typeset a formula in text of size_px. Call it every frame.

    If MicroTeX rejects it, it is plain text in the current font.
    display: True to set it as between $$.
    """
    scale = framebuffer_scale()
    if available():
        style = imgui_microtex.TexStyle.display if display else imgui_microtex.TexStyle.text
        try:
            made = imgui_microtex.render_to_texture(tinted(latex), size_px * scale, color, style)
        except RuntimeError:
            made = None
        if made is not None and made.width > 0:
            ascent = made.baseline_y / scale
            return Setting(made.width / scale, ascent, made.height / scale - ascent, made)
    text = plain_math(latex)
    extent = imgui.calc_text_size(text)
    return Setting(extent.x, 0.8 * extent.y, 0.2 * extent.y, None, text)


def formula(parts: Iterable[str], size_px: float, key: str) -> None:
    """Draw formulas one after another, as many in a row as fit.

    size_px: the type size.
    key: a name for the formulas that stays the same while their numbers change. Formulas out of
    sight keep their last size.
    """
    room = max(1.0, imgui.get_content_region_avail().x)
    place = (key, room, size_px)
    if (known := _extents.get(place)) is not None and not imgui.is_rect_visible(known):
        imgui.dummy(known)
        return
    rows: list[list[Setting]] = [[]]
    gap = 0.22 * size_px
    for part in parts:
        pieces = _pieces(part, size_px, room)
        whole = sum(piece.width for piece in pieces) + gap * (len(pieces) - 1)
        # A part that fits in a row of its own is not broken to fill the last row; a part without
        # a leading equals sign begins a row.
        full = _width(rows[-1], gap) + gap + whole > room >= whole
        if rows[-1] and (full or not part.startswith("=")):
            rows.append([])
        for piece in pieces:
            if rows[-1] and _width(rows[-1], gap) + gap + piece.width > room:
                rows.append([])
            rows[-1].append(piece)
    if len(_extents) >= MOST_EXTENTS:
        _extents.clear()
    _extents[place] = _draw_rows(rows, gap, ROW_GAP * size_px)


def lit(latex: str, part: str) -> str:
    """Highlight a part of a formula; return the formula unchanged if `part` is empty."""
    ground = _hex(theme.LIT)
    return latex.replace(part, rf"\bgcolor{{{ground}}}{{{part}}}", 1) if part else latex


def vector_colors() -> dict[str, ImVec4]:
    """Return the colours of vectors by their names."""
    ray = dict.fromkeys(("p", "d", "r", "origin", "direction"), theme.RAY)
    return theme.BASIS | ray | {"x": theme.MARK, "e": theme.TEXT}


def tinted(latex: str, ground: Rgb | None = None) -> str:
    """Return the formula in the colour language: u, v, w, the ray, the hit.

    ground: the background colour; None for a panel's.
    """
    return _tinted(latex, ground, theme.used())


@functools.lru_cache(maxsize=1024)
def _tinted(latex: str, ground: Rgb | None, _look: theme.WindowLook) -> str:
    """Return the formula in the colours of the current look, which is a cache key."""
    for name, color in vector_colors().items():
        symbol = rf"\mathbf{{{name}}}"
        ink = theme.legible(color) if ground is None else theme.seen_on(color, ground, LEGIBLE)
        latex = latex.replace(symbol, rf"\fgcolor{{{_hex(ink)}}}{{{symbol}}}")
    return latex


def _pieces(latex: str, size_px: float, room: float) -> list[Setting]:
    """Return a formula's pieces: broken at sums, and at products if necessary. A piece that is
    still too wide is scaled down.
    """
    pieces: list[Setting] = []
    for cut in breakable(latex):
        piece = _piece(cut, size_px)
        factors = cut.replace(r")\,", ")\n").split("\n") if piece.width > room else [cut]
        pieces += [_piece(factor, size_px) for factor in factors]
    shrunk = [min(1.0, room / max(1.0, piece.width)) for piece in pieces]
    return [
        replace(piece, width=k * piece.width, ascent=k * piece.ascent, descent=k * piece.descent)
        for piece, k in zip(pieces, shrunk, strict=True)
    ]


def _piece(latex: str, size_px: float) -> Setting:
    if latex[:2] in ("+ ", "- "):  # a leading + or - would be set as a sign, without a sum's space
        latex = rf"{latex[0]}\;{latex[2:]}"
    return inline_math(latex, size_px, theme.TEXT, display=True)


def _width(row: list[Setting], gap: float) -> float:
    return sum(piece.width for piece in row) + gap * (len(row) - 1)


def _draw_rows(rows: list[list[Setting]], gap: float, row_gap: float) -> ImVec2:
    """Draw the rows. Return the size they take."""
    corner, y, widest = imgui.get_cursor_screen_pos(), 0.0, 0.0
    for row in filter(None, rows):
        x, baseline = corner.x, corner.y + y + max(piece.ascent for piece in row)
        for piece in row:
            piece.draw(x, baseline, theme.TEXT)
            x += piece.width + gap
        y = baseline - corner.y + max(piece.descent for piece in row) + row_gap
        widest = max(widest, x - gap - corner.x)
    extent = ImVec2(widest, max(0.0, y - row_gap))
    imgui.dummy(extent)
    return extent


def _hex(color: ImVec4) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in (color.x, color.y, color.z))
