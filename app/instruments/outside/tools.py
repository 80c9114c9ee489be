"""The tools over the outside view: its menu, the world's axes, the labels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.ui import theme
from lucida.app.ui.action import Action, draw_entry
from lucida.app.ui.host import Host
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Role
from .looking import TRIAD_PX
from .mouse import Scope
from .paint import label_color
from .painting import measured, rimmed_text
from .placing import Box, LabelPlacer
from .projected import Primitive, Text

MENU = "Instruments/In the outside view"
PAD = 6  # pixels around the menu's button
GRAYS = {"x": 0.86, "y": 0.95, "z": 0.76}  # the axes' brightness


def use_tools(host: Host, scope: Scope, actions: Iterable[Action]) -> None:
    """Draw the menu and the axes into the view's window. actions: the menu's actions."""
    pad, origin = theme.px(PAD), scope.origin
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, origin.y + pad))
    if imgui.button("Show##outside"):
        imgui.open_popup("outside menu")
    if imgui.begin_popup("outside menu"):
        for number, action in enumerate(one for one in actions if one.menu == MENU):
            draw_entry(action, host, first=number == 0)
        imgui.end_popup()
    draw_axes(scope.shown, origin, scope.extent)


def draw_axes(camera: Camera, origin: ImVec2, extent: ImVec2) -> None:
    """Draw the world's axes in the upper right corner, as the camera sees them, in gray, because
    colours belong to the basis. A view that is narrower than the axes has none.
    """
    side, radius, ball = theme.px(TRIAD_PX), theme.px(30), theme.px(9.5)
    if extent.x < 2 * side:
        return
    middle, draw = ImVec2(origin.x + extent.x - side, origin.y + side), imgui.get_window_draw_list()
    disc = radius + ball + theme.px(3)
    draw.add_circle_filled(middle, disc, theme.u32(theme.rgb("#0c0d0f", 0.45)), 48)
    clean = camera.orthonormalized()
    for depth, name, across, up in sorted(zip(clean.w, "xyz", clean.u, clean.v, strict=True)):
        spot = ImVec2(middle.x + radius * across, middle.y - radius * up)
        light = GRAYS[name] * (0.55 + 0.225 * (1 + depth))  # the farthest is first, and darkest
        color = theme.u32(ImVec4(light, light, light, 1.0))
        draw.add_line(middle, spot, color, theme.px(2.2))
        draw.add_circle_filled(spot, ball, color)
        text = imgui.calc_text_size(name)
        at = ImVec2(spot.x - text.x / 2, spot.y - text.y / 2 - theme.px(1))
        draw.add_text(at, theme.u32(theme.rgb("#101215")), name)


STRONG = 1.5  # the size of strong labels, relative to the type's


class Written(NamedTuple):
    """A label in its place. at: its upper left corner in the view, in ImGui's pixels. pieces: see
    measured(). lit: True to highlight it like its term in the formula.
    """

    role: Role
    at: tuple[float, float]
    size: float
    pieces: list[tuple[imgui.ImFont, str, float]]
    lit: bool


def written(
    primitives: Sequence[Primitive],
    placer: LabelPlacer,
    view: Size,
    fonts: theme.Fonts,
) -> list[Written]:
    """Return the texts of a diagram in their places.

    placer: the view's own. view: its size in pixels.
    """
    scale = framebuffer_scale()
    texts = [part for part in primitives if isinstance(part, Text)]
    sizes = [theme.whole_px(theme.type_px() * (STRONG if part.strong else 1.0)) for part in texts]
    pieces, boxes = [], []
    for part, size in zip(texts, sizes, strict=True):
        pieces.append(measured(part.text, part.strong, size, fonts))
        room = scale * theme.px(7 if part.strong else 13)
        boxes.append(Box(scale * sum(piece[2] for piece in pieces[-1]), scale * size, room))
    centers = placer.place(primitives, boxes, view)
    return [
        Written(
            part.role, ((x - box.width / 2) / scale, (y - box.height / 2) / scale), size, found,
            part.lit,
        )
        for part, size, found, box, (x, y) in zip(texts, sizes, pieces, boxes, centers, strict=True)
    ]  # fmt: skip


def draw_labels(labels: Iterable[Written], origin: ImVec2) -> None:
    """Draw labels into a view at `origin`."""
    draw, shadow = imgui.get_window_draw_list(), theme.u32(theme.rgb("#07080a", 0.85))
    for role, (x, y), size, pieces, lit in labels:
        at = ImVec2(math.floor(origin.x + x), math.floor(origin.y + y))
        if lit:
            pad, width = theme.px(4), sum(wide for *_, wide in pieces)
            low, high = (
                ImVec2(at.x - pad, at.y - pad),
                ImVec2(at.x + width + pad, at.y + size + pad),
            )
            draw.add_rect_filled(low, high, theme.u32(theme.rgb("#0c0d0f", 0.9)), pad)
            draw.add_rect(low, high, theme.u32(label_color(role)), pad, theme.px(2))
        color = theme.u32(label_color(role))
        for font, text, wide in pieces:
            rimmed_text(draw, font, size, at, text, color, shadow, theme.px(1.8))
            at.x += wide
