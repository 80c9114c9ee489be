"""The tools over the outside view's picture: the legend of switches, the axes that turn it, and the
labels of the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from app.outside.extent import way_of
from app.outside.options import OutsideOptions
from app.outside.paint import role_color
from app.outside.projected import Primitive, Text
from app.outside.switches import AXIS_NAMES, HANDLES, SWITCHES, VIEWS, is_on, toggled, with_gizmo
from app.state.bounds import whole_range_of
from app.widgets import theme
from renderer.camera import Camera


def legend(options: OutsideOptions, origin: ImVec2, extent: ImVec2) -> tuple[OutsideOptions, str]:
    """Draw the switches in the view's upper left corner, those of the handles and the view below.

    In a narrow view one button opens all of them. Return the options, and what else was clicked:
    "fit", "camera" or "".
    """
    pad = theme.px(6)
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, origin.y + pad))
    room = extent.x - theme.px(110)
    if sum(_chip_width(switch.name) for switch in SWITCHES) > room:
        return _popup(options)
    for number, switch in enumerate(SWITCHES):
        if number:
            imgui.same_line(0, theme.px(4))
        color = role_color(switch.role)
        if _chip(switch.name, color, is_on(options, switch.field), switch.tip):
            options = toggled(options, switch.field)
        if switch.field == "bundle" and imgui.begin_popup_context_item("bundle size"):
            options = _bundle_fields(options)
            imgui.end_popup()
    below = origin.y + extent.y - pad - imgui.get_frame_height()
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, below))
    for kind, name, tip in HANDLES:
        if _chip(name, theme.TEXT, options.gizmo == kind, tip):
            options = with_gizmo(options, kind)
        imgui.same_line(0, theme.px(4))
    clicked = ""
    for name, title, tip in VIEWS:
        if _chip(title, None, False, tip):
            clicked = name
        imgui.same_line(0, theme.px(4))
    imgui.new_line()
    return options, clicked


def _popup(options: OutsideOptions) -> tuple[OutsideOptions, str]:
    if _chip("show ...", None, False, "what is drawn, and the handles"):
        imgui.open_popup("outside legend")
    clicked = ""
    if not imgui.begin_popup("outside legend"):
        return options, clicked
    for switch in SWITCHES:
        if imgui.menu_item(switch.name, "", is_on(options, switch.field))[0]:
            options = toggled(options, switch.field)
        imgui.set_item_tooltip(switch.tip)
    options = _bundle_fields(options)
    imgui.separator()
    for kind, name, tip in HANDLES:
        if imgui.menu_item(name, "", options.gizmo == kind)[0]:
            options = with_gizmo(options, kind)
        imgui.set_item_tooltip(tip)
    imgui.separator()
    for name, title, tip in VIEWS:
        if imgui.menu_item(title, "", False)[0]:
            clicked = name
        imgui.set_item_tooltip(tip)
    imgui.end_popup()
    return options, clicked


def _bundle_fields(options: OutsideOptions) -> OutsideOptions:
    rows, columns = options.bundle
    imgui.set_next_item_width(theme.px(110))
    changed, values = imgui.slider_int2(
        "rows, columns", [rows, columns], *whole_range_of(OutsideOptions, "bundle")
    )
    if changed:
        return replace(options, bundle=(int(values[0]), int(values[1])))
    return options


def _chip_width(name: str) -> float:
    return imgui.calc_text_size(name).x + theme.px(28) + theme.px(4)


def _chip(name: str, color: ImVec4 | None, on: bool, tip: str) -> bool:
    """A small button with a dot of its colour: filled where it is on."""
    height = imgui.get_frame_height()
    dot = theme.px(16) if color is not None else 0.0
    size = ImVec2(imgui.calc_text_size(name).x + dot + theme.px(12), height)
    at = imgui.get_cursor_screen_pos()
    clicked = imgui.invisible_button(f"{name}##outside", size)
    hovered = imgui.is_item_hovered()
    imgui.set_item_tooltip(tip)
    draw = imgui.get_window_draw_list()
    far = ImVec2(at.x + size.x, at.y + size.y)
    back = theme.FRAME_HOVERED if hovered else theme.PANEL
    draw.add_rect_filled(at, far, theme.u32(back, 0.94 if on or hovered else 0.82), theme.px(4))
    middle = at.y + height / 2
    if color is not None:
        spot = ImVec2(at.x + theme.px(12), middle)
        if on:
            draw.add_circle_filled(spot, theme.px(4.5), theme.u32(color))
        draw.add_circle(spot, theme.px(4.5), theme.u32(theme.DIM if on else theme.PLAIN))
    text = ImVec2(at.x + dot + theme.px(6), middle - imgui.get_text_line_height() / 2)
    draw.add_text(text, theme.u32(theme.TEXT if on or color is None else theme.DIM), name)
    return bool(clicked)


def triad(camera: Camera, origin: ImVec2, extent: ImVec2) -> str | None:
    """Draw the world's axes in the upper right corner, as the camera sees them. Return the clicked
    one: "x", "-x", ...
    """
    radius, ball = theme.px(30), theme.px(9.5)
    middle = ImVec2(
        origin.x + extent.x - radius - ball - theme.px(8), origin.y + radius + ball + theme.px(8)
    )
    back = np.asarray(camera.w) / np.linalg.norm(camera.w)
    right = np.asarray(camera.u) - (back @ camera.u) * back
    right = right / np.linalg.norm(right)
    up = np.cross(back, right)
    if up @ np.asarray(camera.v) < 0:
        up = -up
    ends = []
    for name in AXIS_NAMES:
        way = way_of(name)
        spot = ImVec2(middle.x + radius * float(way @ right), middle.y - radius * float(way @ up))
        ends.append((float(way @ back), name, spot))
    draw = imgui.get_window_draw_list()
    disc = radius + ball + theme.px(3)
    draw.add_circle_filled(middle, disc, theme.u32(theme.rgb("#0c0d0f", 0.45)), 48)
    clicked = None
    for depth, name, spot in sorted(ends, key=lambda end: end[0]):
        light = 0.55 + 0.225 * (1 + depth)
        color = _axis_color(name[-1], light)
        if not name.startswith("-"):
            draw.add_line(middle, spot, theme.u32(color), theme.px(2.2))
        size = ball if not name.startswith("-") else 0.72 * ball
        imgui.set_cursor_screen_pos(ImVec2(spot.x - size, spot.y - size))
        if imgui.invisible_button(f"axis {name}##outside", ImVec2(2 * size, 2 * size)):
            clicked = name
        hovered = imgui.is_item_hovered()
        imgui.set_item_tooltip(f"look {AXIS_NAMES[name]}")
        if name.startswith("-"):
            draw.add_circle_filled(spot, size, theme.u32(theme.rgb("#1a1d21", 0.85)))
            draw.add_circle(spot, size, theme.u32(color), 0, theme.px(1.5))
        else:
            draw.add_circle_filled(spot, size, theme.u32(color))
            text = imgui.calc_text_size(name)
            at = ImVec2(spot.x - text.x / 2, spot.y - text.y / 2 - theme.px(1))
            draw.add_text(at, theme.u32(theme.rgb("#101215")), name)
        if hovered:
            draw.add_circle(spot, size + theme.px(1.5), theme.u32(theme.MARK), 0, theme.px(2))
    return clicked


def _axis_color(name: str, light: float) -> ImVec4:
    """Grays of the world's axes: the colours are the basis's."""
    base = {"x": 0.86, "y": 0.95, "z": 0.76}[name] * light
    return ImVec4(base, base, base, 1.0)


PRESENTED = 1.3  # of the type, a plain label's in a hall


def labels(
    primitives: Iterable[Primitive],
    origin: ImVec2,
    scale: float,
    fonts: theme.Fonts,
    ground: theme.Rgb,
    presented: bool = False,
) -> None:
    """Draws the texts of a diagram. scale: framebuffer pixels in one of ImGui's units. ground: what
    they stand on. presented: to be read from the last row."""
    draw = imgui.get_window_draw_list()
    shadow = theme.u32(theme.rgb("#07080a", 0.62))
    for part in primitives:
        if not isinstance(part, Text):
            continue
        font = fonts.bold if part.strong else fonts.text
        plain = PRESENTED if presented else 1.0
        size = theme.whole_px(imgui.get_font_size() * (1.5 if part.strong else plain))
        imgui.push_font(font, 0.0)
        box = imgui.calc_text_size(part.text)
        ratio = size / imgui.get_font_size()
        imgui.pop_font()
        width, height = box.x * ratio, box.y * ratio
        dx, dy = part.toward
        # The text's box touches a circle round the point from outside.
        room = theme.px(7 if part.strong else 13) + abs(dx) * width / 2 + abs(dy) * height / 2
        x = math.floor(origin.x + part.at[0] / scale + dx * room - width / 2)
        y = math.floor(origin.y + part.at[1] / scale + dy * room - height / 2)
        assert font is not None
        offset = theme.px(1.25)
        for k in range(8):
            angle = k * math.pi / 4
            at = ImVec2(x + offset * math.cos(angle), y + offset * math.sin(angle))
            draw.add_text(font, size, at, shadow, part.text)
        color = theme.u32(role_color(part.role, ground))
        draw.add_text(font, size, ImVec2(x, y), color, part.text)
