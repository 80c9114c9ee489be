"""The window's theme: colours, fonts, spacing, type size.

palettes.py has the colours. theme.RAY, theme.TEXT and the others are those of the current palette:
read them when you draw, never at import.
"""

from __future__ import annotations

import functools
import math
import os
from dataclasses import dataclass, fields
from typing import Any

from imgui_bundle import ImVec2, ImVec4, hello_imgui, imgui

from lucida.app.state.options.shared import Preferences

from .contrast import LEGIBLE, SEEN, Rgb, legible_on
from .palettes import DARK, LIGHT, PRESENTED_DARK, PRESENTED_LIGHT, Palette
from .palettes import rgb as rgb  # modules that draw use it as theme.rgb

TEXT_PX = 16.0
ATLAS_PX = 1024  # the side of the letters' texture, at least
CAPITAL = 0.591  # the least height of capitals in our fonts, as a fraction of the type size
# The type size as a fraction of the window's height. The least in a hall makes capitals 1/50 of the
# height; the largest is 200 % in a window 720 high, and 300 % in one 1080 high.
HALL, LARGEST = 0.02 / CAPITAL, 0.0445


@dataclass(frozen=True)
class WindowLook:
    """The settings of the style. scale: the factor of type and spacing, without the display's."""

    theme: str = "dark"
    presentation: bool = False
    scale: float = 1.0

    @functools.cached_property
    def palette(self) -> Palette:
        if self.theme == "light":
            return PRESENTED_LIGHT if self.presentation else LIGHT
        return PRESENTED_DARK if self.presentation else DARK


# The sizes of ImGui's style at 100 %.
SIZES = {
    "window_padding": (10, 8),
    "frame_padding": (6, 4),
    "item_spacing": (6, 5),
    "item_inner_spacing": (6, 4),
    "cell_padding": (4, 2),
    "frame_border_size": 0,
    "frame_rounding": 3,
    "window_rounding": 4,
    "popup_rounding": 4,
    "tab_rounding": 3,
    "grab_rounding": 2,
    "window_border_size": 1,
    "popup_border_size": 1,
    "tab_bar_border_size": 1,
    "tab_min_width_shrink": 14,  # tabs shrink to their first letter before any is out of sight
    "docking_separator_size": 2,
    "hover_stationary_delay": 0.3,
}
_NAMES = {field.name for field in fields(Palette)}
UNSEEN = ImVec4(0, 0, 0, 0)
# The look in use is the only entry, because a process has one window.
_used: list[WindowLook] = [WindowLook()]


