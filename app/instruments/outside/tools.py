"""The tools over the outside view: the legend of switches, the axes that turn it, the labels."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from app.instruments.outside.diagram import Role
from app.instruments.outside.extent import way_of
from app.instruments.outside.looking import TRIAD_PX, Floats, camera_along
from app.instruments.outside.mouse import Scope
from app.instruments.outside.options import OutsideOptions
from app.instruments.outside.paint import role_color
from app.instruments.outside.painting import measured, rimmed_text
from app.instruments.outside.placing import Box, Edges, LabelPlacer
from app.instruments.outside.projected import Primitive, Text
from app.instruments.outside.switches import (
    AXIS_NAMES,
    SWITCHES,
    Switch,
    handles,
    is_on,
    toggled,
    with_gizmo,
)
from app.state.bounds import whole_range_of
from app.ui import theme
from app.ui.areas import press_area
from app.ui.theme import framebuffer_scale
from app.ui.view import Host
from renderer.camera.camera import Camera

PAD = 6  # around the switches
GAP = 4  # between them
TRIAD_ROOM = 110  # width that the switches leave to the axes
LARGEST_SHARE = 0.2  # of the view's height, for switches in more than one row


class _Entry(NamedTuple):
    """A switch or a button of the legend. color: of its dot; None for no dot. clicked: returns the
    options after a click.
    """

    name: str
    tip: str
    is_on: bool
    color: ImVec4 | None
    clicked: Callable[[], OutsideOptions]


class _Covered(NamedTuple):
    """Width and height that the legend covers in the view's upper left and lower left corner."""

    upper: tuple[float, float]
    lower: tuple[float, float]


def use_tools(host: Host, scope: Scope, more: Floats, answered: bool) -> tuple[Edges, ...]:
    """Draw the legend and the axes into the view's window, and do what they are clicked for. Return
    the boxes that they cover, in the view's pixels.

    more: points (n, 3) that must be in sight with the scene. answered: a wrong answer is drawn.
    """
    state = host.state
    now = state.of(OutsideOptions)
    shown = [one for one in SWITCHES if answered or one.field != "answers" or not now.answers]
    options, rows = _legend(now, shown, host.renderers.camera(state), scope)
    axis = triad(scope.shown, scope.origin, scope.extent)
    if axis is not None:
        options = replace(options, camera=camera_along(host, scope, axis, more))
    right, bottom, scale = scope.extent.x, scope.extent.y, framebuffer_scale()
    around = 2 * theme.px(TRIAD_PX)
    boxes = (
        (0.0, 0.0, *rows.upper),
        (0.0, bottom - rows.lower[1], rows.lower[0], bottom),
        (right - around, 0.0, right, around),
    )
    covered = tuple((scale * a, scale * b, scale * c, scale * d) for a, b, c, d in boxes)
    if options == now:
        return covered
    changed = state.with_options(outside=options)
    if options.camera != now.camera:
        host.travel(changed)
    else:
        host.apply(changed)
    return covered


