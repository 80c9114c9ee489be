"""A lecture's text on the screen: fonts, colours and sizes. flow.py has the layout."""

from __future__ import annotations

import functools
from collections.abc import Iterable

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.instruments.outside.growing import lit_in
from lucida.app.ui import theme
from lucida.app.ui.formula import inline_math, lit, vector_colors
from lucida.app.ui.lettering import lettering
from lucida.app.ui.theme import Fonts, framebuffer_scale

from .flow import Backdrop, Laid, Piece, PieceSize, Placed, lay
from .text import Block

ASCENT = 0.78  # of the line's height, in all our fonts
# Sizes relative to the window's type: a step's title, and its text, of which the largest that fits.
TITLE, LARGER = 1.5, (1.4, 1.3, 1.2, 1.1)


class Slides:
    """A painter of texts that keeps the last layouts, because they take long to compute.

    larger: the size of the texts' type, relative to the window's.
    """

    def __init__(self, fonts: Fonts) -> None:
        self._fonts = fonts
        self.larger = 1.0
        self.lit = ""  # the stage of the growing formula whose term is highlighted
        self._lay = functools.lru_cache(256)(self._laid)

    def text(
        self,
        blocks: tuple[Block, ...],
        width: float,
        color: ImVec4 | None = None,
        before: tuple[Block, ...] | None = None,
        alpha: float = 1.0,
    ) -> None:
        """Draw a text at the cursor.

        before: the part that does not fade in; None for all.
        alpha: the opacity of the rest.
        """
        laid, corner = self._of(blocks, width), imgui.get_cursor_screen_pos()
        old = laid if before is None else self._of(before, width)
        pieces, boxes = len(old.pieces), len(old.boxes)
        ink = theme.TEXT if color is None else color
        self._draw(laid.pieces[:pieces], laid.boxes[:boxes], corner, ink)
        imgui.push_style_var(imgui.StyleVar_.alpha, alpha)
        self._draw(laid.pieces[pieces:], laid.boxes[boxes:], corner, ink)
        imgui.pop_style_var()
        imgui.dummy(ImVec2(min(laid.width, width), laid.height))

    def height(self, blocks: tuple[Block, ...], width: float) -> float:
        """Return the height of a text."""
        return self._of(blocks, width).height

    def fit(self, texts: Iterable[tuple[Block, ...]], width: float, height: float) -> None:
        """Set the largest size at which each text fits, without breaking a formula or a line of
        code that the window's own size does not break.
        """
        for self.larger in (*LARGER, 1.0):
            if all(self._fits(blocks, width, height) for blocks in texts):
                return

    def _fits(self, blocks: tuple[Block, ...], width: float, height: float) -> bool:
        laid, usual = self._of(blocks, width), self._of(blocks, width, 1.0)
        return laid.height <= height and laid.width <= width and _rows(laid) == _rows(usual)

    def _of(self, blocks: tuple[Block, ...], width: float, larger: float = 0.0) -> Laid:
        look = (framebuffer_scale(), theme.TEXT.x)
        size_px = theme.whole_px(theme.type_px() * (larger or self.larger))
        return self._lay(blocks, max(round(width), 40), size_px, look)

    def _laid(
        self, blocks: tuple[Block, ...], width: float, size_px: float, look: tuple[float, ...]
    ) -> Laid:
        return lay(blocks, width, size_px, self._measure)

    def _measure(self, piece: Piece) -> PieceSize:
        with lettering(self._font(piece.style), piece.size / theme.type_px()):
            if piece.style == "math":
                made = inline_math(piece.text, piece.size, theme.TEXT, piece.display)
                return PieceSize(made.width, made.ascent, made.descent)
            width = imgui.calc_text_size(piece.text).x
            return PieceSize(width, ASCENT * piece.size, (1 - ASCENT) * piece.size)

    def _draw(
        self,
        pieces: tuple[Placed, ...],
        boxes: tuple[Backdrop, ...],
        corner: ImVec2,
        color: ImVec4,
    ) -> None:
        draw = imgui.get_window_draw_list()
        for box in boxes:
            low = ImVec2(corner.x + box.left, corner.y + box.top)
            high = ImVec2(corner.x + box.right, corner.y + box.bottom)
            fill = theme.FRAME if box.kind == "code" else theme.BACKGROUND
            if box.kind == "question":
                draw.add_rect_filled(low, high, theme.u32(fill))
                edge = ImVec2(low.x + theme.px(4), high.y)
                draw.add_rect_filled(low, edge, theme.u32(theme.MARK))
            else:
                draw.add_rect_filled(low, high, theme.u32(fill), theme.px(4))
        for placed in pieces:
            piece = placed.piece
            x, baseline = corner.x + placed.x, corner.y + placed.baseline
            ink = theme.DIM if placed.kind == "mark" else color
            with lettering(self._font(piece.style), piece.size / theme.type_px()):
                if piece.style == "math":
                    latex = lit(piece.text, lit_in(piece.text, self.lit))
                    inline_math(latex, piece.size, theme.TEXT, piece.display).draw(x, baseline, ink)
                    continue
                if piece.style == "vector":
                    ink = self._vector_color(piece.text, ink)
                elif piece.style == "italic":
                    ink = theme.legible(theme.RAY)
                at = ImVec2(x, baseline - ASCENT * piece.size)
                draw.add_text(at, theme.u32(ink), piece.text)

    def _vector_color(self, word: str, ink: ImVec4) -> ImVec4:
        """Return the colour of a word; vectors have the same colours as in formulas."""
        color = vector_colors().get(word.strip(".,:;()"))
        return ink if color is None else theme.legible(color)

    def _font(self, style: str) -> imgui.ImFont | None:
        fonts = self._fonts
        return {"bold": fonts.bold, "vector": fonts.bold, "code": fonts.mono}.get(style, fonts.text)


def _rows(laid: Laid) -> int:
    """Count the rows of formulas and code."""
    return sum(placed.kind in ("formula", "code") for placed in laid.pieces)