def __getattr__(name: str) -> Any:
    """Return the colours of the current palette, as attributes of the module."""
    if name in _NAMES:
        return getattr(_used[0].palette, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def look_of(
    preferences: Preferences, height_px: float, dpi_scale: float = 1.0, in_lecture: bool = False
) -> WindowLook:
    """Return the look for the preferences and a window of this height, in ImGui's pixels.

    Its scale sets the type size everywhere: only titles are larger, and nothing is smaller. In a
    lecture it suits a hall, in presentation mode or not.
    """
    wanted, usual, largest = preferences.font_scale, TEXT_PX * dpi_scale, LARGEST * height_px
    size = max(usual * min(wanted, 1.0), min(usual * wanted, largest))
    if preferences.presentation or in_lecture:
        size = max(size, min(math.ceil(HALL * height_px) * max(wanted, 1.0), largest))
    return WindowLook(preferences.theme, preferences.presentation, round(size / usual, 4))


def used() -> WindowLook:
    """Return the current look, from which colours are read; use it as a cache key.

    Do not use the preferences: they change first, and the look follows when a frame is drawn.
    """
    return _used[0]


def follow(preferences: Preferences, in_lecture: bool = False) -> None:
    """Apply changed preferences, or a changed height of the window. Call before a frame."""
    style = imgui.get_style()
    height_px = imgui.get_io().display_size.y
    look = look_of(preferences, height_px, style.font_scale_dpi, in_lecture)
    scale = style.font_scale_dpi * look.scale
    # HelloImGui scales the sizes to the display in its second frame in any case.
    if height_px <= 0 or (
        look == _used[0] and math.isclose(style._main_scale, scale, abs_tol=1e-3)  # noqa: SLF001, no public way
    ):
        return
    _used[0] = look
    kept = style.font_scale_dpi, style.font_size_base
    _set_style()
    style.font_scale_dpi, style.font_size_base = kept
    style.scale_all_sizes(scale)
    style.font_scale_main = look.scale


def begin(preferences: Preferences) -> None:
    """Set the first style. HelloImGui scales it to the display's DPI, follow() to the
    preferences.
    """
    _used[0] = WindowLook(preferences.theme)
    _set_style()


# The system's fonts for letters that the window's own fonts lack: Chinese, Japanese and Korean;
# Arabic, combining marks and others. The first existing font of each group is used.
SYSTEM_FONTS = (
    (
        "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/google-noto-sans-cjk-fonts/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
        "/System/Library/Fonts/Supplemental/Arial Unicode.ttf",
        "C:/Windows/Fonts/msyh.ttc",
    ),
    (
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "C:/Windows/Fonts/segoeui.ttf",
    ),
)


def _load_font(file: str, params: hello_imgui.FontLoadingParams | None = None) -> imgui.ImFont:
    """Return a font of the window's own, with the system's for the letters that it lacks."""
    font = hello_imgui.load_font(f"fonts/{file}", TEXT_PX, params)
    merged = hello_imgui.FontLoadingParams()
    merged.inside_assets, merged.merge_to_last_font = False, True
    for files in SYSTEM_FONTS:
        if found := next(filter(os.path.isfile, files), ""):
            hello_imgui.load_font(found, TEXT_PX, merged)
    return font


@dataclass
class Fonts:
    """The window's fonts, once loaded: text, bold for headings, fixed width for numbers."""

    text: imgui.ImFont | None = None
    bold: imgui.ImFont | None = None
    mono: imgui.ImFont | None = None

    def load(self) -> None:
        """Load the fonts. Called by HelloImGui.

        The atlas has space for all sizes from the beginning. When it grows, ImGui discards sizes
        and moves the others in memory, and its FreeType loader then draws some letters too small.
        """
        atlas = imgui.get_io().fonts
        atlas.tex_min_width = atlas.tex_min_height = ATLAS_PX
        self.text = _load_font("Roboto/Roboto-Regular.ttf")
        self.bold = _load_font("Roboto/Roboto-Bold.ttf")
        raised = hello_imgui.FontLoadingParams()
        raised.font_config.glyph_offset = ImVec2(0, -1)  # its digits are lower than Roboto's
        raised.font_config.extra_size_scale = 1.03  # and its capitals would be lower
        self.mono = _load_font("Inconsolata-Medium.ttf", raised)


def _set_style() -> None:
    """Set ImGui's style for the current palette: flat, aligned; at 100 %."""
    look = _used[0]
    colors = look.palette
    # Reset all sizes, since a theme does not set all of them. Each change would scale them again:
    # the smallest window would soon exceed the screen, and a tab's x would be as thick as wide.
    fresh = imgui.Style()
    for name in dir(fresh):
        value = getattr(fresh, name)
        if isinstance(value, float | ImVec2) and not name.startswith(("_next", "font_")):
            setattr(imgui.get_style(), name, value)
    base = hello_imgui.ImGuiTheme_
    hello_imgui.apply_theme(
        base.imgui_colors_light if look.theme == "light" else base.darcula_darker
    )
    style, col = imgui.get_style(), imgui.Col_
    for name, size in SIZES.items():
        setattr(style, name, ImVec2(*size) if isinstance(size, tuple) else size)
    style.window_menu_button_position = imgui.Dir.none
    accent = colors.ACCENT * (1, 1, 1, 0.5)
    for color, slots in (
        (colors.TEXT, (col.text, col.text_link, col.check_mark)),
        (colors.DIM, (col.text_disabled,)),
        (colors.BACKGROUND, (col.menu_bar_bg, col.docking_empty_bg, col.title_bg)),
        (colors.BACKGROUND, (col.title_bg_active, col.title_bg_collapsed)),
        (colors.BACKGROUND, (col.tab, col.tab_dimmed)),
        (colors.PANEL, (col.window_bg, col.child_bg, col.scrollbar_bg)),
        (colors.PANEL, (col.tab_selected, col.tab_dimmed_selected)),
        (colors.POPUP, (col.popup_bg,)),
        (colors.LINE, (col.border, col.separator, col.tab_dimmed_selected_overline)),
        (colors.LINE, (col.table_border_light, col.table_border_strong)),
        (colors.FRAME, (col.frame_bg, col.button, col.header, col.table_header_bg)),
        (colors.FRAME_HOVERED, (col.frame_bg_hovered, col.tab_hovered)),
        (colors.FRAME_HOVERED, (col.button_hovered, col.header_hovered)),
        (colors.FRAME_ACTIVE, (col.frame_bg_active, col.button_active, col.header_active)),
        (colors.FRAME_ACTIVE, (col.scrollbar_grab,)),
        (colors.PLAIN, (col.scrollbar_grab_hovered, col.scrollbar_grab_active)),
        (colors.ACCENT, (col.tab_selected_overline,)),
        (colors.FILL, (col.slider_grab, col.slider_grab_active)),
        (accent, (col.text_selected_bg,)),
        (colors.RAY * (1, 1, 1, 0), (col.nav_cursor,)),  # focus_frame.py draws one
    ):
        for slot in slots:
            style.set_color_(slot, color)


def u32(color: ImVec4, alpha: float = 1.0) -> int:
    """Return a colour in the form that draw lists take."""
    return imgui.get_color_u32(color if alpha == 1.0 else color * (1, 1, 1, alpha))


def type_px() -> float:
    """Return the window's type size, in ImGui's pixels."""
    style = imgui.get_style()
    return float(TEXT_PX * style.font_scale_main * style.font_scale_dpi)


def px(at_100_percent: float) -> float:
    """Return a length in ImGui's pixels that grows with the type: 16 is the height of a line of
    text.
    """
    return at_100_percent * imgui.get_font_size() / TEXT_PX


def whole_px(size: float) -> float:
    """Return the nearest type size of whole framebuffer pixels.

    ImGui stretches the letters of any other size, and shows parts of their neighbours at their
    edges.
    """
    scale = framebuffer_scale()
    return max(1.0, round(size * scale)) / scale


def line_px(at_100_percent: float = 1.0) -> float:
    """Return the width of a line that teaches: scaled, and thicker in presentation mode."""
    style = imgui.get_style()
    width: float = at_100_percent * _used[0].palette.LINE_WIDTH
    return width * style.font_scale_main * style.font_scale_dpi


def legible(color: ImVec4) -> ImVec4:
    """Return the colour for text: yellow and orange are darkened in the light themes.

    It is legible even on a highlight, the background that is hardest to read on.
    """
    return seen_on(color, _rgb(_used[0].palette.LIT), LEGIBLE)


def seen(color: ImVec4) -> ImVec4:
    """Return the colour for a line or a mark on a panel."""
    return seen_on(color, _rgb(_used[0].palette.PANEL))


def seen_on(color: ImVec4, ground: Rgb, least: float = SEEN) -> ImVec4:
    """Return the colour, lighter or darker if its contrast with the ground is less than `least`."""
    return ImVec4(*legible_on(_rgb(color), ground, least), color.w)


def _rgb(color: ImVec4) -> Rgb:
    return color.x, color.y, color.z


def framebuffer_scale() -> float:
    """Return the number of framebuffer pixels in one unit of ImGui's coordinates."""
    return imgui.get_io().display_framebuffer_scale.x or 1.0