def _legend(
    options: OutsideOptions, shown: list[Switch], camera: Camera, scope: Scope
) -> tuple[OutsideOptions, _Covered]:
    """Draw the switches in the view's upper left corner, those of the handles and the view below.
    Return the options and what is covered.

    The switches take one row, or two. In a view without room for them one button opens all of them.
    camera: the one in the scene.
    """
    switches = [
        _Entry(
            switch.name, switch.tip, is_on(options, switch.field), role_color(switch.role),
            partial(toggled, options, switch.field),
        )
        for switch in shown
    ]  # fmt: skip
    tools = [
        _Entry(name, tip, options.gizmo == kind, theme.TEXT, partial(with_gizmo, options, kind))
        for kind, name, tip in handles(options)
    ]
    tips = "a view that sees the scene and the camera", "look from the camera: what it sees"
    views = [
        _Entry("fit all", tips[0], False, None, partial(replace, options, camera=None)),
        _Entry("from camera", tips[1], False, None, partial(replace, options, camera=camera)),
    ]
    pad, origin, extent = theme.px(PAD), scope.origin, scope.extent
    high = imgui.get_frame_height()
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, origin.y + pad))
    above = _rows(switches, extent.x - pad - theme.px(TRIAD_ROOM))
    below = _rows(tools + views, extent.x - 2 * pad)
    is_low = 2 * (high + theme.px(GAP)) > LARGEST_SHARE * extent.y
    if len(below) > 1 or len(above) > (1 if is_low else 2):
        options = _popup(options, [switches, tools, views])
        width = pad + imgui.get_item_rect_max().x - origin.x
        return options, _Covered((width, high + 2 * pad), (0.0, 0.0))
    changed, upper = options, 0.0
    for line, row in enumerate(above):
        top = origin.y + pad + line * (high + theme.px(GAP))
        imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, top))
        for number, entry in enumerate(row):
            if number:
                imgui.same_line(0, theme.px(GAP))
            if chip(*entry[:4]):
                changed = entry.clicked()
            if entry.name == "bundle" and imgui.begin_popup_context_item("bundle size"):
                changed = _bundle_fields(changed)
                imgui.end_popup()
            upper = max(upper, imgui.get_item_rect_max().x - origin.x)
    upper_high = len(above) * (high + theme.px(GAP)) - theme.px(GAP) + 2 * pad
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, origin.y + extent.y - pad - high))
    lower = 0.0
    for entry in tools + views:
        if chip(*entry[:4]):
            changed = entry.clicked()
        lower = imgui.get_item_rect_max().x - origin.x
        imgui.same_line(0, theme.px(GAP))
    imgui.new_line()
    return changed, _Covered((upper, upper_high), (lower, high + 2 * pad))


def _rows(entries: list[_Entry], room: float) -> list[list[_Entry]]:
    """Return the entries in rows that are at most `room` wide."""
    rows: list[list[_Entry]] = [[]]
    wide = 0.0
    for entry in entries:
        width = _chip_width(entry.name, entry.color is not None)
        if rows[-1] and wide + width > room:
            rows.append([])
            wide = 0.0
        rows[-1].append(entry)
        wide += width + theme.px(GAP)
    return rows


def _popup(options: OutsideOptions, groups: list[list[_Entry]]) -> OutsideOptions:
    if chip("show ...", "what is drawn, and the handles", False):
        imgui.open_popup("outside legend")
    if not imgui.begin_popup("outside legend"):
        return options
    for number, group in enumerate(groups):
        if number:
            imgui.separator()
        for entry in group:
            if imgui.menu_item(entry.name, "", entry.is_on)[0]:
                options = entry.clicked()
            imgui.set_item_tooltip(entry.tip)
        if not number:
            options = _bundle_fields(options)
    imgui.end_popup()
    return options


def _bundle_fields(options: OutsideOptions) -> OutsideOptions:
    rows, columns = options.bundle
    imgui.set_next_item_width(theme.px(110))
    changed, values = imgui.slider_int2(
        "rows, columns", [rows, columns], *whole_range_of(OutsideOptions, "bundle")
    )
    if changed:
        return replace(options, bundle=(int(values[0]), int(values[1])))
    return options


def _chip_width(name: str, has_dot: bool) -> float:
    return float(imgui.calc_text_size(name).x + theme.px(28 if has_dot else 12))


