"""A lecture's text on the screen: fonts, colours and sizes. flow.py has the layout."""

from __future__ import annotations

import functools

from imgui_bundle import ImVec2, ImVec4, imgui

from app.lecture.flow import Laid, Piece, PieceSize, lay
from app.lecture.notation import in_notation
from app.lecture.text import Block
from app.outside.growing import lit_in
from app.state.options import Notation
from app.widgets import theme
from app.widgets.areas import press_area
from app.widgets.formula import lit, vector_colors
from app.widgets.inline_math import inline_math
from app.widgets.lettering import lettering
from app.widgets.theme import Fonts, framebuffer_scale

ASCENT = 0.78  # of the line's height, in all our fonts
TITLE = 1.4  # of a step's title, in parts of the type's size


class Slides:
    """Draws texts, in a notation. Keeps the last layouts, because they take long to find."""

    def __init__(self, fonts: Fonts) -> None:
        self._fonts = fonts
        self.lit = ""  # the stage of the growing formula whose term is pointed out
        self.notation: Notation = "book"
        self._lay = functools.lru_cache(256)(self._laid)
        self._link = ""

    def take_link(self) -> str:
        """Return the name of the link that was clicked since the last call, or an empty text."""
        link, self._link = self._link, ""
        return link

    def text(
        self,
        blocks: tuple[Block, ...],
        width: float,
        color: ImVec4 | None = None,
        stage: int = 0,
        seek: bool = False,
    ) -> None:
        """Draw a text at the cursor.

        stage: how much of it is uncovered; the rest keeps its room.
        seek: scroll to what was uncovered last.
        """
        laid, corner = self._of(blocks, width), imgui.get_cursor_screen_pos()
        self._draw(laid, corner, theme.TEXT if color is None else color, stage)
        if seek and stage:
            last = max((p.baseline for p in laid.pieces if p.stage == stage), default=0.0)
            imgui.set_scroll_from_pos_y(corner.y + last - imgui.get_window_pos().y, 0.9)
        imgui.dummy(ImVec2(min(laid.width, width), laid.height))

    def height(self, blocks: tuple[Block, ...], width: float) -> float:
        """Return the height of a text."""
        return self._of(blocks, width).height

    def _of(self, blocks: tuple[Block, ...], width: float) -> Laid:
        look = (framebuffer_scale(), theme.TEXT.x)
        return self._lay(
            in_notation(blocks, self.notation), max(round(width), 40), theme.type_px(), look
        )

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

    def _draw(self, laid: Laid, corner: ImVec2, color: ImVec4, stage: int) -> None:
        draw = imgui.get_window_draw_list()
        for box in (box for box in laid.boxes if box.stage <= stage):
            low = ImVec2(corner.x + box.left, corner.y + box.top)
            high = ImVec2(corner.x + box.right, corner.y + box.bottom)
            fill = theme.FRAME if box.kind == "code" else theme.BACKGROUND
            if box.kind == "question":  # whose answer goes on below
                draw.add_rect_filled(low, high, theme.u32(fill))
                edge = ImVec2(low.x + theme.px(4), high.y)
                draw.add_rect_filled(low, edge, theme.u32(theme.MARK))
            else:
                draw.add_rect_filled(low, high, theme.u32(fill), theme.px(4))
        for number, placed in enumerate(laid.pieces):
            piece = placed.piece
            if placed.stage > stage:
                continue
            x, baseline = corner.x + placed.x, corner.y + placed.baseline
            ink = theme.DIM if placed.kind == "mark" else color
            with lettering(self._font(piece.style), piece.size / theme.type_px()):
                if piece.style == "math":
                    latex = lit(piece.text, lit_in(piece.text, self.lit, self.notation))
                    inline_math(latex, piece.size, theme.TEXT, piece.display).draw(x, baseline, ink)
                    continue
                if piece.style == "vector":
                    ink = self._vector_color(piece.text, ink)
                elif piece.style == "italic":
                    ink = theme.legible(theme.RAY)
                at = ImVec2(x, baseline - ASCENT * piece.size)
                if piece.link:
                    ink = self._linked(piece, number, at)
                draw.add_text(at, theme.u32(ink), piece.text)

    def _linked(self, piece: Piece, number: int, at: ImVec2) -> ImVec4:
        """Underline a link's word, and notice a click on it. Return its colour."""
        width, after = imgui.calc_text_size(piece.text).x, imgui.get_cursor_screen_pos()
        imgui.set_cursor_screen_pos(at)
        if press_area(f"{piece.text}##{number}", ImVec2(width, piece.size)):
            self._link = piece.link
        color = theme.TEXT if imgui.is_item_hovered() else theme.legible(theme.BASIS["w"])
        if imgui.is_item_hovered():
            imgui.set_mouse_cursor(imgui.MouseCursor_.hand)
        imgui.set_cursor_screen_pos(after)
        low = at.y + piece.size
        draw = imgui.get_window_draw_list()
        ends = ImVec2(at.x, low), ImVec2(at.x + width, low)
        draw.add_line(*ends, theme.u32(color), theme.line_px(1))
        return color

    def _vector_color(self, word: str, ink: ImVec4) -> ImVec4:
        """Return the colour of a word: vectors have the same colours as in formulas."""
        color = vector_colors().get(word.strip(".,:;()"))
        return ink if color is None else theme.legible(color)

    def _font(self, style: str) -> imgui.ImFont | None:
        fonts = self._fonts
        return {"bold": fonts.bold, "vector": fonts.bold, "code": fonts.mono}.get(style, fonts.text)
