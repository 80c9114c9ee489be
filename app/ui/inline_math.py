"""Formulas within lines of text, set by MicroTeX; plain text where that does not work.

formula.py has colours and availability, explaining/plain.py the plain text.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui, imgui_microtex

from lucida.app.ui import formula, theme
from lucida.app.ui.explaining.plain import plain_math
from lucida.app.ui.theme import framebuffer_scale


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
        """Draw the formula. color: of plain text; a picture has its own."""
        draw = imgui.get_window_draw_list()
        if self.picture is None:
            draw.add_text((x, baseline - self.ascent), theme.u32(color), self.text)
            return
        scale = framebuffer_scale()
        corner = ImVec2(round(x * scale), round((baseline - self.ascent) * scale)) / scale
        far = corner + ImVec2(self.width, self.ascent + self.descent)
        texture = imgui.ImTextureRef(self.picture.texture_id())
        draw.add_image(texture, corner, far, (0, 0), (1, 1), theme.u32(ImVec4(1, 1, 1, 1)))


def inline_math(latex: str, size_px: float, color: ImVec4, display: bool = False) -> Setting:
    """Typeset a formula in text of size_px. Call it every frame.

    If MicroTeX rejects it, it is plain text in the current font.
    display: set it as between $$.
    """
    scale = framebuffer_scale()
    if formula.available():
        style = imgui_microtex.TexStyle.display if display else imgui_microtex.TexStyle.text
        try:
            made = imgui_microtex.render_to_texture(
                formula.tinted(latex), size_px * scale, color, style
            )
        except RuntimeError:
            made = None
        if made is not None and made.width > 0:
            ascent = made.baseline_y / scale
            return Setting(made.width / scale, ascent, made.height / scale - ascent, made)
    text = plain_math(latex)
    extent = imgui.calc_text_size(text)
    return Setting(extent.x, 0.8 * extent.y, 0.2 * extent.y, None, text)