def chip(name: str, tip: str, on: bool, color: ImVec4 | None = None) -> bool:
    """Draw a small button with a dot of its colour, filled if it is on."""
    height = imgui.get_frame_height()
    dot = theme.px(16) if color is not None else 0.0
    size = ImVec2(_chip_width(name, color is not None), height)
    at = imgui.get_cursor_screen_pos()
    clicked = press_area(f"{name}##outside", size)
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
    one: "x", "-x", ... A view that is narrower than they are has none.
    """
    radius, ball = theme.px(30), theme.px(9.5)
    if extent.x < 2 * (radius + ball + theme.px(8)):
        return None
    middle = ImVec2(
        origin.x + extent.x - radius - ball - theme.px(8), origin.y + radius + ball + theme.px(8)
    )
    draw = imgui.get_window_draw_list()
    disc = radius + ball + theme.px(3)
    draw.add_circle_filled(middle, disc, theme.u32(theme.rgb("#0c0d0f", 0.45)), 48)
    clicked = None
    for depth, name, across, up in _axes_seen(camera):
        spot = ImVec2(middle.x + radius * across, middle.y - radius * up)
        color = _axis_color(name[-1], 0.55 + 0.225 * (1 + depth))
        is_positive = not name.startswith("-")
        size = ball if is_positive else 0.72 * ball
        if is_positive:
            draw.add_line(middle, spot, theme.u32(color), theme.px(2.2))
        imgui.set_cursor_screen_pos(ImVec2(spot.x - size, spot.y - size))
        if press_area(f"axis {name}##outside", ImVec2(2 * size, 2 * size)):
            clicked = name
        hovered = imgui.is_item_hovered()
        imgui.set_item_tooltip(f"look {AXIS_NAMES[name]}")
        if is_positive:
            draw.add_circle_filled(spot, size, theme.u32(color))
            text = imgui.calc_text_size(name)
            at = ImVec2(spot.x - text.x / 2, spot.y - text.y / 2 - theme.px(1))
            draw.add_text(at, theme.u32(theme.rgb("#101215")), name)
        else:
            draw.add_circle_filled(spot, size, theme.u32(theme.rgb("#1a1d21", 0.85)))
            draw.add_circle(spot, size, theme.u32(color), 0, theme.px(1.5))
        if hovered:
            draw.add_circle(spot, size + theme.px(1.5), theme.u32(theme.MARK), 0, theme.px(2))
    return clicked


@lru_cache(maxsize=1)
def _axes_seen(camera: Camera) -> list[tuple[float, str, float, float]]:
    """Return the depths of the world's axes, their names, and where a camera sees their ends: to
    the right and up. The farthest is first.
    """
    back = np.asarray(camera.w) / np.linalg.norm(camera.w)
    right = np.asarray(camera.u) - (back @ camera.u) * back
    right = right / np.linalg.norm(right)
    up = np.cross(back, right)
    if up @ np.asarray(camera.v) < 0:
        up = -up
    ways = [(name, way_of(name)) for name in AXIS_NAMES]
    ends = [(float(way @ back), name, float(way @ right), float(way @ up)) for name, way in ways]
    return sorted(ends, key=lambda end: end[0])


def _axis_color(name: str, light: float) -> ImVec4:
    """Return the gray of a world axis: colours are for the basis."""
    base = {"x": 0.86, "y": 0.95, "z": 0.76}[name] * light
    return ImVec4(base, base, base, 1.0)


STRONG = 1.5  # the size of names that teach, in sizes of the type


class Written(NamedTuple):
    """A label in its place. at: its upper left corner in the view, in ImGui's pixels. pieces: see
    measured().
    """

    role: Role
    at: tuple[float, float]
    size: float
    pieces: list[tuple[imgui.ImFont, str, float]]


def written(
    primitives: Sequence[Primitive],
    placer: LabelPlacer,
    extent: ImVec2,
    fonts: theme.Fonts,
    tools: tuple[Edges, ...],
) -> list[Written]:
    """Return the texts of a diagram in their places.

    placer: the view's own. extent: of the view. tools: boxes in the view's pixels that are covered.
    """
    scale = framebuffer_scale()
    texts = [part for part in primitives if isinstance(part, Text)]
    sizes = [theme.whole_px(theme.type_px() * (STRONG if part.strong else 1.0)) for part in texts]
    pieces, boxes = [], []
    for part, size in zip(texts, sizes, strict=True):
        pieces.append(measured(part.text, part.strong, size, fonts))
        room = scale * theme.px(7 if part.strong else 13)
        boxes.append(Box(scale * sum(piece[2] for piece in pieces[-1]), scale * size, room))
    centers = placer.place(primitives, boxes, (scale * extent.x, scale * extent.y), tools)
    return [
        Written(part.role, ((x - box.width / 2) / scale, (y - box.height / 2) / scale), size, found)
        for part, size, found, box, (x, y) in zip(texts, sizes, pieces, boxes, centers, strict=True)
    ]


def draw_labels(labels: Iterable[Written], origin: ImVec2, ground: theme.Rgb) -> None:
    """Draw labels into a view at `origin`. ground: the colour under them."""
    draw, shadow = imgui.get_window_draw_list(), theme.u32(theme.rgb("#07080a", 0.62))
    for role, (x, y), size, pieces in labels:
        at = ImVec2(math.floor(origin.x + x), math.floor(origin.y + y))
        color = theme.u32(role_color(role, ground))
        for font, text, wide in pieces:
            rimmed_text(draw, font, size, at, text, color, shadow, theme.px(1.25))
            at.x += wide
