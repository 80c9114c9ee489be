"""Formulas, typeset and wrapped to the window's width; plain text if they cannot be typeset.

Caches the pictures of formulas, and finds places to break long ones. MicroTeX needs the locale
en_US.UTF-8; without it the formulas are plain text.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import imgui_bundle
from imgui_bundle import ImVec2, ImVec4, imgui, imgui_microtex

from lucida.app.ui import theme
from lucida.app.ui.explaining.breaking import breakable
from lucida.app.ui.explaining.plain import plain_math
from lucida.app.ui.theme import framebuffer_scale

ROW_GAP = 0.35  # between the rows of one formula, in parts of its type's size
MOST_EXTENTS = 500
_extents: dict[tuple[str, float, float], ImVec2] = {}  # the room that formulas took last


@dataclass(frozen=True)
class _Piece:
    """A part of a row. baseline: below its upper edge."""

    width: float
    height: float
    baseline: float
    draw: Callable[[ImVec2], None]


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


def formula(
    parts: Iterable[str], size_px: float, key: str = "", color: ImVec4 | None = None
) -> None:
    """Draw formulas, as LaTeX without dollar signs, one after another, as many in a row as fit.

    size_px: of the type.
    key: a name for the formulas that stays the same while their numbers change. When out of sight,
    they keep their last size.
    color: for uncoloured symbols; None for the text's.
    """
    color = theme.TEXT if color is None else color
    room = max(1.0, imgui.get_content_region_avail().x)
    place = (key, room, size_px)
    if key and (known := _extents.get(place)) is not None and not imgui.is_rect_visible(known):
        imgui.dummy(known)
        return
    rows: list[list[_Piece]] = [[]]
    gap = 0.22 * size_px
    for part in parts:
        pieces = _pieces(part, size_px, color, room)
        whole = sum(piece.width for piece in pieces) + gap * (len(pieces) - 1)
        # A part that has room in a row of its own is not broken for the sake of the last one; one
        # that does not go on with an equals sign begins a row.
        full = _width(rows[-1], gap) + gap + whole > room >= whole
        if rows[-1] and (full or not part.startswith("=")):
            rows.append([])
        for piece in pieces:
            if rows[-1] and _width(rows[-1], gap) + gap + piece.width > room:
                rows.append([])
            rows[-1].append(piece)
    extent = _draw_rows(rows, gap, ROW_GAP * size_px)
    if key:
        if len(_extents) >= MOST_EXTENTS:
            _extents.clear()
        _extents[place] = extent


def lit(latex: str, part: str) -> str:
    """Return a formula with one of its parts on a ground of its own; unchanged without a part."""
    ground = _hex(theme.FRAME_ACTIVE)
    return latex.replace(part, rf"\bgcolor{{{ground}}}{{{part}}}", 1) if part else latex


def vector_colors() -> dict[str, ImVec4]:
    """Return the colours of vectors by their names in both notations."""
    ray = dict.fromkeys(("p", "d", "r", "origin", "direction"), theme.RAY)
    plain = dict.fromkeys(("e", "eye"), theme.TEXT)
    return theme.BASIS | ray | dict.fromkeys(("x", "point"), theme.MARK) | plain


def tinted(latex: str) -> str:
    """Return the formula in the colour language: u, v, w, the ray, the hit."""
    return _tinted(latex, theme.used())


@functools.lru_cache(maxsize=1024)
def _tinted(latex: str, _look: theme.WindowLook) -> str:
    """Return the formula in the colours of a look, which is in use."""
    for name, color in vector_colors().items():
        symbol = rf"\mathbf{{{name}}}"
        latex = latex.replace(symbol, rf"\fgcolor{{{_hex(theme.legible(color))}}}{{{symbol}}}")
    return latex


def _pieces(whole: str, size_px: float, color: ImVec4, room: float) -> list[_Piece]:
    """Return a formula's pieces, none wider than the room: broken at sums, and at products if
    necessary.
    """
    pieces: list[_Piece] = []
    for cut in breakable(whole):
        piece = _piece(cut, size_px, color)
        if piece.width > room and len(factors := _factors(cut)) > 1:
            pieces += [_piece(factor, size_px, color, room) for factor in factors]
        else:
            pieces.append(_piece(cut, size_px, color, room))
    return pieces


def _factors(product: str) -> list[str]:
    """Split a product of bracketed terms between them."""
    return product.replace(r")\,", ")\n").split("\n")


def _piece(text: str, size_px: float, color: ImVec4, room: float = math.inf) -> _Piece:
    """Return a piece, scaled down if it does not fit."""
    if not available():
        return _text_piece(plain_math(text), color)
    scale = framebuffer_scale()
    if text[:2] in ("+ ", "- "):  # at the beginning it would be a sign, without a sum's space
        text = rf"{text[0]}\;{text[2:]}"
    picture = imgui_microtex.render_to_texture(
        tinted(text), size_px * scale, color, imgui_microtex.TexStyle.display
    )
    shrunk = min(1.0, room * scale / max(1, picture.width)) / scale
    width, height = picture.width * shrunk, picture.height * shrunk
    number = picture.texture_id()

    def draw(at: ImVec2) -> None:
        corner = ImVec2(round(at.x * scale) / scale, round(at.y * scale) / scale)
        imgui.get_window_draw_list().add_image(
            imgui.ImTextureRef(number), corner, ImVec2(corner.x + width, corner.y + height)
        )

    return _Piece(width, height, picture.baseline_y * shrunk, draw)


def _text_piece(text: str, color: ImVec4) -> _Piece:
    size = imgui.calc_text_size(text)

    def draw(at: ImVec2) -> None:
        imgui.get_window_draw_list().add_text(at, theme.u32(color), text)

    return _Piece(size.x, size.y, 0.8 * size.y, draw)


def _width(row: list[_Piece], gap: float) -> float:
    return sum(piece.width for piece in row) + gap * (len(row) - 1)


def _draw_rows(rows: list[list[_Piece]], gap: float, row_gap: float) -> ImVec2:
    """Draw the rows. Return the size they take."""
    corner = imgui.get_cursor_screen_pos()
    y = corner.y
    widest = 0.0
    for row in rows:
        if not row:
            continue
        above = max(piece.baseline for piece in row)
        x = corner.x
        for piece in row:
            piece.draw(ImVec2(x, y + above - piece.baseline))
            x += piece.width + gap
        y += above + max(piece.height - piece.baseline for piece in row) + row_gap
        widest = max(widest, x - gap - corner.x)
    extent = ImVec2(widest, max(0.0, y - row_gap - corner.y))
    imgui.dummy(extent)
    return extent


def _hex(color: ImVec4) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in (color.x, color.y, color.z))
