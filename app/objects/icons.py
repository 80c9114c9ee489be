"""Icons of objects and lights, and switches in the same style: an eye, a lock.

They are lines in the text's colour, at the text's size.
"""

from __future__ import annotations

import math
from itertools import pairwise

from imgui_bundle import ImVec2, ImVec4, imgui

from app.widgets import theme
from app.widgets.areas import press_area
from app.widgets.rows import tip

WIDE_EM = 1.25  # of an icon's room
SHOWN = "shown by both renderers, or hidden"
LOCKED = "locked: clicks and handles leave it alone"


def icon(kind: str, color: ImVec4) -> None:
    """Draw an item of one line's height: the icon of a kind of object or light."""
    size = _room()
    imgui.dummy(size)
    _sign(kind, _middle(size), theme.u32(color))


def switch(label: str, sign: str, on: bool, tooltip: str) -> bool:
    """Draw a sign to click, pale if it is off. Return True if it was clicked."""
    size = _room()
    clicked = press_area(label, size)
    tip(tooltip)
    bright = on or imgui.is_item_hovered() or imgui.is_item_focused()
    _sign(
        sign, _middle(size), theme.u32(theme.TEXT if bright else theme.PLAIN, 1 if bright else 0.6)
    )
    return bool(clicked)


def _room() -> ImVec2:
    return ImVec2(WIDE_EM * imgui.get_font_size(), imgui.get_frame_height())


def _middle(size: ImVec2) -> ImVec2:
    low = imgui.get_item_rect_min()
    return ImVec2(low.x + size.x / 2, low.y + size.y / 2)


def _sign(kind: str, at: ImVec2, color: int) -> None:
    draw, r, width = imgui.get_window_draw_list(), 0.42 * imgui.get_font_size(), theme.px(1.3)

    def point(x: float, y: float) -> ImVec2:
        return ImVec2(at.x + r * x, at.y + r * y)

    def lines(*points: tuple[float, float], closed: bool = False) -> None:
        places = [point(*p) for p in (*points, *points[: int(closed)])]
        for start, end in pairwise(places):
            draw.add_line(start, end, color, width)

    if kind == "sphere":
        draw.add_circle(at, r, color, 0, width)
        draw.add_ellipse(at, ImVec2(r, 0.35 * r), color, 0, 0, width)
    elif kind == "box":
        lines((-1, -0.4), (0, -1), (1, -0.4), (1, 0.5), (0, 1), (-1, 0.5), closed=True)
        lines((-1, -0.4), (0, 0.15), (1, -0.4))
        lines((0, 0.15), (0, 1))
    elif kind == "rectangle":
        lines((-1, 0.4), (-0.3, -0.5), (1, -0.4), (0.4, 0.6), closed=True)
    elif kind == "disk":
        draw.add_ellipse(at, ImVec2(r, 0.45 * r), color, 0, 0, width)
    elif kind == "cylinder":
        draw.add_ellipse(point(0, -0.7), ImVec2(0.8 * r, 0.3 * r), color, 0, 0, width)
        lines((-0.8, -0.7), (-0.8, 0.7), (-0.3, 0.95), (0.3, 0.95), (0.8, 0.7), (0.8, -0.7))
    elif kind == "cone":
        lines((-0.8, 0.7), (0, -1), (0.8, 0.7))
        draw.add_ellipse(point(0, 0.7), ImVec2(0.8 * r, 0.28 * r), color, 0, 0, width)
    elif kind == "torus":
        draw.add_ellipse(at, ImVec2(r, 0.65 * r), color, 0, 0, width)
        draw.add_ellipse(at, ImVec2(0.4 * r, 0.2 * r), color, 0, 0, width)
    elif kind in ("point", "directional"):
        far = 8 if kind == "point" else 3
        draw.add_circle(at if kind == "point" else point(-0.5, -0.5), 0.4 * r, color, 0, width)
        for k in range(far):
            if kind == "point":
                x, y = math.cos(k * math.pi / 4), math.sin(k * math.pi / 4)
                lines((0.6 * x, 0.6 * y), (x, y))
            else:
                shift = 0.45 * (k - 1)
                lines((0.0 - shift, 0.0 + shift), (0.7 - shift, 0.7 + shift))
    elif kind in ("eye", "no eye"):
        draw.add_ellipse(at, ImVec2(r, 0.55 * r), color, 0, 0, width)
        if kind == "eye":
            draw.add_circle_filled(at, 0.3 * r, color)
        else:
            lines((-0.9, 0.9), (0.9, -0.9))
    elif kind in ("lock", "no lock"):
        draw.add_rect(point(-0.7, -0.1), point(0.7, 0.95), color, theme.px(1), width)
        left = -0.1 if kind == "lock" else -0.45
        lines((-0.45, -0.1), (-0.45, -0.6), (0, -0.95), (0.45, -0.6), (0.45, left))
    else:  # a model
        lines((-1, 0.8), (-0.2, -0.9), (1, 0.3), closed=True)
        lines((-0.2, -0.9), (0.1, 0.35), (1, 0.3))
        lines((-1, 0.8), (0.1, 0.35))
