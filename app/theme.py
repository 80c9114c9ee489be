"""How the window looks: colours, fonts, spacing.

Owns the colour language, the same in every place: u, v, w after Okabe and Ito, rays in orange,
hits and the marked pixel in yellow. Knows nothing of what is shown.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, hello_imgui, imgui

TEXT_PX = 16.0


def rgb(text: str, alpha: float = 1.0) -> ImVec4:
    """`#d55e00` as a colour."""
    red, green, blue = (int(text[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return ImVec4(red, green, blue, alpha)


# Okabe and Ito's colours; blue is lightened, or it drowns in the dark background.
BASIS = {"u": rgb("#d55e00"), "v": rgb("#009e73"), "w": rgb("#3f9be0")}
RAY = rgb("#e69f00")
MARK = rgb("#f0e442")
PLAIN = rgb("#9aa3ad")
TEXT = rgb("#e8eaed")
DIM = rgb("#a3abb5")
ERROR = rgb("#ff8a65")
BACKGROUND = rgb("#16181b")
PANEL = rgb("#1e2125")
FRAME = rgb("#2b3036")
FRAME_HOVERED = rgb("#373d45")
FRAME_ACTIVE = rgb("#434b55")
LINE = rgb("#3a4048")
ACCENT = rgb("#4d6a86")


@dataclass
class Fonts:
    """The window's fonts, once loaded: text, bold for headings, fixed width for numbers."""

    text: imgui.ImFont | None = None
    bold: imgui.ImFont | None = None
    mono: imgui.ImFont | None = None

    def load(self) -> None:
        """Called by HelloImGui when it loads fonts."""
        self.text = hello_imgui.load_font("fonts/Roboto/Roboto-Regular.ttf", TEXT_PX)
        self.bold = hello_imgui.load_font("fonts/Roboto/Roboto-Bold.ttf", TEXT_PX)
        raised = hello_imgui.FontLoadingParams()
        raised.font_config.glyph_offset = ImVec2(0, -1)  # its digits sit low beside Roboto's
        self.mono = hello_imgui.load_font("fonts/Inconsolata-Medium.ttf", TEXT_PX, raised)


def apply() -> None:
    """Sets ImGui's style: dark, flat, aligned."""
    hello_imgui.apply_theme(hello_imgui.ImGuiTheme_.darcula_darker)
    style = imgui.get_style()
    style.window_padding = ImVec2(10, 8)
    style.frame_padding = ImVec2(6, 4)
    style.item_spacing = ImVec2(6, 5)
    style.item_inner_spacing = ImVec2(6, 4)
    style.window_menu_button_position = imgui.Dir.none
    style.frame_rounding = 3
    style.window_rounding = 4
    style.popup_rounding = 4
    style.tab_rounding = 3
    style.grab_rounding = 2
    style.window_border_size = 1
    style.frame_border_size = 0
    style.tab_bar_border_size = 1
    style.docking_separator_size = 2
    style.hover_stationary_delay = 0.3
    colors = {
        imgui.Col_.text: TEXT,
        imgui.Col_.text_disabled: DIM,
        imgui.Col_.window_bg: PANEL,
        imgui.Col_.child_bg: PANEL,
        imgui.Col_.popup_bg: rgb("#24282d"),
        imgui.Col_.menu_bar_bg: BACKGROUND,
        imgui.Col_.docking_empty_bg: BACKGROUND,
        imgui.Col_.border: LINE,
        imgui.Col_.separator: LINE,
        imgui.Col_.frame_bg: FRAME,
        imgui.Col_.frame_bg_hovered: FRAME_HOVERED,
        imgui.Col_.frame_bg_active: FRAME_ACTIVE,
        imgui.Col_.title_bg: BACKGROUND,
        imgui.Col_.title_bg_active: BACKGROUND,
        imgui.Col_.title_bg_collapsed: BACKGROUND,
        imgui.Col_.tab: BACKGROUND,
        imgui.Col_.tab_hovered: FRAME_HOVERED,
        imgui.Col_.tab_selected: PANEL,
        imgui.Col_.tab_dimmed: BACKGROUND,
        imgui.Col_.tab_dimmed_selected: PANEL,
        imgui.Col_.tab_selected_overline: ACCENT,
        imgui.Col_.tab_dimmed_selected_overline: LINE,
        imgui.Col_.button: FRAME,
        imgui.Col_.button_hovered: FRAME_HOVERED,
        imgui.Col_.button_active: FRAME_ACTIVE,
        imgui.Col_.header: FRAME,
        imgui.Col_.header_hovered: FRAME_HOVERED,
        imgui.Col_.header_active: FRAME_ACTIVE,
        imgui.Col_.check_mark: TEXT,
        imgui.Col_.nav_cursor: ACCENT,
    }
    for slot, color in colors.items():
        style.set_color_(slot, color)


def u32(color: ImVec4, alpha: float = 1.0) -> int:
    """A colour as draw lists take it."""
    return imgui.get_color_u32(ImVec4(color.x, color.y, color.z, color.w * alpha))
