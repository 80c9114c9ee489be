"""The status line: both renderers' times, the agreement, the scene, the pixel under the mouse.

Owns its words. Numbers are set in a fixed width, so that nothing moves while they change.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app import theme


@dataclass(frozen=True)
class Status:
    """What the line tells. size: of the full image. factor: how coarse the ray image is, 1 for
    full, 0 for none; raster_factor: likewise. agreement: a text, empty while unknown; agrees:
    whether it is good news."""

    raster_s: float
    raster_factor: int
    ray_s: float
    size: tuple[int, int]
    factor: int
    agreement: str
    agrees: bool
    scene: str
    pixel: tuple[int, int] | None = None
    seen: str = ""
    message: str = ""


def status_line(status: Status, fonts: theme.Fonts) -> None:
    """Draws the line; call in HelloImGui's show_status."""
    imgui.push_font(fonts.mono, 0.0)
    coarseness = f" 1/{status.raster_factor}" if status.raster_factor > 1 else "    "
    parts = [
        (f"raster {milliseconds(status.raster_s)}{coarseness}", theme.TEXT),
        (ray_text(status), theme.TEXT),
    ]
    good = theme.rgb("#35c497") if status.agrees else theme.ERROR
    parts.append((status.agreement or "agree: ...", good if status.agreement else theme.DIM))
    parts.append((f"scene: {status.scene}", theme.TEXT))
    for index, (text, color) in enumerate(parts):
        if index:
            _divider()
        imgui.align_text_to_frame_padding()
        imgui.text_colored(color, text)
    right, color = pixel_text(status), theme.MARK
    if status.message:
        right, color = status.message, theme.ERROR
    if right:
        width = imgui.calc_text_size(right).x
        imgui.same_line(imgui.get_window_width() - width - imgui.get_style().window_padding.x)
        imgui.text_colored(color, right)
    imgui.pop_font()


def milliseconds(time_s: float) -> str:
    """Eight characters: ` 12.3 ms`."""
    ms = time_s * 1e3
    return f"{ms:5.1f} ms" if ms < 1000 else f"{time_s:5.1f} s "


def ray_text(status: Status) -> str:
    """The ray image's time, size and how far it is refined, of constant width."""
    width, height = status.size
    detail = {0: "none", 1: "full"}.get(status.factor, f"1/{status.factor}")
    return f"ray {milliseconds(status.ray_s)}, {width}x{height} {detail:4}"


def pixel_text(status: Status) -> str:
    """The pixel under the mouse, with what is seen there."""
    if status.pixel is None:
        return ""
    row, column = status.pixel
    return f"{status.seen}  pixel ({row:4d},{column:4d})".strip()


def _divider() -> None:
    imgui.same_line(0, 12)
    at = imgui.get_cursor_screen_pos()
    height = imgui.get_frame_height()
    draw = imgui.get_window_draw_list()
    draw.add_line(
        ImVec2(at.x, at.y + 3), ImVec2(at.x, at.y + height - 3), theme.u32(theme.LINE), 1.0
    )
    imgui.dummy((1, height))
    imgui.same_line(0, 12)
