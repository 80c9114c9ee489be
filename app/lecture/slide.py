"""A lecture's text on the screen: fonts, colours and sizes. flow.py has the layout."""

from __future__ import annotations

import functools
from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

from app.lecture.flow import Laid, Piece, PieceSize, fitted, lay
from app.lecture.notation import in_notation
from app.lecture.text import Block
from app.outside.growing import lit_in
from app.state.options import Notation
from app.widgets import theme
from app.widgets.formula import lit, vector_colors
from app.widgets.inline_math import inline_math
from app.widgets.lettering import lettering
from app.widgets.theme import Fonts, framebuffer_scale

ASCENT = 0.78  # of the line's height, in all our fonts
# Sizes of a step's type, in parts of the window's height.
LABEL = 0.028
TITLE = 0.07
LARGEST, SMALLEST = 0.052, 0.024  # of the text: as large as it has room
EXERCISE = 0.031  # of an exercise's, at least: larger where what is said to an answer has room
LEAST_PX = 13.0
SCROLLED_PX = 1_000_000  # as high as a text may be that is scrolled
SHORTEST_LINE, SHORTEST_ENLARGED = 20, 13  # letters a line: more are never too few to read


@dataclass(frozen=True)
class Sizes:
    """The type sizes of a step, in ImGui's pixels. text: the smallest and the largest that fit into
    its room; enlarged: the reader's own factor.
    """

    label: float
    title: float
    text: tuple[float, float]
    exercise: float
    enlarged: float
    most: float

    def as_asked(self, size: float) -> float:
        """Return a size that fits, enlarged as the reader has asked."""
        return min(size * self.enlarged, self.most)


def sizes_of(width: float, height: float, scale: float, dpi: float) -> Sizes:
    """Return the sizes for a column of that width in a window of that height.

    scale: of the type, which all text to read follows; the parts around it do not.
    """

    def part(of_height: float) -> float:
        return max(LEAST_PX * dpi, of_height * height)

    widest = max(LEAST_PX * dpi, 2 * width / SHORTEST_LINE)
    most = max(LEAST_PX * dpi, 2 * width / SHORTEST_ENLARGED)
    return Sizes(
        label=part(LABEL),
        title=part(TITLE),
        text=(part(SMALLEST), max(part(SMALLEST), min(part(LARGEST), widest))),
        exercise=min(part(EXERCISE), most),
        enlarged=scale,
        most=most,
    )


class Slides:
    """Draws texts, in a notation. Keeps the last layouts, because they take long to find."""

    def __init__(self, fonts: Fonts) -> None:
        self._fonts = fonts
        self.lit = ""  # the stage of the growing formula whose term is pointed out
        self.notation: Notation = "book"
        self._lay = functools.lru_cache(64)(self._laid)
        self._height = functools.lru_cache(1024)(self._height_of)

    def text(
        self,
        blocks: tuple[Block, ...],
        room: tuple[float, float],
        sizes_px: tuple[float, float],
        color: ImVec4 | None = None,
    ) -> float:
        """Draw a text at the cursor, as large as fits into the room, (width, height). Return its
        size.

        sizes_px: the smallest and the largest.
        """
        color = theme.TEXT if color is None else color
        room = (max(round(room[0]), 40), max(round(room[1]), 1))
        look = (framebuffer_scale(), theme.TEXT.x)
        laid, size = self._lay(self._read(blocks), room, sizes_px, look)
        corner = imgui.get_cursor_screen_pos()
        self._draw(laid, corner, color)
        imgui.dummy(ImVec2(min(laid.width, room[0]), laid.height))
        return size

    def fitting_px(
        self, blocks: tuple[Block, ...], room: tuple[float, float], sizes: Sizes
    ) -> float:
        """Return the size at which a text fills its room, or a larger one if the reader has asked
        for it.
        """
        room = (max(round(room[0]), 40), max(round(room[1]), 1))
        look = (framebuffer_scale(), theme.TEXT.x)
        blocks = self._read(blocks)
        _, size = self._lay(blocks, room, sizes.text, look)
        if sizes.enlarged <= 1.0:
            return size
        largest = max(size, min(size * sizes.enlarged, sizes.most))
        bar = imgui.get_style().scrollbar_size
        column = (max(room[0] - round(bar), 40), SCROLLED_PX)
        return self._lay(blocks, column, (min(size, sizes.most), largest), look)[1]

    def height(self, blocks: tuple[Block, ...], width: float, size_px: float) -> float:
        """Return the height of a text of that size."""
        look = (framebuffer_scale(), theme.TEXT.x)
        return self._height(self._read(blocks), max(width, 40.0), size_px, look)

    def _read(self, blocks: tuple[Block, ...]) -> tuple[Block, ...]:
        return in_notation(blocks, self.notation)

    def _height_of(
        self, blocks: tuple[Block, ...], width: float, size_px: float, look: tuple[float, ...]
    ) -> float:
        return lay(blocks, width, size_px, self._measure).height

    def _laid(
        self,
        blocks: tuple[Block, ...],
        room: tuple[float, float],
        sizes_px: tuple[float, float],
        look: tuple[float, ...],
    ) -> tuple[Laid, float]:
        return fitted(blocks, room, sizes_px, self._measure)

    def _measure(self, piece: Piece) -> PieceSize:
        with lettering(self._font(piece.style), piece.size):
            if piece.style == "math":
                made = inline_math(piece.text, piece.size, theme.TEXT, piece.display)
                return PieceSize(made.width, made.ascent, made.descent)
            width = imgui.calc_text_size(piece.text).x
            return PieceSize(width, ASCENT * piece.size, (1 - ASCENT) * piece.size)

    def _draw(self, laid: Laid, corner: ImVec2, color: ImVec4) -> None:
        draw = imgui.get_window_draw_list()
        for box in laid.boxes:
            low = ImVec2(corner.x + box.left, corner.y + box.top)
            high = ImVec2(corner.x + box.right, corner.y + box.bottom)
            fill = theme.FRAME if box.kind == "code" else theme.BACKGROUND
            draw.add_rect_filled(low, high, theme.u32(fill), theme.px(4))
            if box.kind == "question":
                edge = ImVec2(low.x + theme.px(4), high.y)
                draw.add_rect_filled(low, edge, theme.u32(theme.MARK), theme.px(2))
        for placed in laid.pieces:
            piece = placed.piece
            x, baseline = corner.x + placed.x, corner.y + placed.baseline
            ink = theme.DIM if placed.kind == "mark" else color
            with lettering(self._font(piece.style), piece.size):
                if piece.style == "math":
                    latex = lit(piece.text, lit_in(piece.text, self.lit, self.notation))
                    inline_math(latex, piece.size, theme.TEXT, piece.display).draw(x, baseline, ink)
                    continue
                if piece.style == "bold":
                    ink = self._vector_color(piece.text, ink)
                elif piece.style == "italic":
                    ink = theme.legible(theme.RAY)
                at = ImVec2(x, baseline - ASCENT * piece.size)
                draw.add_text(at, theme.u32(ink), piece.text)

    def _vector_color(self, word: str, ink: ImVec4) -> ImVec4:
        """Return the colour of a word: vectors have the same colours as in formulas."""
        color = vector_colors().get(word.strip(".,:;()"))
        return ink if color is None else theme.legible(color)

    def _font(self, style: str) -> imgui.ImFont | None:
        fonts = self._fonts
        return {"bold": fonts.bold, "code": fonts.mono}.get(style, fonts.text)
